"""Read a picture as an instrument would: how bright, how much of it is lost, how strong its colours, how large its subjects."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    import mujoco
    import numpy as np

BLOWN, CRUSHED = 250, 5
"""Luma from which, and up to which, nothing can be told apart, of 255."""
WEIGHTS = (0.2126, 0.7152, 0.0722)
"""Of red, green and blue in luma (ITU-R BT.709)."""


def read(image: np.ndarray) -> dict[str, float]:
    """Read a picture, uint8 (H, W, 3) RGB: each number is from 0 to 1.

    `luma` is the mean; `blown` and `crushed` are shares of the picture; `contrast` is the deviation of luma; `saturation` the
    mean of (max - min) / max over the channels.
    """
    import numpy as np

    luma = image.astype(np.float32) @ np.array(WEIGHTS, np.float32)
    high, low = image.max(axis=-1).astype(np.float32), image.min(axis=-1).astype(np.float32)
    return {
        "luma": round(float(luma.mean()) / 255, 4),
        "blown": round(float((luma >= BLOWN).mean()), 4),
        "crushed": round(float((luma <= CRUSHED).mean()), 4),
        "contrast": round(float(luma.std()) / 255, 4),
        "saturation": round(float(((high - low) / np.maximum(high, 1.0)).mean()), 4),
    }


def subjects(model: mujoco.MjModel, geoms: np.ndarray, names: Iterable[str]) -> dict[str, int]:
    """Pixels of each named body with all that hangs on it, in a segmentation (H, W) of geom numbers, -1 for none."""
    import mujoco
    import numpy as np

    shown = np.bincount(geoms[geoms >= 0], minlength=max(model.ngeom, 1))
    found = {}
    for name in names:
        body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name)
        if body < 0:
            continue
        family = {body}
        for other in range(body + 1, model.nbody):  # a body comes after its parent
            if int(model.body_parentid[other]) in family:
                family.add(other)
        mine = np.isin(model.geom_bodyid, list(family))
        found[name] = int(shown[: model.ngeom][mine].sum())
    return found


def reading(
    model: mujoco.MjModel, image: np.ndarray, layers: Sequence[np.ndarray], names: Iterable[str]
) -> dict[str, Any]:
    """Both readings of one picture, with `subjects` among the rest: of each the most pixels in any of some segmentations, such as
    that through the glass that it is in."""
    bodies = tuple(names)
    found = [subjects(model, geoms, bodies) for geoms in layers]
    return {**read(image), "subjects": {name: max(one[name] for one in found) for name in found[0]}}

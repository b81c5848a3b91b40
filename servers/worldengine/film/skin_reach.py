"""How far a skin of a mover reaches beyond its body, or stays behind it: what looks longer than it is, or ahead, is told so."""

from typing import TYPE_CHECKING, Any

from worldkit.turning import turned

from .motion_facts import boxes

if TYPE_CHECKING:
    import numpy as np

    from ..recording.stored import Recording

TOLD = 0.1
"""From this share of the body's longest side on."""


def told(thing: dict[str, Any], arrays: "dict[str, np.ndarray]", recording: "Recording") -> dict[str, str]:
    """`reach` of a skin: how far the box around it ends from that around its body's shapes, in the body's frame; else nothing."""
    import numpy as np

    if not thing["instead"] or "off_m" in thing or thing["to"] not in recording.names:
        return {}
    middle, half = (found[recording.names.index(thing["to"])] for found in boxes(recording))
    points = turned(np.array(thing["quat"])[None], arrays[thing["vertices"]] * np.array(thing["size"])) + thing["pos"]
    apart = np.abs([points.min(axis=0) - middle + half, points.max(axis=0) - middle - half])
    if apart.max() <= TOLD * 2 * half.max():
        return {}
    longer = np.ptp(points, axis=0) / np.maximum(2 * half, 1e-9)
    times = f", {longer[np.argmax(half)]:.2g} times as long" if abs(longer[np.argmax(half)] - 1) > TOLD else ""
    return {"reach": f"{times}, up to {apart.max():.2g} m off its sides"}

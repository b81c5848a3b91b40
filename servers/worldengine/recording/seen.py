"""Tell which geoms and skins of a model a picture shows."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco
    import numpy as np

HIDDEN_GROUP = 3
"""Geom groups from here on are not drawn."""


def visible(model: "mujoco.MjModel") -> "np.ndarray":
    """(ngeom,) bool: whether a geom is drawn and not fully transparent."""
    import numpy as np

    alpha = np.where(model.geom_matid >= 0, 1.0, model.geom_rgba[:, 3])
    if model.nmat:
        alpha = np.where(model.geom_matid >= 0, model.mat_rgba[np.maximum(model.geom_matid, 0), 3], alpha)
    return np.asarray((model.geom_group < HIDDEN_GROUP) & (alpha > 0.02))


def visible_skins(model: "mujoco.MjModel") -> "np.ndarray":
    """(nskin,) bool: whether a skin is drawn and not fully transparent."""
    import numpy as np

    alpha = model.skin_rgba[:, 3]
    if model.nmat:
        alpha = np.where(model.skin_matid >= 0, model.mat_rgba[np.maximum(model.skin_matid, 0), 3], alpha)
    return np.asarray((model.skin_group < HIDDEN_GROUP) & (alpha > 0.02))


def skinned(model: "mujoco.MjModel") -> "np.ndarray":
    """(nbody,) bool: whether a skin that is drawn follows the body, and so shows it."""
    import numpy as np

    found = np.zeros(model.nbody, dtype=bool)
    for skin in np.flatnonzero(visible_skins(model)):
        first = int(model.skin_boneadr[skin])
        found[model.skin_bonebodyid[first : first + int(model.skin_bonenum[skin])]] = True
    found[0] = False
    return found

"""Tell which geoms and skins of a model a picture shows."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco
    import numpy as np

HIDDEN_GROUP = 3
"""Geom groups from here on are not drawn."""
UNSET_RGBA = (0.5, 0.5, 0.5, 1.0)
"""MuJoCo's own colour of a geom to which none was given."""


def shown_rgba(own: "np.ndarray", material: "np.ndarray") -> "np.ndarray":
    """(..., 4) what is drawn of a geom's own colour and its material's, (..., 4) each: its own, if it was given any."""
    import numpy as np

    return np.where(np.isclose(own, UNSET_RGBA).all(axis=-1, keepdims=True), material, own)


def geom_rgba(model: "mujoco.MjModel") -> "np.ndarray":
    """(ngeom, 4) the colour and opacity with which each geom is drawn."""
    import numpy as np

    own, material = model.geom_rgba, model.geom_matid
    if not model.nmat:
        return np.array(own)
    return shown_rgba(own, np.where(material[:, None] >= 0, model.mat_rgba[np.maximum(material, 0)], own))


def visible(model: "mujoco.MjModel") -> "np.ndarray":
    """(ngeom,) bool: whether a geom is drawn and not fully transparent."""
    import numpy as np

    return np.asarray((model.geom_group < HIDDEN_GROUP) & (geom_rgba(model)[:, 3] > 0.02))


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

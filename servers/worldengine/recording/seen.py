"""Tell which geoms of a model a picture shows."""

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

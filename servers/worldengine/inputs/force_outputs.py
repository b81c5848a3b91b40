"""Find the force output of an actuator that each control belongs to."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco
    import numpy as np


def outputs(model: "mujoco.MjModel") -> "np.ndarray":
    """(nu,) the force output of each control: an orientation actuator has three, one for each of its controls."""
    import numpy as np

    found = [
        first + min(k, outputs - 1)
        for first, outputs, controls in zip(
            model.actuator_outadr.tolist(), model.actuator_outnum.tolist(), model.actuator_ctrlnum.tolist(), strict=True
        )
        for k in range(controls)
    ]
    return np.array(found, dtype=int)

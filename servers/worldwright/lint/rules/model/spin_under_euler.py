"""A spinning free body is integrated with explicit gyroscopic forces.

What it does: finds free bodies of unequal moments of inertia that start with a spin, under the `Euler` integrator, which
is the engine's default; from half a degree a step on.

Why is this bad: Euler integrates gyroscopic torques explicitly. A tumbling body gains energy with every turn until it
whirls at speeds nobody gave it.

Use instead: `integrator="implicitfast"` (worldkit's default), which carries them implicitly for free bodies, or `RK4`.
"""

from collections.abc import Iterator

import numpy as np

from ...compiled.view import ModelView
from ...harm import Measured, fastest
from ...problem import Problem

CODE = "WM116"
SEVERITY = "warning"
SCOPE = "any"
TOP = (
    "<mujoco><option gravity='0 0 0' integrator='{0}'/><worldbody><body name='baton'><freejoint/>"
    "<geom type='capsule' size='.02 .3'/></body></worldbody>"
    "<keyframe><key name='start' qvel='0 0 0 0 20 20'/></keyframe></mujoco>"
)
GOOD = (TOP.format("implicitfast"), TOP.format("Euler").replace("0 20 20", "0 0 0"))
BAD = (TOP.format("Euler"),)
EVIDENCE = Measured("the baton whirls five times as fast as it was thrown", lambda s: fastest(s, 4.0), 30.0, "rad/s")
LEAST_RAD, ALIKE = np.radians(0.5), 0.1


def check(view: ModelView) -> Iterator[Problem]:
    """Check free bodies that spin at the start."""
    if view.integrator != "euler":
        return
    for joint, kind in enumerate(view.joint_kind):
        body, first = int(view.jnt_bodyid[joint]), int(view.jnt_dofadr[joint])
        inertia = view.body_inertia[body]
        if kind != "free" or inertia.max() <= 0 or 1 - inertia.min() / inertia.max() < ALIKE:
            continue
        turn = float(np.linalg.norm(view.qvel[first + 3 : first + 6])) * view.time_step
        if turn > LEAST_RAD:
            message = (
                f"{view.name('body', body)} spins by {np.degrees(turn):.1f} degrees a step under Euler: it gains energy"
            )
            yield view.at("body", body, message, "use integrator implicitfast")

"""A servo is too stiff for the time step.

What it does: estimates the angular frequency of position servos (`kp` and the inertia behind the transmission) and, under
`Euler` and `RK4`, the decay rate of their velocity feedback (`kv`), and compares both with the time step.

Why is this bad: position feedback is explicit under every integrator but `discrete`: beyond 2 / step the servo shakes
itself to pieces; velocity feedback is explicit under `Euler` and `RK4`.

Use instead: a smaller gain, `armature` (a geared motor has some), a smaller time step, or `integrator="discrete"`.
"""

from collections.abc import Iterator

import numpy as np

from ...compiled.view import ModelView
from ...harm import Measured, diverged
from ...problem import Problem

CODE = "WM115"
SEVERITY = "error"
SCOPE = "any"
SERVO = (
    "<mujoco><option timestep='0.002' integrator='{0}'/><worldbody><body><joint name='j' axis='0 1 0'/><geom type='capsule' "
    "size='.02' fromto='0 0 0 .2 0 0' mass='.1'/></body></worldbody>"
    "<actuator><position name='servo' joint='j' kp='{1}' kv='{2}'/></actuator></mujoco>"
)
GOOD = (SERVO.format("implicitfast", "20", "1"), SERVO.format("discrete", "1e4", "1"))
BAD = (SERVO.format("implicitfast", "1e4", "0"), SERVO.format("Euler", "20", "40"))
EVIDENCE = Measured("the arm shakes itself into a reset", diverged, 0.5, "resets")
UNSTABLE = 2.0
AFFINE = 1
"""`mjBIAS_AFFINE`: the bias is b0 + b1 * length + b2 * velocity."""


def check(view: ModelView) -> Iterator[Problem]:
    """Check actuators with an affine bias and one output."""
    if view.integrator == "discrete" or len(view.actuator_invweight) != len(view.actuator_biastype):
        return
    explicit = view.integrator in ("euler", "rk4")
    for index, kind in enumerate(view.actuator_biastype):
        if int(kind) != AFFINE:
            continue
        stiffness, damping = -float(view.actuator_biasprm[index, 1]), -float(view.actuator_biasprm[index, 2])
        weight = float(view.actuator_invweight[index])
        phase = view.time_step * float(np.sqrt(max(0.0, stiffness) * weight))
        decay = view.time_step * damping * weight
        if phase > UNSTABLE:
            message = f"position feedback of {view.name('actuator', index)} turns {phase:.1f} rad within a step"
            yield view.at("actuator", index, message, "lower kp, shorten the step, or use integrator discrete")
        elif explicit and decay > UNSTABLE:
            message = f"velocity feedback of {view.name('actuator', index)} overshoots {decay:.1f}-fold within a step"
            yield view.at("actuator", index, message, "use integrator implicitfast, or lower kv")

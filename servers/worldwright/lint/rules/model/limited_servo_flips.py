"""A velocity servo that reaches its limit throws a light joint to and fro.

What it does: compares, for velocity servos with a force limit, what the servo's gain can change within a step with the
speed that is missing (gain x step / inertia behind the transmission), where its control can be so large that it reaches the limit.

Why is this bad: the other integrators carry a servo's gain, but not while it stands at its limit: there the full force acts
for a whole step. On a light joint that is far more than was missing, the next step pushes back as hard, and a spoon that was to
turn by 20 rad/s flips between 0 and 120.

Use instead: a gain of at most the inertia over the step, `armature` (a geared motor has some), or no limit that it reaches.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Measured, fastest
from ...problem import Problem

CODE = "WM119"
SEVERITY = "warning"
SCOPE = "any"
SERVO = (
    "<mujoco><option timestep='0.001' gravity='0 0 0' integrator='implicitfast'/><worldbody><body name='spoon'>"
    "<joint name='j' type='hinge' axis='0 0 1'/><geom type='capsule' size='.003 .06' pos='.02 0 0' mass='.02'/></body></worldbody>"
    "<actuator><velocity name='motor' joint='j' kv='{0}'{1}/></actuator><keyframe><key name='start' ctrl='20'/></keyframe></mujoco>"
)
LIMIT = " forcelimited='true' forcerange='-1 1'"
GOOD = (
    SERVO.format("0.5", ""),
    SERVO.format("0.008", LIMIT),
    SERVO.format("0.04", LIMIT + " ctrllimited='true' ctrlrange='-20 20'"),
)
BAD = (SERVO.format("0.5", LIMIT), SERVO.format("0.5", LIMIT + " ctrllimited='true' ctrlrange='-20 20'"))
EVIDENCE = Measured("the spoon turns six times as fast as it was told to", lambda s: fastest(s, 0.1), 90.0, "rad/s")
OVERSHOOTS = 2.0
AFFINE = 1
"""`mjBIAS_AFFINE`: the bias is b0 + b1 * length + b2 * velocity."""


def check(view: ModelView) -> Iterator[Problem]:
    """Check velocity servos with one output."""
    if view.integrator in ("euler", "rk4") or len(view.actuator_invweight) != len(view.actuator_biastype):
        return  # where all feedback is explicit, WM115 tells it
    for index, kind in enumerate(view.actuator_biastype):
        stiffness, damping = -float(view.actuator_biasprm[index, 1]), -float(view.actuator_biasprm[index, 2])
        if int(kind) != AFFINE or stiffness or damping <= 0 or not view.actuator_forcelimited[index]:
            continue
        limit, weight = float(abs(view.actuator_forcerange[index]).max()), float(view.actuator_invweight[index])
        most = float(abs(view.actuator_ctrlrange[index]).max()) if view.actuator_ctrllimited[index] else float("inf")
        fold = view.time_step * damping * weight
        if fold > OVERSHOOTS and most * damping > limit:
            message = (
                f"{view.name('actuator', index)} overshoots {fold:.0f}-fold within a step once it stands at its limit of {limit:g}, which an "
                f"error of {limit / damping:.2g} reaches: it flips to and fro"
            )
            fix = f"a gain of at most {1 / (view.time_step * weight):.2g}, armature on its joint, or no limit"
            yield view.at("actuator", index, message, fix)

"""Something moves from the first instant on, and the plan gives it no initial motion.

What it means: a velocity in the program's keyframe is an outcome's hidden beginning: a spin that lands a figure on its
feet, a speed that makes the jump. The plan owns initial motion.

Formula: at the first row, the speed or the spin of a body of a mechanism none of whose bodies and joints is named in
`simulation_parameters.initial_motion`.
Threshold: 1 mm/s, or 0.01 rad/s. Blocking with a plan.
Source: the plan format; the facts on staging.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.plan.committed import Plan
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign

CODE = "WS314"
STAGING = True
NEEDS = ("mechanics.parent",)
SPEED_M_S, SPIN_RAD_S = 1e-3, 1e-2


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the fastest body of each mechanism that starts unasked."""
    if context.plan is None:
        return
    named = set(context.plan.simulation_parameters.initial_motion)
    joints = {str(j["name"]): str(j["body"]) for j in trajectory.meta.get("joints") or ()}
    named |= {joints[name] for name in named & joints.keys()}
    parent = trajectory.mechanics.parent
    assert parent is not None
    root = list(range(len(parent)))
    for b in range(len(parent)):
        while parent[root[b]] >= 0:
            root[b] = int(parent[root[b]])
    asked = {root[b] for b, name in enumerate(trajectory.names) if name in named}
    speed, spin = trajectory.speed[0], trajectory.spin[0]
    told = set()
    for b in np.argsort(-np.maximum(speed / SPEED_M_S, spin / SPIN_RAD_S)):
        if root[b] in asked | told or (speed[b] <= SPEED_M_S and spin[b] <= SPIN_RAD_S):
            continue
        told.add(root[b])
        name = trajectory.names[b]
        message = f"{name} starts with {speed[b]:.3g} m/s and {spin[b]:.3g} rad/s; the plan gives it no initial motion"
        window = (trajectory.t[0], trajectory.t[0])
        if speed[b] > SPEED_M_S:
            yield Sign(name, window, float(speed[b]), SPEED_M_S, "m/s", "blocking", message)
        else:
            yield Sign(name, window, float(spin[b]), SPIN_RAD_S, "rad/s", "blocking", message)


def _planned(trajectory: Trajectory, *, motion: bool) -> Case:
    plan = Plan.model_validate(
        {
            "plan_type": "mbs",
            "simulation_parameters": {
                "time_step": 0.002,
                "simulation_duration": trajectory.duration_s,
                "initial_motion": {"body": {"linear": [1, 0, 0]}} if motion else {},
            },
            "objectives": [{"claim": "it moves"}],
        }
    )
    return Case("a start", trajectory, Context.of(plan), severity="blocking")


def _spinning() -> Trajectory:
    still = analytic.resting()
    return replace(still, angvel=np.full_like(still.angvel, 3.0))


GOOD = (
    lambda: _planned(analytic.sliding(), motion=True),
    lambda: _planned(analytic.falling(), motion=False),
)
BAD = (lambda: _planned(analytic.sliding(), motion=False), lambda: _planned(_spinning(), motion=False))

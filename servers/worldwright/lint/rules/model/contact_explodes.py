"""A contact's own stiffness is too high for the time step.

What it does: looks at geoms whose `solref` is in the direct form (stiffness and damping, both negative): the time step
times the square root of the stiffness beyond 1.5, or times the damping beyond 2.

Why is this bad: the direct form is not clamped. Beyond 2 each contact gives back more energy than it took: a ball dropped
from half a metre jumps seven metres high.

Use instead: a lower stiffness or a smaller time step; `worldkit.contacts.surface(restitution=…, time_constant=…)` computes
both from what is meant.
"""

from collections.abc import Iterator

import numpy as np

from ...compiled.view import ModelView
from ...harm import Measured, after
from ...problem import Problem

CODE = "WM117"
SEVERITY = "error"
SCOPE = "any"
BALL = (
    "<mujoco><option timestep='0.002'/><worldbody><geom type='plane' size='5 5 .1' solref='{0}'/><body pos='0 0 .5'>"
    "<freejoint/><geom size='.1' solref='{0}'/></body></worldbody></mujoco>"
)
GOOD = (BALL.format("-100000 0"), BALL.format("-100000 -300"), BALL.format("0.02 1"))
BAD = (BALL.format("-1000000 0"), BALL.format("-1000 -2000"))
UNSTABLE, OVERDAMPED = 1.5, 2.0


def _highest_m(source: str) -> float:
    """How high the ball rises within two seconds when it is dropped from half a metre, m."""
    import mujoco

    model, data = after(source, 0.3)
    most = 0.0
    for _ in range(850):
        mujoco.mj_step(model, data)
        most = max(most, float(data.qpos[2]))
    return most


EVIDENCE = Measured("the ball jumps metres high", _highest_m, 3.0, "m")


def check(view: ModelView) -> Iterator[Problem]:
    """Check geoms that can touch something; equal values are told once."""
    told = set()
    for geom in np.flatnonzero(view.collides):
        stiffness, damping = (-float(v) for v in view.geom_solref[geom])
        if stiffness <= 0 or (stiffness, damping) in told:
            continue
        told.add((stiffness, damping))
        name = view.name("geom", int(geom))
        if view.time_step * stiffness**0.5 > UNSTABLE:
            most = (UNSTABLE / view.time_step) ** 2
            message = f"the contact stiffness of {name}, {stiffness:g}, explodes at a step of {view.time_step:g} s"
            yield view.at("geom", int(geom), message, f"stay below {most:.2g}, or shorten the step")
        elif view.time_step * damping > OVERDAMPED:
            message = f"the contact damping of {name}, {damping:g}, overshoots at a step of {view.time_step:g} s"
            yield view.at(
                "geom", int(geom), message, f"stay below {OVERDAMPED / view.time_step:.2g}, or shorten the step"
            )

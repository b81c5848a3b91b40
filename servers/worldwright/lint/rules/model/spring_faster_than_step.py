"""A spring is too stiff for the time step.

What it does: estimates the angular frequency of every joint and tendon spring from its stiffness and the inertia it
moves, sqrt(k / m), and compares it with the time step. Every integrator but `discrete` is explicit in position: beyond
2 / step it blows up, beyond 0.6 / step (ten steps a period) it is not resolved.

Why is this bad: the spring gains energy until the engine resets the state; or oscillates with another frequency than the
one its constants give.

Use instead: a smaller time step, `integrator="discrete"`, or an equality constraint where a rigid bond is meant.
"""

from collections.abc import Iterator

import numpy as np

from ...compiled.view import ModelView
from ...harm import Measured, diverged
from ...problem import Problem

CODE = "WM114"
SEVERITY = "warning"
SCOPE = "any"
SPRING = (
    "<mujoco><option timestep='{0}' integrator='{1}'/><worldbody><body><joint name='j' type='slide' axis='1 0 0' "
    "stiffness='2e6' springref='.01'/><geom size='.05' mass='1'/></body></worldbody></mujoco>"
)
GOOD = (SPRING.format("0.0004", "implicitfast"), SPRING.format("0.002", "discrete"))
BAD = (SPRING.format("0.002", "implicitfast"), SPRING.format("0.0008", "Euler"))
EVIDENCE = Measured("the spring explodes and the engine resets the state", diverged, 0.5, "resets")
UNSTABLE, UNRESOLVED = 2.0, 0.6


def check(view: ModelView) -> Iterator[Problem]:
    """Check joint springs by their degree of freedom, then tendon springs."""
    if view.integrator == "discrete" or "spring" in view.disabled:
        return
    step = view.time_step
    for joint, stiffness in enumerate(view.jnt_stiffness):
        if stiffness > 0:
            weight = float(view.dof_invweight0[int(view.jnt_dofadr[joint])])
            yield from _problems(view, "joint", joint, step * float(np.sqrt(stiffness * weight)))
    for tendon, stiffness in enumerate(view.tendon_stiffness):
        if stiffness > 0:
            weight = float(view.tendon_invweight0[tendon])
            yield from _problems(view, "tendon", tendon, step * float(np.sqrt(stiffness * weight)))


def _rounded_down(step: float) -> float:
    """The largest step of two digits that is enough: rounded to the nearest, it could be the one that the world has."""
    unit = 10.0 ** (np.floor(np.log10(step)) - 1)
    return float(np.floor(step / unit * (1 + 1e-12)) * unit)


def _problems(view: ModelView, kind: str, index: int, phase: float) -> Iterator[Problem]:
    if phase <= UNRESOLVED:
        return
    step = view.time_step * UNRESOLVED / phase
    what = "blows up" if phase > UNSTABLE else "is not resolved"
    message = f"the spring of {view.name(kind, index)} {what}: {2 * np.pi / phase:.1f} steps a period"
    fix = f"shorten the step to {_rounded_down(step):g} s or less, or use integrator discrete"
    yield view.at(kind, index, message, fix, "error" if phase > UNSTABLE else "warning")

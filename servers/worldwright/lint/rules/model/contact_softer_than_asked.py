"""A contact is asked to be stiffer than the time step allows.

What it does: compares the time constant in `solref` of geoms and equalities with twice the time step, below which the
engine silently clamps it (`refsafe`).

Why is this bad: what is written has no effect. The contact is as soft as the clamp makes it, sinks deeper than asked,
and a change of the time step changes the material.

Use instead: a time constant of at least two steps (`worldkit.contacts.surface(time_constant=2 * TIME_STEP)`), or a
smaller time step.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Measured, after
from ...problem import Problem

CODE = "WM113"
SEVERITY = "warning"
SCOPE = "any"
BALL = (
    "<mujoco><option timestep='{0}'/><worldbody><geom type='plane' size='5 5 .1' solref='{1} 1'/><body pos='0 0 .3'>"
    "<freejoint/><geom size='.1' solref='{1} 1'/></body></worldbody></mujoco>"
)
GOOD = (BALL.format("0.0005", "0.001"), BALL.format("0.002", "0.02"))
BAD = (BALL.format("0.005", "0.001"),)


def _felt(source: str) -> float:
    """How far the ball's place after 0.24 s moves when the time constant is four times as long, m."""
    soft = source.replace("solref='0.001 1'", "solref='0.004 1'")
    return abs(float(after(source, 0.24)[1].qpos[2] - after(soft, 0.24)[1].qpos[2]))


EVIDENCE = Measured("a fourfold change of the time constant changes nothing", _felt, 1e-6, "m")


def check(view: ModelView) -> Iterator[Problem]:
    """Check geoms that can touch something, then active equalities; equal values are told once."""
    if "refsafe" in view.disabled or view.integrator == "discrete":
        return
    least, told = 2 * view.time_step * (1 - 1e-6), set()
    for kind, values in (("geom", view.geom_solref[:, 0]), ("equality", view.eq_solref[:, 0])):
        for index, value in enumerate(values):
            used = bool(view.collides[index]) if kind == "geom" else bool(view.eq_active0[index])
            if used and 0 < value < least and float(value) not in told:
                told.add(float(value))
                message = f"{view.name(kind, index)} asks for a time constant of {value:g} s, the step allows"
                fix = f"ask for {2 * view.time_step:g} s or more, or shorten the step to {value / 2:g} s"
                yield view.at(kind, index, f"{message} {2 * view.time_step:g} s: it is clamped", fix)

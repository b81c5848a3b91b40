"""The world compiles, but the engine refuses to step it.

What it does: takes one step of the compiled world in the sandbox and reports the engine's error.

Why is this bad: the program ends at its first step, with an error that compiling does not show: some combinations of
options (sleep without islands under the `discrete` integrator) are only refused when they are used.

Use instead: what the message names.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Raises
from ...problem import Problem

CODE = "WM103"
SEVERITY = "error"
SCOPE = "any"
CRATE = (
    "<mujoco><option integrator='discrete'><flag sleep='enable' island='{0}'/></option><worldbody><body><freejoint/>"
    "<geom size='1'/></body></worldbody></mujoco>"
)
GOOD = (CRATE.format("enable"),)
BAD = (CRATE.format("disable"),)
EVIDENCE = Raises("sleep without islands")


def check(view: ModelView) -> Iterator[Problem]:
    """Check the engine's words."""
    if view.outcome.status != "compiled" or not view.forward:
        return
    said = " ".join(view.forward.split())
    yield view.of_world(f"the first step fails: {said}", "correct what the message names", "integrator", "flag")

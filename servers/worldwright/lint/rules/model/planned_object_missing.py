"""An object of the plan is not in the compiled world.

What it does: looks for every scene object and asset instance of the plan among the names of the compiled bodies, geoms
and flexes.

Why is this bad: the plan promises it; every check on it would look at nothing. Reading the source can be deceived by a
name in a string; the compiled world cannot.

Use instead: build it under the plan's name, or take it out of the plan.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Argued
from ...problem import Problem
from ._planned import HEAD, THREE

CODE = "WM150"
SEVERITY = "error"
SCOPE = "plan"
GOOD = (THREE,)
BAD = (THREE.replace("name='mug'", "name='cup'"), HEAD + "</worldbody></mujoco>")
EVIDENCE = Argued("the harm is that nothing can be measured of what is not there; no run shows an absence")


def check(view: ModelView) -> Iterator[Problem]:
    """Check every object name of the plan."""
    assert view.plan is not None
    names = view.texts["names"]
    there = {*names["body"], *names["geom"], *names["flex"]}
    for name in view.plan.object_names():
        if name not in there:
            message = f"`{name}` of the plan is not in the compiled world"
            yield view.of_world(message, f"build it under the name {name}", name, "build")

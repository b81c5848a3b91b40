"""The model that runs is not the one that the program built last.

What it does: remembers what was changed after a specification was compiled, and which model and data are stepped
after a recompilation.

Why is this bad: walls that are not there; a load that weighs nothing.

Use instead: compile after the last change; `model, data = spec.recompile(model, data)`.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR117"
SEVERITY = "error"
HEAD = """\
import mujoco
import numpy as np
"""
GOOD = (
    HEAD
    + """\
spec = mujoco.MjSpec()
spec.worldbody.add_geom(size=[.1, 0, 0])
spec.worldbody.add_geom(size=[.1, 0, 0], pos=[1, 0, 0])
model = spec.compile()
mujoco.mj_step(model, mujoco.MjData(model))
answer = model.ngeom
""",
)
BAD = (
    HEAD
    + """\
spec = mujoco.MjSpec()
spec.worldbody.add_geom(size=[.1, 0, 0])
model = spec.compile()
spec.worldbody.add_geom(size=[.1, 0, 0], pos=[1, 0, 0])
mujoco.mj_step(model, mujoco.MjData(model))
answer = model.ngeom
""",
)
EVIDENCE = Measured("a geom is missing", answer, 0.5)


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "edited_too_late",
        "the specification is changed after it was compiled, and the model that runs does not have it",
        "change it before compile(), or compile again",
    )
    yield from run.say(
        "recompiled_in_vain",
        "recompile returns a new model and data, and the old ones are stepped on",
        "write: model, data = spec.recompile(model, data)",
    )

"""The program stops with an exception.

What it does: runs the program in the sandbox and names the line where it stopped, when it stops the same way without
being watched. A missing package or file, or a machine without pictures, is no finding.

Why is this bad: nothing after that line happens.

Use instead: what the message names; `worldwright retrieve breaking_changes WORD` tells what became of a name.
"""

from collections.abc import Iterator

from ...harm import Raises
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR101"
SEVERITY = "error"
SAID_BY_NAMES = True
HEAD = """\
import mujoco
import numpy as np
model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><geom name="floor" type="plane" size="5 5 .1"/>'
    '<body name="ball" pos="0 0 1"><freejoint name="ball"/><geom name="ball" size=".1"/></body>'
    '<body name="arm" pos="2 0 1" euler="0 0 40"><joint name="arm" axis="0 1 0"/><geom name="arm" type="capsule" size=".03" fromto="0 0 0 .4 0 0"/>'
    '<site name="tip" pos=".4 0 0"/></body></worldbody><actuator><motor name="m" joint="arm" gear="20"/></actuator></mujoco>')
data = mujoco.MjData(model)
"""
GOOD = (
    HEAD
    + """\
mujoco.mj_step(model, data)
answer = 1.0
""",
)
BAD = (
    HEAD
    + """\
data.qpos[:] = np.zeros(3)
""",
    HEAD
    + """\
model.no_such_field
""",
)
EVIDENCE = Raises()


def check(run: Run) -> Iterator[Problem]:
    """Check how the run ended."""
    seen = run.seen
    if seen.status == "failed" and seen.lines:
        message = f"the program stops here: {seen.failure}: {seen.message[:300]}".rstrip(".")
        yield Problem(message, "correct what the message names", min(seen.lines[-1], run.lines))

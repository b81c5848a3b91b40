"""The program kills its own process.

What it does: runs the program in the sandbox; a crash inside the engine is told with the line of the program it came
from.

Why is this bad: nothing catches it: everything that was not written is lost.

Use instead: the sizes and lifetimes the call asks for; one `MjData` for each thread.
"""

from collections.abc import Iterator

from ...harm import Argued
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR102"
SEVERITY = "error"
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
answer = 1.0
""",
)
BAD = (
    HEAD
    + """\
import ctypes
ctypes.string_at(0)
""",
)
EVIDENCE = Argued("a process that dies cannot measure itself, so the test looks at how the run ended")


def check(run: Run) -> Iterator[Problem]:
    """Check how the run ended."""
    seen = run.seen
    if seen.status == "died":
        line = seen.lines[0] if seen.lines else 1
        yield Problem(
            f"the process dies here: {seen.failure}", "check sizes, lifetimes and threads", min(line, run.lines)
        )

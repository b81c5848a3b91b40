"""The order of a set of words decides what is built.

What it does: finds loops over sets of strings whose body adds or appends.

Why is this bad: the order of a set differs from run to run: actuators change places.

Use instead: `sorted(names)`, or a tuple.
"""

from collections.abc import Iterator

from ...harm import Argued
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR122"
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
names = {'a', 'b', 'c', 'd', 'e', 'f'}
row = []
for name in sorted(names):
    row.append(name)
answer = 1.0
""",
)
BAD = (
    HEAD
    + """\
names = {'a', 'b', 'c', 'd', 'e', 'f'}
row = []
for name in names:
    row.append(name)
answer = 1.0
""",
)
EVIDENCE = Argued("the order of a set changes with the process, and one process cannot show it")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "set_order",
        "the order of this set differs from run to run, and what is built with it",
        "loop over sorted(…), or use a tuple",
    )

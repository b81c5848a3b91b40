"""Several threads work on the same data.

What it does: remembers which threads call the engine with which data.

Why is this bad: the engine releases the interpreter lock: threads overwrite each other, and the process may die.

Use instead: one `MjData` for each thread; the model may be shared.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR119"
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
from concurrent.futures import ThreadPoolExecutor
def run(_):
    mine = mujoco.MjData(model)
    mujoco.mj_step(model, mine, 10)
    return mine.time
with ThreadPoolExecutor(2) as pool:
    answer = max(pool.map(run, range(6)))
""",
)
BAD = (
    HEAD
    + """\
from concurrent.futures import ThreadPoolExecutor
import time
def run(_):
    time.sleep(0.01)
    mujoco.mj_step(model, data)
    return data.time
with ThreadPoolExecutor(2) as pool:
    answer = max(pool.map(run, range(6)))
""",
)
EVIDENCE = Measured("the clock is that of all runs together", answer, 0.001, "s")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "shared_data", "several threads use the same MjData", "make one MjData for each thread, or use mujoco.rollout"
    )

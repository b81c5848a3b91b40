"""A view of the engine's memory is kept as if it were a copy.

What it does: finds the same memory set against itself, copied onto itself, or kept several times from different
times; a view that is kept to read the present state is fine.

Why is this bad: every kept value shows the last state: no motion, no difference, no way back.

Use instead: `.copy()` where the value is kept.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR106"
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
log = []
for _ in range(50):
    mujoco.mj_step(model, data)
    log.append(data.qpos.copy())
answer = np.ptp(np.array(log)[:, 2])
""",
)
BAD = (
    HEAD
    + """\
log = []
for _ in range(50):
    mujoco.mj_step(model, data)
    log.append(data.qpos)
answer = np.ptp(np.array(log)[:, 2])
""",
    HEAD
    + """\
def state():
    return {'q': data.qpos}
old = state()
mujoco.mj_step(model, data, 50)
data.qpos[:] = old['q']
""",
)
EVIDENCE = Measured("nothing moves", answer, 0.01, "m")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "kept_views",
        "`{name}` is kept without a copy: all entries are the same memory and show the last state",
        "keep {name}.copy()",
    )
    yield from run.say(
        "same_view",
        "`{name}` kept here is a view: it has changed with the state when it is compared with the present one",
        "keep {name}.copy()",
    )
    yield from run.say(
        "copied_onto_itself",
        "`{name}` is copied onto itself: what was kept on line {kept} is a view of it",
        "keep {name}.copy()",
    )

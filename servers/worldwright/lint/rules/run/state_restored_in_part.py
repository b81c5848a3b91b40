"""A state is put back only in part; the rest of it is left as it was.

What it does: compares each start from the same positions with the first one, and each `mj_setState` with the state that
was saved: velocities, activations, applied forces, plastic deformation that the program did not write. Positions that
come from a keyframe are looked at together with its controls, activations and velocities.

Why is this bad: the same episode differs, and a planner's rollouts leak into the plant.

Use instead: `mj_resetData`, or `mj_getState` and `mj_setState` with mjSTATE_INTEGRATION.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR116"
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
def end(q):
    mujoco.mj_resetData(model, data)
    data.qpos[:] = q
    mujoco.mj_step(model, data, 50)
    return data.qpos[2]
q = model.qpos0.copy()
answer = end(q) - end(q)
""",
    HEAD
    + """\
model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><body><joint name="j"/><geom size=".1"/></body></worldbody>'
    '<actuator><position joint="j" kp="5"/></actuator><keyframe><key qpos=".7" ctrl=".7"/></keyframe></mujoco>')
data = mujoco.MjData(model)
data.qpos[:] = model.key_qpos[0]
data.ctrl[:] = model.key_ctrl[0]
mujoco.mj_step(model, data)
""",
)
BAD = (
    HEAD
    + """\
def end(q):
    data.qpos[:] = q
    mujoco.mj_step(model, data, 50)
    return data.qpos[2]
q = model.qpos0.copy()
answer = end(q) - end(q)
""",
    HEAD
    + """\
model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><body><joint name="j"/><geom size=".1"/></body></worldbody>'
    '<actuator><position joint="j" kp="5"/></actuator><keyframe><key qpos=".7" ctrl=".7"/></keyframe></mujoco>')
data = mujoco.MjData(model)
data.qpos[:] = model.key_qpos[0]
mujoco.mj_step(model, data)
""",
)
EVIDENCE = Measured("two equal runs differ", answer, 0.01, "m")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "left_over",
        "the same start as before, but {name} is left over from what was run in between",
        "use mj_resetData, or save and restore the whole state",
    )
    yield from run.say(
        "state_in_part",
        "the saved state is put back without {name}, which differs",
        "save with mjSTATE_INTEGRATION (or mjSTATE_FULLPHYSICS)",
    )
    yield from run.say(
        "key_in_part",
        "the positions of a keyframe are taken, and its {name} is not",
        "use mj_resetDataKeyframe, or write {name} too",
    )

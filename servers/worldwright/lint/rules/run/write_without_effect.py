"""A value is written that the engine does not look at.

What it does: looks, at each step, at what the program wrote into the model: a range whose limit is not active,
gravity compensation without its flag, an initial value after the state was made, the frame of a body that a free joint or
mocap carries.

Why is this bad: nothing fails and nothing happens.

Use instead: also switch it on (`jnt_limited`, `flg_gravcomp`), or write what is live (`data.eq_active`).
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR113"
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
model.jnt_range[1] = [-.1, .1]
model.jnt_limited[1] = True
mujoco.mj_step(model, data, 300)
answer = data.qpos[7]
""",
    HEAD
    + """\
model.body('arm').pos[2] = 3
data.joint('ball').qpos[2] = 3
mujoco.mj_step(model, data)
""",
)
BAD = (
    HEAD
    + """\
model.jnt_range[1] = [-.1, .1]
mujoco.mj_step(model, data, 300)
answer = data.qpos[7]
""",
    HEAD
    + """\
model.body('ball').pos[2] = 3
mujoco.mj_step(model, data)
""",
)
EVIDENCE = Measured("the joint passes its limit", answer, 0.3, "rad")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "limit_not_active",
        "`{name}` is written, but `{flag}` is off: there is no limit",
        "set model.{flag} too, or give the range in the model",
    )
    yield from run.say(
        "gravcomp_not_active",
        "`body_gravcomp` is written, but the model was compiled without: nothing is compensated",
        "set model.flg_gravcomp = True",
    )
    yield from run.say(
        "initial_value_only", "`{name}` is only where a reset starts from; the state has its own", "write {live}"
    )
    yield from run.say(
        "bias_not_used",
        "the actuator has bias parameters, but its bias type is none: it is no servo",
        "set biastype to affine, or use set_to_position",
    )
    yield from run.say(
        "body_frame_unused",
        "`{name}` of a body that a free joint or mocap carries: it does not move the body",
        "write {instead}",
    )

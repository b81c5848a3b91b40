"""An angle is converted that is already converted, or not converted where it must be.

What it does: the numbers know whether the engine keeps them in radians (`qpos`, `jnt_range`, `ctrlrange`) or degrees
(`cam_fovy`), and the conversions ask them. Angles that a program computes into MJCF text are looked at where the
compiler reads degrees, and plain numbers beyond a full turn that reach a hinge, its servo or mju_axisAngle2Quat.

Why is this bad: a limit of 90 degrees becomes 1.6; nothing fails.

Use instead: compiled models are in radians except `cam_fovy`; MJCF text is in degrees unless `compiler
angle="radian"` says otherwise.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR111"
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
model.jnt_range[1] = [-1.5, 1.5]
answer = (model.jnt_range[1] * 1.0)[1]
""",
    HEAD
    + """\
data.joint('arm').qpos = np.radians(45)
data.qpos[2] = 30
data.qpos[7] = data.qpos[7] + 40 * 2 * np.pi
mujoco.mj_forward(model, data)
quat = np.zeros(4)
mujoco.mju_axisAngle2Quat(quat, np.array([0, 0, 1.0]), 4 * np.pi)
""",
    HEAD
    + """\
low, high = np.degrees(model.jnt_range[1])
inside = low <= np.degrees(data.qpos[7]) <= high
waves = [np.sin(2 * i) for i in range(20)] + [np.cos(np.radians(a)) for a in range(0, 360, 30)]
""",
)
BAD = (
    HEAD
    + """\
model.jnt_range[1] = [-1.5, 1.5]
answer = np.deg2rad(model.jnt_range[1])[1]
""",
    HEAD
    + """\
data.joint('arm').qpos = 45
mujoco.mj_forward(model, data)
""",
    HEAD
    + """\
quat = np.zeros(4)
mujoco.mju_axisAngle2Quat(quat, np.array([0, 0, 1.0]), 90)
""",
    HEAD
    + """\
low, high = model.jnt_range[1]
inside = low <= np.degrees(data.qpos[7]) <= high
""",
    HEAD
    + """\
points = [np.cos(a) for a in range(0, 360, 30)]
""",
)
EVIDENCE = Measured("the range is 57 times too small", answer, 1.0, "rad")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say("radians_as_degrees", "`{name}` is in radians already", "leave out the conversion")
    yield from run.say("degrees_as_radians", "`{name}` is in degrees", "use np.radians({name})")
    yield from run.say(
        "radians_in_text",
        "the computed euler angles are at most {largest:.2f}: they look like radians, but the compiler reads degrees",
        'write degrees, or compiler angle="radian"',
    )
    yield from run.say(
        "degrees_for_radians",
        "{value:g} is an angle in degrees, and {name} takes radians",
        "use np.radians({value:g})",
    )
    yield from run.say(
        "degrees_meet_radians",
        "an angle in degrees is compared or added with `{name}`, which is in radians",
        "leave both in radians",
    )

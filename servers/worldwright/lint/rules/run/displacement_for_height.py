"""The coordinate of a slide joint is taken for a height.

What it does: a vertical slide joint whose body starts above the ground reads zero there; finds such a coordinate under a
name that means a height.

Why is this bad: every fall test fires at once, or never.

Use instead: `data.body(name).xpos[2]`, or a joint `ref`.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR125"
SEVERITY = "warning"
HEAD = """\
import mujoco
model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><body name="cart" pos="0 0 1.2"><joint name="z" type="slide" axis="0 0 1"/><geom size=".1"/></body></worldbody></mujoco>')
data = mujoco.MjData(model)
"""
GOOD = (
    HEAD
    + """\
def height():
    return float(data.body('cart').xpos[2])
mujoco.mj_forward(model, data)
answer = height()
""",
)
BAD = (
    HEAD
    + """\
def height():
    return float(data.joint('z').qpos[0])
mujoco.mj_forward(model, data)
answer = height()
""",
)
EVIDENCE = Measured("the height is zero", answer, 1.0, "m")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "displacement_as_height",
        "this slide joint reads 0 where its body is {lifted} m high",
        "use data.body(…).xpos[2], or add the start height",
    )

"""Half extents are taken for full ones.

What it does: sizes of boxes, and half lengths of capsules and cylinders, know what they are: halving one again, and an
area or a volume of several that nothing ever multiplies by 2, 4 or 8, are reported.

Why is this bad: a volume of an eighth, a buoyancy that carries nothing.

Use instead: `2 * model.geom_size[geom]` where the full size is meant; `8 * np.prod(size)` for the volume.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR134"
SEVERITY = "warning"
HEAD = """\
import mujoco
import numpy as np
model = mujoco.MjModel.from_xml_string('<mujoco><option gravity="0 0 0"/><worldbody><geom name="wall" type="box" pos="3 0 1" size=".1 2 2"/>'
    '<body name="arm" pos="0 0 1"><joint name="arm" axis="0 0 1"/><geom name="arm" type="box" size=".4 .2 .1" mass="1"/>'
    '<site name="tip" pos=".5 0 0"/></body></worldbody><actuator><motor name="m" joint="arm" ctrlrange="-1 1"/></actuator></mujoco>')
data = mujoco.MjData(model)
"""
GOOD = (
    HEAD
    + """\
x, y, z = 2 * model.geom_size[1]
answer = 1000 * x * y * z
""",
    HEAD
    + """\
mujoco.mj_forward(model, data)
x, y, z = model.geom_size[1]
volume = 8 * x * y * z
area = x * y
area = 4 * area
top = data.geom_xpos[1, 2] + z
""",
    HEAD
    + """\
volume = 8 * np.prod(model.geom_size[1])
""",
    HEAD
    + """\
half = model.geom_size[1]
corners = [half * s for s in (-1, 1)]
""",
)
BAD = (
    HEAD
    + """\
x, y, z = model.geom_size[1]
answer = 1000 * x * y * z
""",
    HEAD
    + """\
x, y, z = model.geom_size[1]
height = z
bottom = -height / 2
""",
    HEAD
    + """\
volume = model.geom('arm').size.prod()
""",
)
EVIDENCE = Measured("the volume is an eighth", answer, 10.0, "kg")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "half_of_half",
        "this size is a half extent already",
        "the middle is at 0, the face at the size itself; the full extent is twice that",
    )
    yield from run.say(
        "half_product",
        "half extents are multiplied to an area or a volume that is never made whole",
        "take 2 * size: four times the area, eight times the volume",
    )

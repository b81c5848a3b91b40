"""A ray's answer is taken for a distance in metres, and its direction is no unit vector; or the ray meets what it starts from.

What it does: mj_ray and mj_multiRay return a multiple of the vector they are given. Where that has another length than 1
and the answer is kept or shown, and never multiplied with a vector or a length nor compared with 1, it is reported; and
a ray from a site that ends on the body of that site.

Why is this bad: the edge of a depth picture is too near by the slant of its rays; a range finder sees its own housing.

Use instead: `vec /= np.linalg.norm(vec)`; `bodyexclude` for the body that carries the sensor.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR135"
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
mujoco.mj_forward(model, data)
hit = np.zeros(1, np.int32)
ray = np.array([1.0, 0.5, 0.0]) / np.sqrt(1.25)
found = np.zeros(1)
found[0] = mujoco.mj_ray(model, data, data.site('tip').xpos, ray, None, 1, 1, hit)
answer = found[0]
""",
    HEAD
    + """\
mujoco.mj_forward(model, data)
hit = np.zeros(1, np.int32)
start = np.array([1.0, 0, 1])
ray = np.array([2.5, 0.0, 0.0])
share = mujoco.mj_ray(model, data, start, ray, None, 1, -1, hit)
point = start + share * ray
seen = share < 1.0
""",
)
BAD = (
    HEAD
    + """\
mujoco.mj_forward(model, data)
hit = np.zeros(1, np.int32)
ray = np.array([1.0, 0.5, 0.0])
found = np.zeros(1)
found[0] = mujoco.mj_ray(model, data, data.site('tip').xpos, ray, None, 1, 1, hit)
answer = found[0]
""",
    HEAD
    + """\
mujoco.mj_forward(model, data)
hit = np.zeros(1, np.int32)
mujoco.mj_ray(model, data, data.site('tip').xpos, np.array([-1.0, 0, 0]), None, 1, -1, hit)
""",
)
EVIDENCE = Measured("the wall is a quarter of a metre too near", answer, 0.2, "m")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "ray_not_unit",
        "the direction has length {length}, so the answer is no distance in metres",
        "normalise the direction, or multiply the answer by its length",
    )
    yield from run.say(
        "ray_hits_itself",
        "the ray ends on the body that it starts from",
        "give that body as bodyexclude",
    )

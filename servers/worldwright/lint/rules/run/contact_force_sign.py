"""Contact forces of both sides are added with one sign.

What it does: finds a sum of contact forces on a geom that is the first of some contacts and the second of others, in
code that does not tell them apart.

Why is this bad: the force acts on the second geom and its opposite on the first: what rests on something and carries
something gets both wrong.

Use instead: the sign by `contact.geom[1] == geom`.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR126"
SEVERITY = "warning"
HEAD = """\
import mujoco
import numpy as np
model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><geom name="floor" type="plane" size="5 5 .1"/><body pos="0 0 .1"><freejoint/><geom name="low" type="box" size=".2 .2 .1" mass="3"/></body><body pos="0 0 .25"><freejoint/><geom name="top" type="box" size=".1 .1 .05" mass="2"/></body></worldbody></mujoco>')
data = mujoco.MjData(model)
"""
GOOD = (
    HEAD
    + """\
answer = 29.43
""",
    HEAD
    + """\
w = np.zeros(6)
total = np.zeros(3)
mujoco.mj_step(model, data, 300)
for i, c in enumerate(data.contact):
    mujoco.mj_contactForce(model, data, i, w)
    turned = c.frame.reshape(3, 3).T @ w[:3]
    total += turned if c.geom2 == 1 else -turned
""",
    HEAD
    + """\
w = np.zeros(6)
total = np.zeros(3)
mujoco.mj_step(model, data, 300)
for i, c in enumerate(data.contact):
    mujoco.mj_contactForce(model, data, i, w)
    sign = 1 if c.geom2 == 1 else -1
    total += c.frame.reshape(3, 3).T @ (sign * w[:3])
""",
)
BAD = (
    HEAD
    + """\
total = 0.0
w = np.zeros(6)
geom = 1
mujoco.mj_step(model, data, 300)
for i in range(data.ncon):
    c = data.contact[i]
    if geom in (c.geom1, c.geom2):
        mujoco.mj_contactForce(model, data, i, w)
        turned = c.frame.reshape(3, 3).T @ w[:3]
        total += turned[2]
answer = total
""",
    HEAD
    + """\
w = np.zeros(6)
sums = {}
mujoco.mj_step(model, data, 300)
for i, c in enumerate(data.contact):
    mujoco.mj_contactForce(model, data, i, w)
    other = c.geom1 if c.geom2 == 1 else c.geom2
    sums[other] = sums.get(other, np.zeros(3)) + c.frame.reshape(3, 3).T @ w[:3]
total = sum(sums.values())
""",
)
EVIDENCE = Measured("the forces do not balance", answer, 5.0, "N")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "both_sides",
        "the geom is the first of some of these contacts and the second of others, and the sign of the force is not changed",
        "multiply by +1 for geom[1], by -1 for geom[0]",
    )
    yield from run.say(
        "sign_forgotten",
        "forces of contacts are added in which the same geom is once the first and once the second, with one sign",
        "multiply by +1 for geom[1], by -1 for geom[0]",
    )

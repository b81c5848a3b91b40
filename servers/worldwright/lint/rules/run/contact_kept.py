"""A contact is read after the step that it belongs to.

What it does: a contact, or the list of them, remembers its step; reading it after another one is reported where it
was taken.

Why is this bad: the next step writes other contacts, or none, into the same memory.

Use instead: the numbers themselves: `[float(c.dist) for c in data.contact]`, right after the step.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR108"
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
data.qpos[2] = 0.09
mujoco.mj_step(model, data)
hit = [float(c.dist) for c in data.contact]
data.qpos[2] = 3
mujoco.mj_step(model, data)
answer = len(hit)
""",
)
BAD = (
    HEAD
    + """\
data.qpos[2] = 0.09
mujoco.mj_step(model, data)
hit = data.contact
data.qpos[2] = 3
mujoco.mj_step(model, data)
answer = len(hit)
""",
)
EVIDENCE = Measured("the contact is gone", answer, 0.5)


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "contact_kept",
        "this contact is read on line {read} after another step: its memory was rewritten",
        "take the numbers from it before the next step",
    )

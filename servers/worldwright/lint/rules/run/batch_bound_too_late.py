"""A derived field of a batch is bound after the calls that would have filled it.

What it does: finds `bind` of a derived field after a step that reads zero throughout.

Why is this bad: the rewards of all simulations are those of zeros.

Use instead: `bind` once, before the first step.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR128"
SEVERITY = "error"
HEAD = """\
import mujoco
import numpy as np
model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><geom name="floor" type="plane" size="5 5 .1"/>'
    '<body name="ball" pos="0 0 1"><freejoint name="ball"/><geom name="ball" size=".1"/></body>'
    '<body name="arm" pos="2 0 1" euler="0 0 40"><joint name="arm" axis="0 1 0"/><geom name="arm" type="capsule" size=".03" fromto="0 0 0 .4 0 0"/>'
    '<site name="tip" pos=".4 0 0"/></body></worldbody><actuator><motor name="m" joint="arm" gear="20"/></actuator></mujoco>')
data = mujoco.MjData(model)
from mujoco import batch
sims = batch.Batch(model, nsim=2, nthread=1)
"""
GOOD = (
    HEAD
    + """\
tip = sims.bind('site_xpos')
sims.step()
answer = tip[0, 0, 0]
""",
)
BAD = (
    HEAD
    + """\
sims.step()
tip = sims.bind('site_xpos')
answer = tip[0, 0, 0]
""",
)
EVIDENCE = Measured("the tip is at the origin", answer, 0.3, "m")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "bound_too_late",
        "`{name}` is bound after the steps: it reads zero until the next call",
        "bind it before the first step",
    )

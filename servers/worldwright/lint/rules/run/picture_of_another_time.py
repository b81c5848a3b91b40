"""A picture is rendered of a scene that was not updated.

What it does: compares the step of `update_scene` with the step at which `render` is called again.

Why is this bad: every frame of the video is the first.

Use instead: `renderer.update_scene(data, camera)` before each `render()`.
"""

from collections.abc import Iterator

from ...harm import Argued
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR120"
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
answer = 1.0
""",
)
BAD = (
    HEAD
    + """\
class Frames:
    pass
with mujoco.Renderer(model, 20, 20) as renderer:
    renderer.update_scene(data)
    frames = []
    for _ in range(3):
        mujoco.mj_step(model, data, 100)
        frames.append(renderer.render())
answer = 1.0
""",
)
EVIDENCE = Argued(
    "rendering needs a graphics library that not every machine has, so the test-suite measures frames elsewhere"
)


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "picture_not_updated",
        "the state was stepped since update_scene: the picture is the old one",
        "call renderer.update_scene(data, …) before each render()",
    )

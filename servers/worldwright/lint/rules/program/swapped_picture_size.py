"""Width and height of a picture are swapped.

What it does: finds `mujoco.Renderer(model, 640, 480)` and other usual sizes with the larger number first.

Why is this bad: the parameters are height, then width: the picture is 640 high and 480 wide, upright and squeezed at its
sides, or larger than the buffer.

Use instead: `mujoco.Renderer(model, height=480, width=640)`.
"""

from collections.abc import Iterator

from ...harm import Measured, executed
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL149"
SEVERITY = "warning"
SCOPE = "any"
HEAD = "import mujoco\nmodel = mujoco.MjModel.from_xml_string('<mujoco/>')\n"
GOOD = (HEAD + "r = mujoco.Renderer(model, 240, 320)\n", HEAD + "r = mujoco.Renderer(model, height=320, width=240)\n")
BAD = (HEAD + "r = mujoco.Renderer(model, 320, 240)\n",)
USUAL = {
    (320, 240),
    (640, 360),
    (640, 480),
    (800, 600),
    (960, 540),
    (1024, 768),
    (1280, 720),
    (1920, 1080),
    (3840, 2160),
}


def _upright(source: str) -> float:
    """Height over width of the picture."""
    space = executed(source)
    space["data"] = space["mujoco"].MjData(space["model"])
    with space["r"] as renderer:
        renderer.update_scene(space["data"])
        picture = renderer.render()
    return float(picture.shape[0] / picture.shape[1])


EVIDENCE = Measured("the picture is upright", _upright, 0.3, "")


def check(program: Program) -> Iterator[Problem]:
    """Check sizes given by position."""
    for _, call in program.calls("mujoco.Renderer"):
        size = tuple(program.value(argument) for argument in call.args[1:3])
        if size in USUAL:
            message = f"the picture is {size[0]} high and {size[1]} wide: height comes first"
            yield at(call, message, f"write height={size[1]}, width={size[0]}")

"""A picture is asked for that is larger than the offscreen buffer.

What it does: compares the size given to `mujoco.Renderer` with `offwidth` and `offheight`, 640 x 480 by default, in
programs whose whole model stands in the source.

Why is this bad: the renderer refuses: "Image width 1280 > framebuffer width 640".

Use instead: `<visual><global offwidth="1280" offheight="720"/></visual>`, or
`spec.visual.global_.offwidth = 1280`.
"""

import ast
from collections.abc import Iterator

from ...harm import Raises
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL148"
SEVERITY = "error"
SCOPE = "any"
PICTURE = "import mujoco\nmodel = mujoco.MjModel.from_xml_string('<mujoco>{0}</mujoco>')\nrenderer = mujoco.Renderer(model, {1})\n"
GOOD = (
    PICTURE.format("", "480, 640"),
    PICTURE.format('<visual><global offwidth="1280" offheight="720"/></visual>', "720, 1280"),
)
BAD = (PICTURE.format("", "720, 1280"), PICTURE.format("", "height=480, width=800"))
EVIDENCE = Raises("framebuffer")
DEFAULT = {"height": 480, "width": 640}


def check(program: Program) -> Iterator[Problem]:
    """Check sizes that are known."""
    if not program.whole_model:
        return
    given = {n.attr for n in program.nodes(ast.Attribute)} & {"offwidth", "offheight"}
    if given or any({"offwidth", "offheight"} & set(tag.attributes) for tag in program.tags()):
        return
    for _, call in program.calls("mujoco.Renderer"):
        for position, (word, most) in enumerate(DEFAULT.items(), 1):
            value = program.value(program.argument(call, word, position))
            if isinstance(value, int) and value > most:
                message = f"a picture {word} of {value} exceeds the offscreen buffer's {most}"
                yield at(call, message, f"set visual/global/off{word} to {value}")
                break

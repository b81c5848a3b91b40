"""A camera stands inside a solid.

What it does: tests the position of every camera against the visible boxes, spheres, capsules, cylinders and ellipsoids
(a mesh may be hollow).

Why is this bad: a solid is not drawn from inside: what the camera stands in is missing from the picture, or hides
everything else.

Use instead: a position outside; `worldkit.cameras.add` finds one for a named view.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Measured, pixels
from ...problem import Problem

CODE = "WM131"
SEVERITY = "error"
SCOPE = "any"
CUBE = (
    "<mujoco><worldbody><camera name='eye' pos='0 {0} .5' xyaxes='1 0 0 0 0 1'/>"
    "<geom name='cube' type='box' pos='0 0 .5' size='.5 .5 .5'/></worldbody></mujoco>"
)
GOOD = (CUBE.format("-3"),)
BAD = (CUBE.format("-.2"),)
EVIDENCE = Measured("the cube is not in the picture", pixels, 0.05, "of the picture")


def check(view: ModelView) -> Iterator[Problem]:
    """Check every camera that something contains."""
    for camera, geom in enumerate(view.camera_inside):
        if geom >= 0:
            message = f"camera {view.name('camera', camera)} stands inside {view.name('geom', geom)}"
            yield view.at("camera", camera, message, "move it out, or name a view and let worldkit place it")

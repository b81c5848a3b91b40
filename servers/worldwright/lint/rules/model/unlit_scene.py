"""Nothing lights the scene.

What it does: adds up the lights that are on and the headlight; finds worlds where all of it is nearly black.

Why is this bad: pictures and films show silhouettes, and nobody can review them.

Use instead: a light, or the default headlight; `worldkit.scene.new` brings both.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Measured, brightness
from ...problem import Problem

CODE = "WM130"
SEVERITY = "warning"
SCOPE = "any"
ROOM = (
    "<mujoco><visual><headlight {0}/></visual><worldbody>{1}<camera pos='0 -2 1' xyaxes='1 0 0 0 .45 .9'/>"
    "<geom type='plane' size='5 5 .1' rgba='.8 .8 .8 1'/><geom size='.3' pos='0 0 .3' rgba='.9 .5 .4 1'/></worldbody></mujoco>"
)
GOOD = (ROOM.format("", ""), ROOM.format("active='0'", "<light pos='0 0 3' diffuse='.8 .8 .8'/>"))
BAD = (ROOM.format("active='0'", ""), ROOM.format("ambient='0 0 0' diffuse='.01 .01 .01'", "<light active='false'/>"))
EVIDENCE = Measured("the picture is black", brightness, 30.0, "of 255", bad=1)
LEAST = 0.08


def check(view: ModelView) -> Iterator[Problem]:
    """Check the brightest channel of all light together."""
    total = float(view.headlight_colour.sum(axis=0).max()) if view.headlight else 0.0
    for light, on in enumerate(view.light_active):
        if on:
            total += float((view.light_diffuse[light] + view.light_ambient[light]).max())
    if total < LEAST and view.visible.any():
        yield view.of_world("nothing lights the scene", "add a light, or leave the headlight on", "headlight", "light")

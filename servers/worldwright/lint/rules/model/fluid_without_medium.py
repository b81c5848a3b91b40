"""Drag or wind is asked for in a world without air.

What it does: finds `fluidshape`, or a `wind`, while the world's `density` and `viscosity` are zero, their default.

Why is this bad: nothing drags, nothing is blown away: the wind has nothing to push with.

Use instead: `<option density="1.2" viscosity="1.8e-5"/>` for air, 1000 and 1e-3 for water.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Measured, after
from ...problem import Problem

CODE = "WM126"
SEVERITY = "error"
SCOPE = "any"
LEAF = (
    "<mujoco><option {0}/><worldbody><body name='leaf' pos='0 0 2'><freejoint/>"
    "<geom type='ellipsoid' size='.05 .05 .002' mass='.001' fluidshape='ellipsoid'/></body></worldbody></mujoco>"
)
GOOD = (LEAF.format("density='1.2' viscosity='1.8e-5' wind='3 0 0'"), "<mujoco><option density='1.2'/></mujoco>")
BAD = (LEAF.format("wind='3 0 0'"), LEAF.format(""))
EVIDENCE = Measured("the wind does not move the leaf", lambda s: float(after(s, 0.5)[1].qpos[0]), 0.05, "m")


def check(view: ModelView) -> Iterator[Problem]:
    """Check, where there is no medium, the wind and then the shapes that should feel it."""
    if view.density > 0 or view.viscosity > 0:
        return
    fix = "set the world's density and viscosity, e.g. 1.2 and 1.8e-5 for air"
    if view.wind.any():
        yield view.of_world("the wind blows in a vacuum: density and viscosity are 0", fix, "wind")
    for geom in range(len(view.geom_bodyid)):
        if view.geom_fluid[geom].any() and not view.wind.any():
            message = f"{view.name('geom', geom)} has a fluid shape in a vacuum: density and viscosity are 0"
            yield view.at("geom", geom, message, fix)
            return

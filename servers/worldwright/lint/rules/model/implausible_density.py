"""A moving body is heavier than any metal, or lighter than any gas.

What it does: divides the mass of each body by the volume of its geoms (of a mesh: of the box around it), and compares
with the densest element, osmium, 22,590 kg/m^3, and with hydrogen, 0.09 kg/m^3.

Why is this bad: grams were taken for kilograms, half sizes for full ones, or millimetres for metres. Whatever it meets
is thrown about, or throws it.

Use instead: a mass from a source, or `density` in kg/m^3.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Argued
from ...problem import Problem

CODE = "WM110"
SEVERITY = "error"
SCOPE = "any"
GOOD = (
    "<mujoco><worldbody><body><freejoint/><geom size='.02' mass='.25'/></body></worldbody></mujoco>",
    "<mujoco><worldbody><geom size='.02' mass='1000'/></worldbody></mujoco>",
)
BAD = (
    "<mujoco><worldbody><body><freejoint/><geom size='.02' mass='250'/></body></worldbody></mujoco>",
    "<mujoco><worldbody><body><freejoint/><geom type='box' size='1 1 1' mass='.0005'/></body></worldbody></mujoco>",
)
EVIDENCE = Argued("the engine simulates any mass; only comparison with matter tells that it cannot be meant")
DENSEST, THINNEST = 22_590.0, 0.09


def check(view: ModelView) -> Iterator[Problem]:
    """Check bodies with degrees of freedom and geoms that have a volume."""
    for body in range(1, len(view.body_mass)):
        first, count = int(view.body_geomadr[body]), int(view.body_geomnum[body])
        volume = float(view.geom_volume[first : first + count].sum()) if count else 0.0
        if not view.moving[body] or volume <= 0 or view.body_mass[body] <= 0:
            continue
        density = float(view.body_mass[body]) / volume
        if density > DENSEST or density < THINNEST:
            what = "denser than any metal" if density > DENSEST else "thinner than hydrogen"
            message = f"{view.name('body', body)} weighs {view.body_mass[body]:g} kg in {volume:.3g} m^3: {what}"
            yield view.at("body", body, f"{message} ({density:.3g} kg/m^3)", "check its mass (kg) and its size (m)")

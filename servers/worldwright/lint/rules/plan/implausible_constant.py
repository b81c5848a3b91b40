"""A physical constant is outside of what nature offers.

What it does: checks densities (0.05 to 22,600 kg/m^3), sliding friction (up to 4), rolling and torsional friction (up to
0.1 and 1 m), masses, and gravity (downwards, up to 30 m/s^2).

Why is this bad: a density of 0.7 is g/cm^3; a gravity of 9.81 points up. The world simulates all the same, and everything
comes out wrong.

Use instead: SI units: 700 kg/m^3, -9.81 m/s^2.
"""

from collections.abc import Iterator

from ...case import Changes
from ...harm import Measured
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP118"
SEVERITY = "error"
SOURCE = "engineering tables"
GOOD: Changes = ({}, {"simulation_parameters": {"gravity": -1.62}}, {"simulation_parameters": {"gravity": 0.0}})
BAD: Changes = (
    {"simulation_parameters": {"gravity": 9.81}},
    {"simulation_parameters": {"materials": {"wood": {"density": 0.02, "source": SOURCE}}}},
    {"simulation_parameters": {"materials": {"wood": {"friction": 30, "source": SOURCE}}}},
    {"simulation_parameters": {"masses": {"mug": 0.0}}},
)


def _height_m(change: dict) -> float:
    """The height of a body after half a second of the case's gravity, m."""
    from ...harm import height_after

    gravity = change["simulation_parameters"]["gravity"]
    ball = "<worldbody><body><freejoint/><geom size='.1'/></body></worldbody>"
    return height_after(f"<mujoco><option gravity='0 0 {gravity}'/>{ball}</mujoco>", 0.5)


EVIDENCE = Measured("everything falls to the sky", _height_m, 1.0, "m", good=1)
RANGES = {
    "density": (0.05, 22_600.0, "kg/m^3"),
    "friction": (0.0, 4.0, ""),
    "torsional_friction": (0.0, 1.0, "m"),
    "rolling_friction": (0.0, 0.1, "m"),
}
MOST_GRAVITY = 30.0


def check(view: PlanView) -> Iterator[Problem]:
    """Check materials, masses, gravity."""
    parameters, section = view.plan.simulation_parameters, "simulation_parameters"
    for name, row in parameters.materials.items():
        for word, (low, high, unit) in RANGES.items():
            value = getattr(row, word)
            if value is not None and not low <= value <= high:
                message = f"{word} of {name} is {value:g} {unit}".rstrip()
                yield view.at(
                    (section, "materials", name, word), message, f"expected {low:g} to {high:g} {unit}".rstrip()
                )
    for name, mass in parameters.masses.items():
        if not 0 < mass < 1e7:
            yield view.at((section, "masses", name), f"{name} weighs {mass:g} kg", "give its mass in kg")
    gravity = parameters.gravity_vector
    if gravity[2] > 0 or max(map(abs, gravity)) > MOST_GRAVITY:
        shown = ", ".join(f"{g:g}" for g in gravity)
        yield view.at((section, "gravity"), f"gravity is ({shown}) m/s^2", "write -9.81, the acceleration along +z")

"""The whole world obeys a law that is not the plan's.

What it does: compares the options of the compiled world with those of the plan's draft: switched-off parts of physics,
overridden contacts, the medium (density, viscosity, wind), the magnetic field, `impratio`, friction without slip, actuators
that are switched off, how carefully the solver works, and when bodies may sleep.

Why is this bad: one option changes every contact or every joint at once. A medium brakes, an override replaces all friction,
a solver that stops after one iteration makes everything soft.

Use instead: leave options as `scene.new` sets them; a medium's density, viscosity and wind are `simulation_parameters.medium`.
No constant fills the world: `oil_viscosity` may speak of a can on a shelf.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from ....compiled.view import ModelView
from ....harm import Measured, after
from ....problem import Problem
from ._twins import SOUND, changed, shown, stated

CODE = "WM161"
SEVERITY = "error"
SCOPE = "acts"
OVERRIDE = (
    "spec.option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_OVERRIDE)",
    "spec.option.o_friction = [1e-4] * 5",
)
MEDIUM_OF = {"medium": {"density": 1.2, "wind": [3, 0, 0], "source": "a table"}}


def _in_air(*lines: str, medium: Mapping[str, object] = MEDIUM_OF) -> tuple[str, dict[str, object]]:
    """A case whose plan has its air and wind itself, or no medium, and constants about others."""
    text, plan = changed(*lines)
    others = {"water_density": (1000, "kg/m^3"), "oil_viscosity": (3, "Pa*s"), "wind_speed": (3, "m/s")}
    constants = {name: {"value": value, "unit": unit, "source": "a table"} for name, (value, unit) in others.items()}
    return text, plan | {
        "simulation_parameters": plan["simulation_parameters"] | dict(medium) | {"constants": constants}  # type: ignore[operator]
    }


AIRED = ("spec.option.density, spec.option.viscosity = 1.2, 1.8e-5", "spec.option.wind = (3, 0, 0)")
GOOD = (
    *SOUND,
    _in_air(*AIRED),
)
BAD = (
    _in_air(AIRED[0], "spec.option.wind = (-3, 0, 0)"),
    _in_air(AIRED[1], "spec.option.density, spec.option.viscosity = 1000, 1.8e-5"),
    changed("spec.option.density = 1.2"),
    _in_air("spec.option.density = 1000", medium={}),
    _in_air("spec.option.viscosity = 3", medium={}),
    _in_air("spec.option.wind = (3, 0, 0)", medium={}),
    changed("spec.option.impratio = 50"),
    changed("spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_DAMPER)"),
    changed(*OVERRIDE),
    changed("spec.option.noslip_iterations = 10"),
    changed("spec.option.iterations = 1"),
    changed("spec.option.ls_iterations = 1"),
    changed("spec.option.ccd_tolerance = 0.01"),
    changed("spec.option.solver = mujoco.mjtSolver.mjSOL_PGS"),
    changed("spec.option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)"),
    changed("spec.option.disableactuator = 1"),
    changed("spec.option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SLEEP)", "spec.option.sleep_tolerance = 0.5"),
)
EVIDENCE = Measured(
    "the crate slides without friction",
    lambda s: float(after(s, 1.0)[1].body("crate").xpos[0]),
    0.1,
    "m",
    bad=changed(*OVERRIDE)[0],
    good=changed()[0],
)
PHYSICS_OFF = [
    "constraint",
    "equality",
    "frictionloss",
    "limit",
    "contact",
    "spring",
    "damper",
    "gravity",
    "clampctrl",
    "filterparent",
    "actuation",
    "refsafe",
    "eulerdamp",
    "nativeccd",
    "multiccd",
]
PHYSICS_ON = {
    "override": "replaces the parameters of every contact",
    "ipc": "replaces every contact by a barrier",
    "speculative": "makes bodies touch before they meet",
}
MEDIUM = (("density", "kg/m^3"), ("viscosity", "Pa s"))
CAREFUL = {"iterations": 100, "ls_iterations": 50, "ccd_iterations": 35, "sdf_iterations": 10}
EXACT = {"tolerance": 1e-8, "ls_tolerance": 0.01, "ccd_tolerance": 1e-6}
SLEEP = 1e-3
"""MuJoCo's own values, which are careful enough; and the speed, m/s, below which it lets a body sleep."""
METHODS = ("solver", "cone")


def check(view: ModelView) -> Iterator[Problem]:
    """Check option by option."""
    assert view.planned is not None and view.plan is not None
    built, planned = view.option, view.planned.option
    for flag in PHYSICS_OFF:
        if flag in view.disabled and flag not in view.planned.disabled:
            yield view.of_world(f"`{flag}` is switched off for the whole world", "leave it on", "disableflags")
    for flag, effect in PHYSICS_ON.items():
        if flag in view.enabled and flag not in view.planned.enabled:
            yield view.of_world(f"`{flag}` {effect}", "leave it off", "enableflags")
    where = "the plan's medium, simulation_parameters.medium, is all that fills the world: build it as drafted"
    for name, unit in MEDIUM:
        if not np.isclose(built[name], planned[name], rtol=1e-3, atol=0.0):
            message = f"the medium has a {name} of {shown(built[name])} {unit}, by the plan {shown(planned[name])}"
            yield view.of_world(message, where, name)
    if not np.allclose(built["wind"], planned["wind"]):
        message = f"a wind of {shown(built['wind'])} m/s blows, by the plan {shown(planned['wind'])}"
        yield view.of_world(message, where, "wind")
    if not np.isclose(built["impratio"], planned["impratio"], rtol=1e-3):
        message = f"impratio is {built['impratio']:g}, by the plan {planned['impratio']:g}"
        yield view.of_world(message, "set it in simulation_parameters.impratio", "impratio")
    if built["noslip_iterations"] and not stated(view.plan, built["noslip_iterations"], "noslip"):
        message = "a second solver takes the slip out of every contact (noslip_iterations)"
        yield view.of_world(message, "leave it at 0, or raise the plan's impratio", "noslip_iterations")
    if built["disableactuator"] != planned["disableactuator"]:
        yield view.of_world("a group of actuators is switched off", "leave out what does not act", "disableactuator")
    yield from _careful(view)


def _careful(view: ModelView) -> Iterator[Problem]:
    """The solver, and sleep."""
    assert view.planned is not None
    built, planned = view.option, view.planned.option
    for name, enough in CAREFUL.items():
        if built[name] < min(planned[name], enough):
            message = f"the solver stops after {name} = {built[name]}, so that constraints give way"
            yield view.of_world(message, f"leave it at {planned[name]}", name)
    for name, careful in EXACT.items():
        if built[name] > max(planned[name], careful) * 1.001:
            message = f"the solver is content with a {name} of {built[name]:g}"
            yield view.of_world(message, f"leave it at {planned[name]:g}", name)
    for name in METHODS:
        if built[name] != planned[name]:
            yield view.of_world(f"the {name} is another than the plan's", "leave it as scene.new sets it", name)
    if "sleep" in view.enabled and built["sleep_tolerance"] > SLEEP:
        message = f"bodies fall asleep while they still move at {built['sleep_tolerance']:g}"
        yield view.of_world(message, f"leave sleep_tolerance at {SLEEP:g}", "sleep_tolerance")

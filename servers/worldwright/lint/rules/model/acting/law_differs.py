"""The whole world obeys a law that is not the plan's.

What it does: compares the options of the compiled world with those of the plan's draft: switched-off parts of physics,
overridden contacts, the medium (density, viscosity, wind), the magnetic field, `impratio`, friction without slip, actuators
that are switched off, how carefully the solver works, and when bodies may sleep.

Why is this bad: one option changes every contact or every joint at once. A medium brakes, an override replaces all friction,
a solver that stops after one iteration makes everything soft.

Use instead: leave options as `scene.new` sets them; a medium's density, viscosity and wind are `simulation_parameters.medium`. A plan
without one may have them as constants (`air_density`, `wind_speed` …), which this rule then knows.
"""

from collections.abc import Iterator

import numpy as np

from ....compiled.view import ModelView
from ....harm import Measured, after
from ....problem import Problem
from ._twins import SOUND, changed, named, shown, stated

CODE = "WM161"
SEVERITY = "error"
SCOPE = "acts"
AIR = {"simulation_parameters": {"constants": {"air_density": {"value": 1.2, "unit": "kg/m^3", "source": "a table"}}}}
_SAID = changed("spec.option.density = 1.2")
OVERRIDE = (
    "spec.option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_OVERRIDE)",
    "spec.option.o_friction = [1e-4] * 5",
)
MEDIUM_OF = {"medium": {"density": 1.2, "wind": [3, 0, 0], "source": "a table"}}


def _in_air(*lines: str) -> tuple[str, dict[str, object]]:
    """A case whose plan has its air and wind itself, and constants about others."""
    text, plan = changed(*lines)
    other = {"value": 1000, "unit": "kg/m^3", "source": "a table"}
    constants = {"water_density": other, "wind_speed": {"value": 3, "unit": "m/s", "source": "a table"}}
    return text, plan | {
        "simulation_parameters": plan["simulation_parameters"] | MEDIUM_OF | {"constants": constants}  # type: ignore[operator]
    }


AIRED = ("spec.option.density, spec.option.viscosity = 1.2, 1.8e-5", "spec.option.wind = (3, 0, 0)")
GOOD = (
    *SOUND,
    _in_air(*AIRED),
    (_SAID[0], _SAID[1] | {"simulation_parameters": _SAID[1]["simulation_parameters"] | AIR["simulation_parameters"]}),  # type: ignore[operator]
)
BAD = (
    _in_air(AIRED[0], "spec.option.wind = (-3, 0, 0)"),
    _in_air(AIRED[1], "spec.option.density, spec.option.viscosity = 1000, 1.8e-5"),
    changed("spec.option.density = 1.2"),
    changed("spec.option.wind = (3, 0, 0)"),
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
MEDIA = ("air", "water", "medium", "fluid", "atmosphere", "gas", "liquid", "sea")
"""Words for what a world can be filled with: `air_density` in a plan speaks of the medium, `wood_density` does not."""
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
    owned = view.plan.simulation_parameters.medium is not None
    for name, unit in MEDIUM:
        words = (name, *(f"{medium}_{name}" for medium in MEDIA), *(f"{name}_of_{medium}" for medium in MEDIA))
        if owned:  # the plan has the medium itself: no constant of that name speaks for another
            said = bool(np.isclose(built[name], planned[name], rtol=1e-3, atol=0.0))
            message = f"the medium has a {name} of {shown(built[name])} {unit}, by the plan {shown(planned[name])}"
            if not said:
                yield view.of_world(message, "leave simulation_parameters.medium as drafted", name)
            continue
        # Only what flows has a viscosity; anything has a density.
        said = stated(view.plan, built[name], name) if name == "viscosity" else named(view.plan, built[name], *words)
        if built[name] != planned[name] and not said:
            message = (
                f"the world is filled with a medium of {name} {shown(built[name])} {unit}, which the plan does not say"
            )
            yield view.of_world(message, f"add it to the plan as a constant, e.g. `air_{name}`", name)
    wind = float(np.linalg.norm(built["wind"]))
    if not np.allclose(built["wind"], planned["wind"]) and (owned or not stated(view.plan, wind, "wind")):
        message = f"a wind of {shown(built['wind'])} m/s blows, which the plan does not say"
        yield view.of_world(message, "add it to the plan: simulation_parameters.medium.wind", "wind")
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

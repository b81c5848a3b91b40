"""The world is lit otherwise than its plan says.

What it does: where the plan states a sun, a sky or lamps, compares what the program states of them with the plan's draft: height,
direction, colour and strength of the light, the sky; and each lamp's body, place, colour and strength.

Why is this bad: shadows fall another way and are of another length than what was approved, and pictures are judged by them. (A
`film.py` may light its film otherwise; its statement lists that.)

Use instead: `worldkit.lights.add` and `worldkit.lights.lamp` with the plan's numbers, as the draft has them.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from ....compiled.view import ModelView
from ....harm import Measured, model_of
from ....problem import Problem
from ._twins import HAND_MADE, PLAN, SOUND, shown

CODE = "WM173"
SEVERITY = "error"
SCOPE = "acts"
LIT: dict[str, object] = {
    **PLAN,
    "visualization": {
        "setting": "outdoor",
        "sun": {"azimuth": 120, "elevation": 20},
        "lamps": [{"name": "torch", "on": "crate", "at": [0, 0, 0.2], "strength": 0.5}],
    },
}
SUN = "lights.add(spec, sky='clear', azimuth_deg={}, elevation_deg={})"
LAMP = "lights.lamp(spec, '{}', (0, 0, {}), strength={}, to='{}')"


def lit(
    sun: str = SUN.format(120, 20), lamp: str = LAMP.format("torch", 0.2, 0.5, "crate")
) -> tuple[str, dict[str, object]]:
    """A case with this sun and this lamp."""
    lines = [line for line in ("from worldkit import lights", sun, lamp) if line]
    return HAND_MADE.replace("    CHANGES\n", "".join(f"    {line}\n" for line in lines)), LIT


LOW = lit(SUN.format(120, 12))
GOOD = (*SOUND, lit())
BAD = (
    LOW,
    lit(SUN.format(90, 20)),
    lit(SUN.format(120, 20).replace(")", ", strength=0.3)")),
    lit(""),
    lit(lamp=""),
    lit(lamp=LAMP.format("torch", 0.4, 0.5, "crate")),
    lit(lamp=LAMP.format("torch", 0.2, 5.0, "crate")),
    lit(lamp=LAMP.format("torch", 0.2, 0.5, "crate") + "; spec.worldbody.add_light(pos=(0, 0, 2))"),
)


def shadow(source: str) -> float:
    """Length of the shadow of a stick of one metre, m."""
    from math import radians, tan

    from worldkit import lights

    return 1.0 / tan(radians(float(lights.of(model_of(source))["light_elevation_deg"])))


EVIDENCE = Measured("shadows are longer", shadow, 1.0, "m", bad=LOW[0], good=lit()[0])
SETTING = "worldkit."
"""How the lights begin that a setting has of its own."""
WORDS = {
    "light_azimuth_deg": "direction",
    "light_elevation_deg": "height",
    "light_strength": "strength",
    "light_rgb": "colour",
}
NEAR_M = 2e-3
FIX = "light it as the plan says (its draft shows how), or change the plan and have it approved"


def check(view: ModelView) -> Iterator[Problem]:
    """Check what is stated of sun and sky, then the lamps."""
    planned = view.planned
    assert planned is not None
    wanted, there = _lamps(planned), _lamps(view)
    if not planned.light and not wanted:  # the plan leaves it to its setting
        return
    if planned.light and (apart := _apart(view.light, planned.light)):
        yield view.of_world(f"sun and sky are not the plan's: {apart}", FIX, "lights")
    for name, lamp in wanted.items():
        if name not in there:
            yield view.of_world(f"there is no {name.replace('.', ' ')}, which the plan has", FIX, "lights")
        elif said := _describe(view, there[name], planned, lamp):
            yield view.at("light", there[name], f"{name.replace('.', ' ')} {said}", FIX)
    for name, lamp in there.items():
        if name not in wanted:
            yield view.at("light", lamp, f"{name.replace('.', ' ')} is none of the plan's", FIX)


def _apart(here: dict[str, Any], there: dict[str, Any]) -> str:
    """What differs of two treatments; empty when they are the same."""
    if not here:
        return "the program states none"
    unlike = {n for n in here.keys() | there.keys() if not _same(here.get(n), there.get(n))}
    for name, word in WORDS.items():
        if name in unlike:
            return f"the {word} of the light is {_told(here.get(name))}, by the plan {_told(there.get(name))}"
    return f"another sky ({', '.join(sorted(unlike)[:3])})" if unlike else ""


def _same(one: Any, other: Any) -> bool:
    return one is not None and other is not None and bool(np.allclose(one, other, rtol=1e-3, atol=1e-3))


def _told(value: Any) -> str:
    return "the setting's own" if value is None else shown(value)


def _lamps(view: ModelView) -> dict[str, int]:
    lights = {view.name("light", index): index for index, on in enumerate(view.light_active) if on}
    return {name: index for name, index in lights.items() if not name.startswith(SETTING)}


def _describe(view: ModelView, lamp: int, planned: ModelView, twin: int) -> str:
    """How a lamp differs from the plan's; empty when it does not."""
    carrier, wanted = (world.name("body", int(world.light_bodyid[n])) for world, n in ((view, lamp), (planned, twin)))
    if carrier != wanted:
        return f"is on {carrier}, by the plan on {wanted}"
    if (away := float(np.linalg.norm(view.light_xpos[lamp] - planned.light_xpos[twin]))) > NEAR_M:
        return f"is {away * 1e3:.3g} mm from where the plan puts it"
    here, there = view.light_diffuse[lamp], planned.light_diffuse[twin]
    if view.light_type[lamp] != planned.light_type[twin] or not np.allclose(here, there, rtol=1e-2, atol=1e-4):
        return f"shines with {shown(here)}, by the plan with {shown(there)}"
    return ""

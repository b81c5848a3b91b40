"""The light and sky that a plan states, kept in the model: what pictures and films begin with, and may depart from.

    spec = scene.new("dusk", time_step=0.002, setting="outdoor")
    lights.add(spec, sky="clear", elevation_deg=8.0)
    lights.lamp(spec, "lantern", (0.0, 0.0, 0.2), to="post")

Only pictures depend on it: a light has no mass and touches nothing.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from .errors import ProgramError
from .filming.drawn_only import rgb
from .filming.moods import MOODS

if TYPE_CHECKING:
    import mujoco

TEXT = "worldkit.light"
LIGHT_GAIN = 1.5
"""MuJoCo's lights are sized for displays that clip at 1; the renderers' for a film curve."""
SKIES = ("clear", "overcast", "dusk", "night")
HIGH_DEG, LOW_DEG, SET_DEG = 45.0, 14.0, 3.0
"""Elevations of the sun at which a clear sky is as in `HIGH`, `LOW` and `SUNSET`; in between it changes evenly."""
HIGH = MOODS["noon"]
LOW: dict[str, dict[str, Any]] = {
    "light": {"elevation_deg": LOW_DEG, "colour": "#ffd6a6", "strength": 1.1, "softness_deg": 1.0},
    "sky": {"zenith": "#4a78b8", "horizon": "#ecd2b0", "ground": "#77705f", "glow": 0.8, "clouds": 0.4},
    "grade": {"exposure_stops": 0.2, "temperature": 0.03, "contrast": 1.04, "saturation": 1.03, "vignette": 0.16},
}
SUNSET: dict[str, dict[str, Any]] = {
    "light": {"elevation_deg": SET_DEG, "colour": "#ffa765", "strength": 0.85, "softness_deg": 1.0},
    "sky": {"zenith": "#46618f", "horizon": "#efac80", "ground": "#6a6058", "glow": 1.1, "clouds": 0.35},
    "grade": {"exposure_stops": 0.5, "temperature": 0.05, "contrast": 1.04, "saturation": 1.03, "vignette": 0.2},
}
DUSK: dict[str, dict[str, Any]] = {
    "light": {"elevation_deg": 24.0, "colour": "#c9b0bc", "strength": 0.07, "softness_deg": 9.0},
    "sky": {"zenith": "#22376b", "horizon": "#c79a8e", "ground": "#33343a", "glow": 0.4, "clouds": 0.3, "stars": 0.1},
    "grade": {"exposure_stops": 0.9, "contrast": 1.04, "saturation": 0.9, "temperature": -0.04, "vignette": 0.3},
}
NIGHT: dict[str, dict[str, Any]] = {
    "light": {"elevation_deg": 45.0, "colour": "#b9ccff", "strength": 0.10, "softness_deg": 2.0},
    "sky": {"zenith": "#05070f", "horizon": "#121a2c", "ground": "#0c0e12", "glow": 0.1, "stars": 1.0},
    "grade": {
        "exposure_stops": 0.6,
        "contrast": 1.04,
        "saturation": 0.75,
        "temperature": -0.06,
        "vignette": 0.35,
        "glow": 0.1,
    },
}
OTHERS = {"overcast": MOODS["overcast"], "dusk": DUSK, "night": NIGHT}
DARKEST = 0.01
"""What is left of the surroundings, which no light of a setting's own would show at all."""
NEUTRAL = {
    "grade_exposure_stops": 0.0, "grade_contrast": 1.0, "grade_saturation": 1.0, "grade_temperature": 0.0,
    "sky_glow": 0.0, "sky_clouds": 0.0, "sky_stars": 0.0, "sky_strength": 1.0,
}  # fmt: skip
"""What a stated sky does not say, which no set or mood around it may say in its stead."""
MOST_LAMP = 1000.0


def treated(
    *,
    sky: str = "",
    azimuth_deg: float | None = None,
    elevation_deg: float | None = None,
    colour: str | None = None,
    strength: float | None = None,
) -> dict[str, Any]:
    """What is stated as numbers of a picture's treatment by name (`light_…`, `sky_…`, `fog_…`, `grade_…`).

    Args:
        sky: one of `SKIES`; empty leaves the setting's own surroundings.
        azimuth_deg: where the sun stands, counter-clockwise from +x.
        elevation_deg: its height; a clear sky reddens as it sinks.
        colour: of its light, `#rrggbb`.
        strength: 1 is bright sun; without a sky, the setting's other light goes down with it.

    Raises:
        ProgramError: there is no such sky, or a number is none that a light may have.
    """
    if sky and sky not in SKIES:
        raise ProgramError(f"no sky is called {sky!r}", "light", f"use one of: {', '.join(SKIES)}")
    bounds = {
        "azimuth_deg": (azimuth_deg, -720, 720),
        "elevation_deg": (elevation_deg, 1, 90),
        "strength": (strength, 0, 10),
    }
    for name, (value, low, high) in bounds.items():
        if value is not None and not low <= value <= high:
            raise ProgramError(f"{name} of the sun lies between {low} and {high}, got {value}", "light", "")
    found: dict[str, Any] = {}
    if sky:
        found = _flat(_clear(elevation_deg) if sky == "clear" else OTHERS[sky])
        found.pop("light_azimuth_deg", None)
    elif strength is not None:  # without a sky, the setting's surroundings are as bright as its strongest light
        found["sky_strength"] = min(max(strength, DARKEST), 1.0)
    own = {
        "light_azimuth_deg": azimuth_deg, "light_elevation_deg": elevation_deg, "light_strength": strength,
        "light_rgb": None if colour is None else list(rgb(colour)),
    }  # fmt: skip
    return found | {name: value for name, value in own.items() if value is not None}


def add(spec: mujoco.MjSpec, **stated: Any) -> None:
    """State a world's light and sky, by the words of `treated`; pictures and films begin with it.

    Raises:
        ProgramError: see `treated`.
    """
    from .settings import Light

    told = {name: value for name, value in stated.items() if value not in (None, "")}
    found = treated(**told)
    for old in spec.texts:
        if old.name == TEXT:
            spec.delete(old)
    spec.add_text(name=TEXT, data=json.dumps(told))
    key = spec.light("worldkit.key")
    if key is not None and {"light_azimuth_deg", "light_elevation_deg"} & set(found):  # what MuJoCo's viewers show
        from math import asin, atan2, degrees

        x, y, z = (-float(v) for v in key.dir)
        turned = Light(
            found.get("light_azimuth_deg", degrees(atan2(y, x))),
            found.get("light_elevation_deg", degrees(asin(z))),
            (1, 1, 1),
        )
        key.dir, key.pos = [-v for v in turned.direction], [6.0 * v for v in turned.direction]


def lamp(
    spec: mujoco.MjSpec,
    name: str,
    pos: tuple[float, float, float],
    *,
    colour: str = "#ffd9a8",
    strength: float = 1.0,
    to: str = "",
) -> None:
    """A lamp at `pos` (m), in the world or in the frame of the body `to`; a white surface 1 m before it has radiance `strength`.

    Raises:
        ProgramError: there is no such body, or the strength is none that a lamp may have.
    """
    import mujoco

    body = spec.body(to) if to else spec.worldbody
    if body is None or not 0 < strength <= MOST_LAMP:
        raise ProgramError(
            f"the lamp {name!r} is on no body, or of strength {strength}", "light", "0 to 1000, on a body"
        )
    body.add_light(
        name=f"lamp.{name}", pos=pos, dir=(0.0, 0.0, -1.0), type=mujoco.mjtLightType.mjLIGHT_POINT, castshadow=False,
        diffuse=[strength * c**2.2 / LIGHT_GAIN for c in rgb(colour)],
    )  # fmt: skip


def of(model: mujoco.MjModel) -> dict[str, Any]:
    """What a model states, as `treated` gives it; empty where it states nothing that can be drawn."""
    from .model_text import read

    told = read(model, TEXT)
    try:
        return treated(**told) if told else {}
    except (ProgramError, TypeError, AttributeError):  # a foreign model's own text
        return {}


def _flat(mood: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """A mood as numbers of a treatment; what it leaves out of its sky and its developing is `NEUTRAL`."""
    found: dict[str, Any] = dict(NEUTRAL)
    for part, values in mood.items():
        if part == "fog":
            found |= {"fog_rgb": list(rgb(values["colour"])), "fog_density": 3.0 / values["visibility_m"]}
            found["fog_height_m"] = values.get("height_m", 1e6)
            continue
        for name, value in values.items():
            plain = list(rgb(value)) if isinstance(value, str) else float(value)
            found[f"{part}_{'rgb' if name == 'colour' else name}"] = plain
    return found


def _clear(elevation_deg: float | None) -> dict[str, dict[str, Any]]:
    """The mood of a clear sky with the sun at a height: between noon, a golden hour and sunset."""
    height = HIGH["light"]["elevation_deg"] if elevation_deg is None else elevation_deg
    if height >= HIGH_DEG:
        mood = HIGH
    elif height >= LOW_DEG:
        mood = _between(LOW, HIGH, (height - LOW_DEG) / (HIGH_DEG - LOW_DEG))
    else:
        mood = _between(SUNSET, LOW, max(height - SET_DEG, 0.0) / (LOW_DEG - SET_DEG))
    return {"light": {**mood["light"], "elevation_deg": height}, "sky": mood["sky"], "grade": mood["grade"]}


def _between(
    one: dict[str, dict[str, Any]], other: dict[str, dict[str, Any]], share: float
) -> dict[str, dict[str, Any]]:
    """A mood between two: colours and numbers that both have change evenly, others are the nearer one's."""
    found: dict[str, dict[str, Any]] = {}
    for part in ("light", "sky", "grade"):
        a, b = one[part], other[part]
        if part == "grade":  # a mood that says nothing of it leaves it as it is
            plain = {name: NEUTRAL[f"grade_{name}"] for name in a.keys() ^ b.keys() if f"grade_{name}" in NEUTRAL}
            a, b = plain | a, plain | b
        found[part] = dict(b if share > 0.5 else a)
        for name in a.keys() & b.keys():
            if isinstance(a[name], str):
                mixed = [(1 - share) * p + share * q for p, q in zip(rgb(a[name]), rgb(b[name]), strict=True)]
                found[part][name] = "#" + "".join(f"{round(255 * c):02x}" for c in mixed)
            else:
                found[part][name] = (1 - share) * a[name] + share * b[name]
    return found

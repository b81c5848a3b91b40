"""Light, sky, air and developing of a film, as its author tells them."""

from typing import Any

import numpy as np

from ..errors import ProgramError
from .drawn_only import rgb
from .film_bounds import COLOURS, FAR_M, LIGHT
from .moods import MOODS

PLAIN_SKY: dict[str, Any] = {
    "sky_ground": "#6f6f6a", "sky_glow": 0.3, "sky_clouds": 0.0, "sky_stars": 0.0, "sky_strength": 1.0, "sky_indoors": False,
}  # fmt: skip


class Weather:
    """What a film's pictures are lit, hazed and developed by; everything that is not told stays as the setting has it."""

    def __init__(self) -> None:
        self._air: list[dict[str, Any]] = []

    def _stated(self) -> dict[str, Any]:
        """Light and sky that the plan states, by name."""
        return {}

    def mood(self, name: str, *, at: float | None = None) -> None:
        """Light, sky, fog and grading that go together: one of `MOODS`."""
        if name not in MOODS:
            raise ProgramError(f"no mood is called {name!r}", "film.py", f"use one of: {', '.join(MOODS)}")
        for what, values in MOODS[name].items():
            getattr(self, what)(at=at, **values)

    def light(
        self,
        *,
        azimuth_deg: float | None = None,
        elevation_deg: float | None = None,
        colour: str | None = None,
        strength: float | None = None,
        softness_deg: float | None = None,
        fill: float | None = None,
        at: float | None = None,
    ) -> None:
        """The key light: where it comes from, its colour, its strength (1: bright sun) and how wide it is (sun 0.5).

        `fill` is how much the surroundings and other lights of the setting give, less for darker shadows: the same number as the
        `strength` of `sky`, which a set or a mood may have told already, and 1 before anything does.

        With `at`, a film time, every such call is a moment that the film goes through; in between it changes evenly. What is
        left out stays as the setting has it.
        """
        if fill is not None and not 0 <= fill <= LIGHT["sky_strength"][1]:
            raise ProgramError(f"fill lies between 0 and 10, got {fill}", "film.py", "fill=1 leaves it to the light")
        self._told(
            at, light_azimuth_deg=azimuth_deg, light_elevation_deg=elevation_deg,
            light_rgb=None if colour is None else rgb(colour), light_strength=strength, light_softness_deg=softness_deg, sky_strength=fill,
        )  # fmt: skip

    def sky(
        self,
        *,
        zenith: str | None = None,
        horizon: str | None = None,
        ground: str | None = None,
        glow: float | None = None,
        clouds: float | None = None,
        stars: float | None = None,
        strength: float | None = None,
        indoors: bool | None = None,
        at: float | None = None,
    ) -> None:
        """A sky from `zenith` to `horizon` instead of the setting's surroundings; `ground` is what lies below the horizon.

        `glow` around the light, `clouds` and `stars` go from 0 to 1; `strength` is how much it lights the scene. `indoors`: no
        sky but the light of a room, and what bare metal mirrors of it has a window toward the key light.

        Without `zenith` and `horizon`, what is given changes the sky that set, mood or plan told; without any it is that of noon.
        """
        if (zenith is None) != (horizon is None):
            raise ProgramError(
                "a sky has the colours of its zenith and its horizon, or neither", "film.py", "give both"
            )
        own = {
            "sky_ground": ground, "sky_glow": glow, "sky_clouds": clouds, "sky_stars": stars, "sky_strength": strength,
            "sky_indoors": indoors,
        }  # fmt: skip
        whole: dict[str, Any] = {}
        if zenith is not None and horizon is not None:
            whole = PLAIN_SKY | {"sky_zenith": zenith, "sky_horizon": horizon}
        elif not any("sky_zenith" in told for told in self._air):
            stated = self._stated()
            noon = {f"sky_{name}": value for name, value in MOODS["noon"]["sky"].items()}
            whole = (
                {n: v for n, v in stated.items() if n.startswith("sky_")}
                if "sky_zenith" in stated
                else PLAIN_SKY | noon
            )
        found = whole | {name: value for name, value in own.items() if value is not None}
        told = {n: rgb(v) if n in COLOURS and isinstance(v, str) else v for n, v in found.items()}
        self._told(at, **told)

    def fog(
        self, *, colour: str = "#d8dde0", visibility_m: float, height_m: float | None = None, at: float | None = None
    ) -> None:
        """Air that hides what is far: 95 % of what is `visibility_m` away; thinner by half every `height_m` above the ground.

        Without a height it is as thick all over; the sky keeps its colour above a haze at the horizon, unless one sees less than 200 m.
        """
        if not visibility_m > 0 or (height_m is not None and not height_m > 0):
            raise ProgramError("fog needs a visibility and a height above zero", "film.py", "visibility_m=30, say")
        self._told(at, fog_rgb=rgb(colour), fog_density=3.0 / visibility_m, fog_height_m=height_m or 1e6)

    def grade(
        self,
        *,
        exposure_stops: float | None = None,
        contrast: float | None = None,
        saturation: float | None = None,
        temperature: float | None = None,
        tint: float | None = None,
        vignette: float | None = None,
        glow: float | None = None,
        fade: float | None = None,
        outlines: float | None = None,
        at: float | None = None,
    ) -> None:
        """Developing: `exposure_stops` (+1 twice the light), `contrast` and `saturation` (1: as it is), `temperature`
        and `tint` (-1 cool or green to 1 warm or magenta), `vignette` and `glow` (0 to 1), `fade` (1: black);
        `outlines=1` draws edges and thin things without stairs, in twice the time and more.
        """
        self._told(
            at, grade_exposure_stops=exposure_stops, grade_contrast=contrast, grade_saturation=saturation,
            grade_temperature=temperature, grade_tint=tint, grade_vignette=vignette, grade_glow=glow, grade_fade=fade,
            grade_outlines=outlines,
        )  # fmt: skip

    def _told(self, at: float | None, **values: Any) -> None:
        found = {name: np.asarray(value, dtype=float).tolist() for name, value in values.items() if value is not None}
        begin = 0.0 if at is None else float(at)
        if not 0 <= begin <= FAR_M:
            raise ProgramError(f"{begin} s is no time of a film", "film.py", "at=0 is where it begins")
        for name, value in found.items():
            low, high = LIGHT[name]
            shape, numbers = (3,) if name in COLOURS else (), np.array(value)
            if numbers.shape != shape or not ((low <= numbers) & (numbers <= high)).all():
                said = name.replace("_", " ", 1)
                raise ProgramError(f"{said} must lie between {low:g} and {high:g}, got {value}", "film.py", "")
        self._air.append({"at_s": begin, **found})

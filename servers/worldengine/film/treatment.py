"""The light, haze, focus and grading of one picture as a film asks for them: a value that every renderer may use."""

from dataclasses import asdict, dataclass, fields, replace
from typing import TYPE_CHECKING, Any

from worldkit.filming.film_bounds import LIGHT

if TYPE_CHECKING:
    import numpy as np

    from .gobos import Gobo

ENDLESS_M, LOW_M, THICK_M = 1e5, 10.0, 120.0
HAZE, THICK = 3.0 / 200.0, 3.0 / 60.0
"""The share hidden per metre by fog of 200 m of sight, above which the sky begins to be lost in it, and of 60 m."""
Rgb = tuple[float, float, float]


@dataclass(frozen=True)
class Treatment:
    """A film's wishes for one picture; None leaves the world's own setting. Colours are sRGB from 0 to 1."""

    light_azimuth_deg: float | None = None
    light_elevation_deg: float | None = None
    light_rgb: Rgb | None = None
    light_strength: float | None = None
    """1: a white surface that faces the light has radiance 3."""
    light_softness_deg: float | None = None
    light_gobo: "Gobo | None" = None
    """The slide before the light."""
    sky_zenith: Rgb | None = None
    """If it is given, the surroundings are a sky from `sky_horizon` up to it, over `sky_ground`."""
    sky_horizon: Rgb = (0.8, 0.8, 0.8)
    sky_ground: Rgb = (0.4, 0.4, 0.4)
    sky_glow: float = 0.0
    sky_clouds: float = 0.0
    sky_stars: float = 0.0
    sky_strength: float = 1.0
    sky_indoors: float = 0.0
    """1: what metal mirrors of it is a room, with a window toward the light."""
    fog_rgb: Rgb | None = None
    fog_density: float = 0.0
    """The share that fog hides per metre at the ground, 1/m."""
    fog_height_m: float = 1e6
    grade_exposure_stops: float = 0.0
    grade_contrast: float = 1.0
    grade_saturation: float = 1.0
    grade_temperature: float = 0.0
    grade_tint: float = 0.0
    grade_vignette: float | None = None
    grade_glow: float | None = None
    grade_fade: float = 0.0
    grade_outlines: float = 0.0
    """1: outlines are smooth, at twice the time or more."""
    focus_m: float = 0.0
    """The distance that is sharp, m."""
    breeze: tuple[float, float, float] | None = None
    """The wind that moves what sways, towards x and y, m/s, and the recorded time, s."""
    aperture: float = 0.0
    """The f-number of the lens; with 0 everything is sharp."""

    @property
    def fog_over_m(self) -> float:
        """How high the fog lies that the open sky is seen through, m: as it is told; of one without a height, which fills all
        that is near, a low layer, so that the sky keeps its colour, unless it is thick."""
        if self.fog_height_m < ENDLESS_M:
            return min(self.fog_height_m, THICK_M)
        dense = min(max((self.fog_density - HAZE) / (THICK - HAZE), 0.0), 1.0)
        return LOW_M * (THICK_M / LOW_M) ** dense

    @property
    def lit(self) -> tuple[Any, ...]:
        """Everything that the light of the scene depends on."""
        return tuple(getattr(self, f.name) for f in fields(self) if f.name.startswith(("light_", "sky_")))

    def started_from(self, told: dict[str, Any]) -> "Treatment":
        """The same, begun from what a world states (`worldkit.lights.treated`)."""
        values: dict[str, Any] = {name: tuple(v) if isinstance(v, list) else v for name, v in told.items()}
        return replace(self, **values)


PLAIN = Treatment()


class Treatments:
    """The moments of a film at which its light or grading is told, and the values between them."""

    def __init__(
        self, told: list[dict[str, Any]], stated: dict[str, Any] | None = None, gobo: "Gobo | None" = None
    ) -> None:
        """Take `[{"at_s": film time, name: value, …}, …]`, checked already, what the world states (`worldkit.lights`), and a slide."""
        import numpy as np

        self.stated = dict(stated or {})
        own_sky = any(
            "sky_zenith" in one for one in told
        )  # a sky of the film's own comes with its own air and developing
        kept = {n: v for n, v in self.stated.items() if not own_sky or n.startswith("light_")}
        self._begun = asdict(PLAIN.started_from(kept)) | {"light_gobo": gobo}
        self._tracks: dict[str, tuple[Any, Any]] = {}
        for name in LIGHT:
            moments: dict[float, Any] = {float(one["at_s"]): one[name] for one in told if name in one}
            if moments:
                at = sorted(moments)
                self._tracks[name] = (np.array(at), np.array([moments[t] for t in at], dtype=float))

    def at(self, film_s: float, focus_m: float = 0.0, aperture: float = 0.0) -> Treatment:
        """The treatment at a film time, s: linear between the told moments, constant before the first and after the last."""
        import numpy as np

        values: dict[str, Any] = {**self._begun, "focus_m": focus_m, "aperture": aperture}
        for name, (at, told) in self._tracks.items():
            if told.ndim == 2:
                values[name] = tuple(float(np.interp(film_s, at, told[:, k])) for k in range(told.shape[1]))
            else:
                values[name] = float(np.interp(film_s, at, told))
        return Treatment(**values)

    def bends(self, begin_s: float, end_s: float, frames: int) -> bool:
        """Whether what is told changes within so many frames otherwise than evenly from the first film time to the last, s."""
        import numpy as np

        at = np.linspace(begin_s, end_s, frames + 1)
        return any(bent(np.array([np.interp(at, when, row) for row in np.atleast_2d(told.T)]).T)
                   for when, told in self._tracks.values())  # fmt: skip

    def departs(self) -> list[str]:
        """What of the light and the sky that the world states is otherwise in the film, in words: `its elevation`, `its sky`."""
        import numpy as np

        found = []
        for name, value in self.stated.items():
            if name not in self._tracks or not name.startswith(("light_", "sky_")):
                continue
            if np.abs(self._tracks[name][1] - np.asarray(value)).max() > 1e-6:
                part, _, which = name.partition("_")
                found.append("sky" if part == "sky" else {"rgb": "colour"}.get(which, which.removesuffix("_deg")))
        return list(dict.fromkeys(found))

    @property
    def told(self) -> bool:
        """Whether the film tells anything of it."""
        return bool(self._tracks)


def bent(values: "np.ndarray") -> bool:
    """Whether rows (N, …) depart from the even way from the first to the last by over a hundredth of what they are."""
    import numpy as np

    share = np.linspace(0.0, 1.0, len(values)).reshape(-1, *[1] * (values.ndim - 1))
    even = values[0] * (1 - share) + values[-1] * share
    return bool((np.abs(values - even) > 0.01 * np.abs(values).max(initial=0.0) + 1e-6).any())

"""`Smoke`: soft puffs that nobody simulated, and an emitter of them: smoke, mist, steam, dust, breath, exhaust."""

from collections.abc import Callable
from typing import Any

import numpy as np

from ..errors import ProgramError
from . import drawn_only
from .film_bounds import MOST_EMITTERS, MOST_PUFF_NUMBERS, MOST_PUFFS
from .patterned_light import PatternedLight
from .plain_refusals import line, whole
from .recorded import Recorded

Array = np.ndarray
Varying = Any
"""A number, or a function of recorded times (N,) that gives (N,)."""
WAVES = 3
"""Of turbulence, each half as long as the one before."""


class Smoke(PatternedLight):
    """The puffs of a film of `recorded`."""

    def __init__(self, recorded: Recorded) -> None:
        super().__init__(recorded)
        self._puffs: list[tuple[dict[str, Any], Callable[[Array], Any], int]] = []

    def puffs(self, name: str, at: Callable[[Array], Any], *, colour: str = "#ffffff", even: bool = False) -> None:
        """Soft puffs without an edge, lit by the key light and shading each other; what stands before them hides them.

        Up to 8,000 are torn to wisps, each in a way of its own, as vapour is; `even` leaves them round and smooth.

        `at(times)` gives for recorded times (F,) places (F, P, 3), m, diameters (F, P), m, 0: not drawn, and how much of what is
        behind its middle each hides, (F, P), 0 to 1. Asked once, when the film is whole. 20,000 at once cost little.

        Raises:
            ProgramError: the colour is none, or `at` no function; when the film is whole: its numbers are none, or too many.
        """
        if not callable(at) or not name:
            raise ProgramError(
                f"the puffs {name!r} are at a function's places, not {at!r}", "film.py", "def at(times): …"
            )
        if len(self._puffs) >= MOST_EMITTERS:
            raise ProgramError(
                f"{name!r} is one too many: a film has at most {MOST_EMITTERS} kinds of puffs",
                "film.py",
                "let one function give the places of several",
            )
        told = {"name": name, "rgb": drawn_only.rgb(colour)} | ({"even": True} if even else {})
        self._puffs.append((told, at, line()))

    def emit(
        self,
        name: str,
        source: Any,
        direction: Any = (0.0, 0.0, 1.0),
        *,
        rate: Varying = 200.0,
        speed: Varying = 1.0,
        spread_deg: float = 10.0,
        drag: float = 3.0,
        rise: float = 0.0,
        turbulence: float = 0.15,
        life: float = 0.8,
        diameter: tuple[float, float] = (0.01, 0.1),
        opacity: float = 0.12,
        colour: str = "#ffffff",
        start: float = 0.0,
        until: float | None = None,
        seed: int = 1,
    ) -> None:
        """Let puffs stream out of a place: smoke, mist, steam, dust.

        Args:
            name: as the statement has it: "drawn only: mist (puffs)".
            source: a point (x, y, z), m; a body, or a body and a point of its frame, `("kettle", (0.1, 0, 0.2))`; or a function of
                recorded times (N,) that gives (N, 3): `lambda t: film.recorded.points("balloon", t)[:, 12]`.
            direction: in the world, or in the body's frame; or such a function.
            rate: puffs a second; a function of time lets it ebb.
            speed: m/s as they leave; a function of time, too.
            spread_deg: half the opening of the cone they leave in.
            drag: 1/s: how soon they are as slow as the air. They go `speed / drag` metres at most.
            rise: m/s that they drift upwards, as what is warm does; below 0 they sink.
            turbulence: m/s that eddies carry them.
            life: s until they have faded.
            diameter: m as they leave, and at the end of their life.
            opacity: how much of what is behind its middle a young one hides; it thins as it grows.
            colour: of the puffs in white light.
            start, until: recorded s between which they leave.
            seed: of their directions and eddies.

        Raises:
            ProgramError: a number is none, or there is no such body.
        """
        for what, value, least in (("spread_deg", spread_deg, 0), ("drag", drag, 1e-6), ("life", life, 1e-6)):
            if not least <= value <= 1e4:
                raise ProgramError(f"the {what} of {name!r} is {value}", "film.py", f"give it at least {least}")
        if len(diameter) != 2 or not 0 < min(diameter) < np.inf or not 0 < opacity <= 1:
            raise ProgramError(
                f"{name!r} has the diameters {diameter} and hides {opacity}",
                "film.py",
                "diameter=(0.01, 0.1), opacity=0.1",
            )
        end = self.recorded.duration if until is None else float(until)
        most = float(np.max(_varying(rate, np.linspace(start, max(end, start), 200))))
        if self.recorded.unmoved and self.recorded.asked_of_motion and not (most > 0 and end > start):
            return  # nothing happens yet in a world that stands still: when it streams is known of the recording
        if not 0 < most * life <= MOST_PUFFS or not end > start:
            raise ProgramError(
                f"{name!r} would have {most * life:.3g} puffs at once, from {start:g} s to {end:g} s",
                "film.py",
                f"let rate times life lie above 0 and up to {MOST_PUFFS}",
            )
        where, ways = self._source(name, source), self._towards(source, direction)
        key, slots = whole(seed), int(np.ceil(most * life)) + 1

        def at(times: Array) -> tuple[Array, Array, Array]:
            if len(times) * slots > MOST_PUFF_NUMBERS:
                raise ProgramError(
                    f"{name!r} has {slots} puffs at once in {len(times)} frames, over {MOST_PUFF_NUMBERS} together",
                    "film.py",
                    "lower rate or life, or a shorter film",
                )
            # Each slot is taken by one puff after another: a puff is known by its number, which says when it left. Where
            # from and how fast is asked once of each, however many frames it is in.
            last = np.floor((np.asarray(times, float)[:, None] - start) * most)
            number = last - (last - np.arange(slots)) % slots
            each, seat = np.unique(number, return_inverse=True)
            seat = seat.reshape(number.shape)
            birth = start + (each + _chance(each, key)) / most
            born = np.clip(birth, 0.0, self.recorded.duration)
            leaves = (each >= 0) & (birth < end) & (_chance(each, key + 1) * most < _varying(rate, born))
            foot, way = (np.asarray(ask(born), float).reshape(-1, 3)[seat] for ask in (where, ways))
            fast = (_varying(speed, born) * (0.75 + 0.5 * _chance(each, key + 4)))[seat]
            age = np.asarray(times, float)[:, None] - birth[seat]
            alive = (age > 0) & (age < life) & leaves[seat]
            share = np.clip(age / life, 0.0, 1.0)
            gone = -np.expm1(-drag * np.maximum(age, 0.0)) / drag
            aside = np.tan(np.radians(spread_deg)) * np.sqrt(_chance(number, key + 2))
            way = _tilted(way, aside, 2 * np.pi * _chance(number, key + 3))
            place = foot + way * (fast * gone)[..., None]
            place[..., 2] += rise * np.maximum(age, 0.0)
            wide = diameter[0] + (diameter[1] - diameter[0]) * np.sqrt(share)
            place += _eddies(place, np.maximum(age, 0.0), turbulence, max(diameter), key)
            thin = opacity * np.clip(share / 0.004, 0.0, 1.0) * (1 - share) ** 1.5
            return (
                place,
                np.where(alive, wide * (0.7 + 0.6 * _chance(number, key + 5)), 0.0),
                np.where(alive, thin, 0.0),
            )

        self.puffs(name, at, colour=colour)

    def _source(self, name: str, source: Any) -> Callable[[Array], Array]:
        if callable(source):
            return lambda times: np.asarray(source(times), float)
        if isinstance(source, str):
            self.recorded.index(source)
            return lambda times: self.recorded.position(source, times)
        if len(source) == 2 and isinstance(source[0], str):
            body, offset = source[0], np.asarray(source[1], float)
            self.recorded.index(body)
            return lambda times: self.recorded.origin(body, times) + self.recorded.orientation(body, times) @ offset
        point = np.asarray(source, float)
        if point.shape != (3,) or not np.isfinite(point).all():
            raise ProgramError(f"{name!r} comes from {source!r}", "film.py", "a point, a body, or a function of times")
        return lambda times: np.broadcast_to(point, (len(times), 3))

    def _towards(self, source: Any, direction: Any) -> Callable[[Array], Array]:
        def unit(found: Array) -> Array:
            return found / np.maximum(np.linalg.norm(found, axis=-1, keepdims=True), 1e-12)

        if callable(direction):
            return lambda times: unit(np.asarray(direction(times), float))
        way = unit(np.asarray(direction, float))
        body = (
            source
            if isinstance(source, str)
            else source[0]
            if not callable(source) and isinstance(source[0], str)
            else ""
        )
        if body:
            return lambda times: self.recorded.orientation(body, times) @ way
        return lambda times: np.broadcast_to(way, (len(times), 3))

    def _blown(self, times: Array, arrays: dict[str, Array]) -> list[dict[str, Any]]:
        """The puffs as JSON, their numbers in every frame into `arrays`."""
        found = []
        for number, (told, at, self.line) in enumerate(self._puffs):  # noqa: B020 (a refusal names the line)
            parts = at(times)
            count = len(parts) if isinstance(parts, tuple) else 0
            if count != 3:
                raise ProgramError(
                    f"the puffs {told['name']!r} are places, diameters and opacities",
                    "film.py",
                    "return places, wide, opaque",
                )
            places, wide, opaque = (np.asarray(part, float) for part in parts)
            shape = places.shape[:2]
            good = (
                places.ndim == 3
                and places.shape[0] == len(times)
                and places.shape[2] == 3
                and wide.shape == opaque.shape == shape
            )
            if not good or not 1 <= shape[1] <= MOST_PUFFS or np.prod(shape) > MOST_PUFF_NUMBERS:
                raise ProgramError(
                    f"the puffs {told['name']!r} must be ({len(times)}, P, 3), ({len(times)}, P) and ({len(times)}, P) numbers, P at most "
                    f"{MOST_PUFFS}, and {MOST_PUFF_NUMBERS} over all frames; got {places.shape}, {wide.shape}, {opaque.shape}",
                    "film.py",
                    "fewer at once, or a shorter film",
                )
            if not (np.isfinite(places).all() and (wide >= 0).all() and (opaque >= 0).all() and (opaque <= 1).all()):
                raise ProgramError(
                    f"the puffs {told['name']!r} are nowhere, or hide less than nothing",
                    "film.py",
                    "check how they are reckoned",
                )
            names = {what: f"puffs{number}_{what}" for what in ("places", "wide", "opaque")}
            for (_, key), values in zip(names.items(), (places, wide, opaque), strict=True):
                arrays[key] = values.astype("f4")
            # Of one size in all frames, or all would tremble; in steps, so that another shot leaves those that there are as they were.
            even = told.get("even") or not wide.any()
            eddies = 0.0 if even else float(2.0 ** np.rint(np.log2(wide[wide > 0].mean())))
            found.append({what: told[what] for what in ("name", "rgb")} | {"eddies_m": eddies} | names)
        return found


def _varying(value: Varying, times: Array) -> Array:
    """(N,) a number at some times."""
    return np.broadcast_to(np.asarray(value(times) if callable(value) else value, float), np.shape(times))


def _chance(number: Array, key: int) -> Array:
    """A number from 0 to 1 for each whole one, the same each time."""
    mixed = number.astype(np.int64).astype(np.uint64) + np.uint64((key + 1) * 0x9E3779B97F4A7C15 % (1 << 64))
    for shift, by in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB), (31, 1)):
        mixed = (mixed ^ (mixed >> np.uint64(shift))) * np.uint64(by)
    return np.asarray(mixed >> np.uint64(11), float) / float(1 << 53)


def _tilted(way: Array, aside: Array, turn: Array) -> Array:
    """Directions (…, 3) tilted by the tangent `aside` towards the angle `turn` about them."""
    other = np.where(np.abs(way[..., 2:]) < 0.9, (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))
    first = np.cross(way, other)
    first /= np.maximum(np.linalg.norm(first, axis=-1, keepdims=True), 1e-12)
    second = np.cross(way, first)
    found = way + aside[..., None] * (np.cos(turn)[..., None] * first + np.sin(turn)[..., None] * second)
    return found / np.linalg.norm(found, axis=-1, keepdims=True)


def _eddies(place: Array, age: Array, strength: float, size: float, key: int) -> Array:
    """(…, 3) m that eddies carried puffs: each is carried by those where it is, so that neighbours go together."""
    total = np.zeros_like(place)
    random = np.random.default_rng(key)
    for wave in range(WAVES):
        k = random.normal(size=(3, 3)) * 2 * np.pi / (3 * size) * 2**wave / 1.7
        swirl, phase = random.normal(size=(3, 3)), random.uniform(0, 2 * np.pi, 3)
        for one in range(3):
            across = np.cross(k[one], swirl[one])
            across /= max(float(np.linalg.norm(across)), 1e-12)
            total += np.sin(place @ k[one] + phase[one] + 2.0 * age)[..., None] * across / 2**wave
    return np.asarray(total * (strength * age / np.sqrt(3.0))[..., None])

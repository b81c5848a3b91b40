"""The points of an author's law as a cloud: each is a puff where it was recorded, made of wisps that turn as it goes.

A film says how wide and how thick a puff is by its age alone, so that nothing of it can be moved, lit or put out in the course of time.
A puff of a law stands for a parcel of vapour, as wide as a hand: one soft ball of it would be a smear, so it is a few clots of wisps,
thick and thin, which the air around shears. They keep within the puff, and are the same at every drawing.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from ..recording.stored import Recording

Array = np.ndarray
MOST_WISPS, EACH, FEWEST, STRAND = 24_000, 60, 3, 9
"""Wisps of a cloud in a frame, of one puff at most and at least, and so many of them make a strand."""
BODY = 0.5
"""The share of a puff that hangs between its strands, wide and soft."""
EARLY_S, RISES = 0.1, 1.1
"""What is not seen until then, or hides so many times more than it does until then, comes up later, which is told."""
BEGINS_M = 1e-3
"""A point that is farther than this from where it was first has set out."""
UNEVEN = 0.75
"""How unlike the wisps of a puff are: the spread of the logarithm of how much each hides."""
TURNS, SHEAR, LOOKS_S = 1.1, 0.22, 0.02
"""Radians a second that a puff turns at most; how far the air shears it, in its diameters; between two looks at which way it goes, s."""


@dataclass(frozen=True)
class Cloud:
    """One law's points in the frames of a film."""

    name: str
    of: str
    """The body whose balls it stands for."""
    law: str
    rgb: tuple[float, float, float]
    ages: Array
    """(3, A): ages, s, and how wide, m, and how opaque a puff of each is."""
    began: Array
    """(P,) s: when each point set out; inf: never."""
    laws: Any
    """The recorded `Laws`."""
    times: Array
    """(F,) recorded times of the film's frames, s."""

    def puffs(self, frame: int) -> tuple[Array, Array, Array]:
        """Places (Q, 3), m, radii (Q,), m, and opacities (Q,) of the wisps of a frame."""
        time = float(self.times[frame])
        age = time - self.began
        wide, opaque = (np.interp(age, self.ages[0], row) for row in self.ages[1:])
        alive = np.flatnonzero((age >= 0) & (wide > 0) & (opaque > 0))
        if not len(alive):
            return np.zeros((0, 3)), np.zeros(0), np.zeros(0)
        before, here, after = self.laws.points(self.law, np.array([time - LOOKS_S, time, time + LOOKS_S]))
        way = (after - before)[alive] / (2 * LOOKS_S)
        eddies = float(np.mean(self.ages[1][self.ages[2] > 0]))
        return spun(here[alive], way, wide[alive], opaque[alive], age[alive], alive, len(age), eddies)

    def said(self) -> str:
        """What it is, for the statement."""
        ages, opaque = self.ages[0], np.where(self.ages[1] > 0, self.ages[2], 0.0)
        when = " from when it sets out"
        if len(seen := ages[opaque > 0]):
            ends = seen.max() < ages[-1]
            when = f" until {seen.max():.2g} s after it set out" if ends else when
            if seen.min() > EARLY_S:
                when = f" from {seen.min():.2g} {f'to {seen.max():.2g} s' if ends else 's on'} after it set out"
        if opaque[peak := int(opaque.argmax())] > RISES * opaque[ages <= max(EARLY_S, ages[0])].max():
            when += f", thickest at {ages[peak]:.2g} s, where each hides {opaque[peak]:.0%}"
        return f"{self.name} (the points of the law {self.law} as a cloud in place of {self.of}, each{when})"


def read(
    film: dict[str, Any], arrays: dict[str, Array], recording: "Recording", others: Sequence[str]
) -> tuple[Cloud, ...]:
    """The clouds of a film's description, read with distrust; `others` are bodies that a surface stands for.

    Raises:
        ValueError: one is of no law, or is none that can be drawn.
    """
    from worldkit.filming import film_bounds as bounds
    from worldkit.filming.laws_shown import Laws

    from ..recording import law_channels

    rows = film.get("clouds", ())
    if not rows:
        return ()
    laws, taken = Laws(law_channels.read(recording)), set(others)
    times = np.asarray(arrays["time"], float) + float(recording.time[0])
    found: list[Cloud] = []
    for one in rows:
        name, of, rgb = str(one["name"])[:60], str(one["of"]), tuple(float(part) for part in one["rgb"])
        ages = np.asarray(arrays[str(one["ages"])], float)
        if of not in laws.shown_by or of not in recording.names or of in taken or len(found) >= bounds.MOST_EMITTERS:
            raise ValueError(
                f"the cloud {name!r} is of {of!r}, whose balls show no law, or are drawn as something else"
            )
        good = ages.ndim == 2 and len(ages) == 3 and ages.shape[1] >= 2 and np.isfinite(ages).all() and len(rgb) == 3
        if not good or (np.diff(ages[0]) <= 0).any() or not (ages[1:].min() >= 0 and ages[2].max() <= 1):
            raise ValueError(f"the cloud {name!r} is none that can be drawn")
        taken.add(of)
        number = laws.number(of)
        began = set_out(*laws.recorded(number))
        found.append(Cloud(name, of, laws.names[number], rgb, ages, began, laws, times))  # type: ignore[arg-type]
    return tuple(found)


def set_out(times: Array, places: Array) -> Array:
    """(P,) s: when each of some points (F, P, 3), m, at the times (F,) last was where it was at first; inf where it never left."""
    if not len(times):
        return np.zeros(0)
    gone = np.linalg.norm(places - places[:1], axis=2) > BEGINS_M
    return np.where(gone.any(axis=0), times[np.maximum(gone.argmax(axis=0) - 1, 0)], np.inf)


def depth_of(opaque: Array) -> Array:
    """The optical depth in the middle of puffs that hide such shares of what is behind them."""
    return np.asarray(-np.log1p(-np.minimum(opaque, 0.98)))


def torn(places: Array, wide: Array, opaque: Array, eddies_m: float) -> tuple[Array, Array, Array]:
    """The wisps of puffs (P) that nobody simulated, each with its own at every drawing; as they are, where there are too many to tear."""
    count = len(wide)
    alive = np.flatnonzero((wide > 0) & (opaque > 0))
    if count * FEWEST > MOST_WISPS or not len(alive):
        return places, wide / 2, opaque
    still = np.zeros((len(alive), 3))
    return spun(places[alive], still, wide[alive], opaque[alive], still[:, 0], alive, count, eddies_m)


def spun(
    places: Array,
    ways: Array,
    wide: Array,
    opaque: Array,
    age: Array,
    numbers: Array,
    count: int,
    eddies_m: float,
) -> tuple[Array, Array, Array]:
    """The wisps of puffs (P) at places, going `ways` (P, 3), m/s, of `numbers` among `count`: places, radii, opacities (P * K).

    Eddies of one size, m, shear them: of another in each frame, all would tremble.
    """
    many = int(np.clip(MOST_WISPS // max(count, 1), FEWEST, EACH))
    offsets, sizes, shares, axes, turns = (part[numbers] for part in _cloth(count, many))
    angle = (turns * TURNS * np.minimum(age, 1e3))[:, None, None]
    axis = axes[:, None, :]
    # Rodrigues: each puff turns as one, about an axis of its own.
    turned = offsets * np.cos(angle) + np.cross(axis, offsets) * np.sin(angle)
    turned += axis * (offsets * axis).sum(axis=2, keepdims=True) * (1 - np.cos(angle))
    fast = np.linalg.norm(ways, axis=1)
    along = (ways / np.maximum(fast, 1e-9)[:, None])[:, None, :]
    drawn_out = (0.1 * fast / (0.1 * fast + wide + 1e-9))[:, None, None]
    turned += drawn_out * along * (turned * along).sum(axis=2, keepdims=True)
    found = places[:, None, :] + wide[:, None, None] * turned
    found += SHEAR * wide[:, None, None] * _air(found, eddies_m, age)
    own = wide[:, None] * sizes
    depth = depth_of(opaque)[:, None] * shares / sizes**2
    return found.reshape(-1, 3), own.ravel() / 2, -np.expm1(-depth).ravel()


@lru_cache(maxsize=8)
def _cloth(count: int, many: int) -> tuple[Array, ...]:
    """Of each of so many puffs: where its wisps are (P, K, 3) and how wide (P, K), in its diameters; what share of it each is; about
    which axis it turns (P, 3), and how fast (P,)."""
    random = np.random.default_rng(20)
    bodies = max(1, many // 10)
    strands = max(1, -(-(many - bodies) // STRAND))
    strand, along = np.arange(many) % strands, np.linspace(-1.0, 1.0, STRAND)[np.arange(many) // strands % STRAND]
    middle, way, bend = (random.normal(size=(count, strands, 3)) * far for far in (0.17, 0.16, 0.09))
    offsets = middle[:, strand] + along[:, None] * way[:, strand] + (along**2)[:, None] * bend[:, strand]
    sizes = (0.17 + 0.17 * random.random((count, strands)))[:, strand] * (1.1 - 0.5 * along**2)
    weight = np.exp(UNEVEN * random.normal(size=(count, strands)))[:, strand] * (1.0 - 0.6 * along**2) * sizes**2
    offsets[:, :bodies], sizes[:, :bodies] = (
        random.normal(size=(count, bodies, 3)) * 0.12,
        0.6 + 0.3 * random.random((count, bodies)),
    )
    weight[:, :bodies] = BODY / (1 - BODY) * weight[:, bodies:].sum(axis=1, keepdims=True) / bodies
    far = np.linalg.norm(offsets, axis=2, keepdims=True)
    offsets *= 0.5 * np.tanh(far / 0.5) / np.maximum(far, 1e-9)
    axes = random.normal(size=(count, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    return offsets, sizes, weight / weight.sum(axis=1, keepdims=True), axes, random.uniform(0.3, 1.0, count)


def _air(places: Array, size: float, age: Array) -> Array:
    """(P, K, 3) how eddies about as large as a puff shear its wisps: alike for those that are near, so that they draw into sheets."""
    random, total = np.random.default_rng(5), np.zeros_like(places)
    for wave in range(4):
        k = random.normal(size=3) * 2 * np.pi / (1.2 * size) / 1.7 * (1.0, 1.0, 2.1, 3.7)[wave]
        across = np.cross(k, random.normal(size=3))
        across /= max(float(np.linalg.norm(across)), 1e-12)
        total += np.sin(places @ k + 2.0 * age[:, None])[..., None] * across / (1.0, 1.0, 1.6, 2.4)[wave]
    return total

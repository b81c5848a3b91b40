"""How a plant branches: limbs from the root out, each with the leaves on it; the same for the same seed."""

from dataclasses import dataclass
from typing import Any

import numpy as np

Plant = Any
"""The numbers of a plant; their module imports this one."""

TURN = np.pi * (3 - 5**0.5)
"""From one twig to the next around the wood: the golden angle, as plants have it."""
THIN = 0.2
"""Diameter at the tip of a stem as a share of that at its root."""
FRESH_M_S, GIVES = 7.0, 0.3
"""The wind by which a twig bends by so much at its foot, rad."""
UP = np.array([0.0, 0.0, 1.0])
Point = tuple[float, float, float]


@dataclass(frozen=True)
class Limb:
    """A piece of wood that bends at its foot, m from the root of the plant."""

    name: str
    above: str
    """The limb that it grows on; empty: the root."""
    foot: Point
    tip: Point
    thick: tuple[float, float]
    """Diameter at foot and tip, m."""
    leaves: tuple[tuple[Point, Point, Point], ...] = ()
    """Of each: where its stalk begins, its tip, and its upper side's direction."""

    @property
    def long_m(self) -> float:
        """From foot to tip."""
        return float(np.linalg.norm(np.subtract(self.tip, self.foot)))

    @property
    def mean_m(self) -> float:
        """Mean diameter."""
        return 0.5 * (self.thick[0] + self.thick[1])

    @property
    def leaf_tips(self) -> tuple[Point, ...]:
        """Where its leaves end."""
        return tuple(tip for _, tip, _ in self.leaves)


def grown(plant: Plant) -> tuple[Limb, ...]:
    """The limbs of a plant, each after the one that it grows on."""
    random = np.random.default_rng(plant.seed)
    if plant.word == "bough":
        stems = _chain(
            plant, "", np.zeros(3), _leaning(plant.rises_deg), plant.long_m, plant.diameter_m, plant.parts, random
        )
    elif plant.word == "tree":
        stems = _standing(plant, random)
    else:
        stems = []
        for number in range(plant.parts):
            turn, lean = TURN * number, random.uniform(0.15, 0.75)
            ahead = np.array([np.sin(lean) * np.cos(turn), np.sin(lean) * np.sin(turn), np.cos(lean)])
            long = plant.long_m * random.uniform(0.75, 1.0) / max(float(np.cos(lean)), 0.6)
            stems += _chain(plant, f"stem{number + 1}_", np.zeros(3), ahead, 0.8 * long, plant.diameter_m, 2, random)
    bearing = [stem for stem in stems if stem.name != "trunk"]
    return (*stems, *_twigs(plant, bearing, random))


def _leaning(deg: float) -> np.ndarray:
    turn = np.radians(deg)
    return np.array([np.cos(turn), 0.0, np.sin(turn)])


def _chain(
    plant: Plant, prefix: str, foot: np.ndarray, ahead: np.ndarray, long: float, thick: float, parts: int,
    random: np.random.Generator, above: str = "",
) -> list[Limb]:  # fmt: skip
    """A stem in some parts, thinner towards its tip, bending a little here and there, and towards level as it goes."""
    found, level = [], ahead * [1, 1, 0] if plant.word != "bush" else ahead
    level = level / max(float(np.linalg.norm(level)), 1e-9)
    for part in range(parts):
        here, there = (thick * (1 - (1 - THIN) * share / parts) for share in (part, part + 1))
        ahead = ahead + 0.10 * random.normal(size=3) + 0.12 * (level - ahead)
        ahead = ahead / np.linalg.norm(ahead)
        tip = foot + long / parts * ahead
        name = f"{prefix}{part + 1}"
        found.append(Limb(name, above, _point(foot), _point(tip), (here, there)))
        foot, above = tip, name
    return found


def _standing(plant: Plant, random: np.random.Generator) -> list[Limb]:
    """A trunk and boughs around its upper part, in `parts` of two pieces each."""
    top = 0.62 * plant.long_m
    trunk = Limb("trunk", "", (0.0, 0.0, 0.0), (0.0, 0.0, top), (plant.diameter_m, 0.6 * plant.diameter_m))
    found, boughs = [trunk], 2 * plant.parts + 1
    for number in range(boughs):
        share = number / (boughs - 1)
        lean = (1.05 - 0.95 * share) * random.uniform(0.85, 1.1)
        turn = TURN * number + random.uniform(-0.2, 0.2)
        ahead = np.array([np.sin(lean) * np.cos(turn), np.sin(lean) * np.sin(turn), np.cos(lean)])
        foot = np.array([0.0, 0.0, top * (0.52 + 0.48 * share)])
        long = plant.long_m * (0.36 - 0.02 * share) * random.uniform(0.85, 1.1)
        found += _chain(plant, f"bough{number + 1}_", foot, ahead, long, 0.42 * plant.diameter_m, 2, random, "trunk")
    return found


def _twigs(plant: Plant, stems: list[Limb], random: np.random.Generator) -> list[Limb]:
    """Twigs along the stems, most of them towards their tips, and one at each tip; the leaves are on them."""
    count, found = plant.twigs, []
    ends = [stem for stem in stems if not any(other.above == stem.name for other in stems)]
    places = [(stem, 1.0) for stem in ends]
    weight = np.array([1.0 / max(stem.mean_m, 1e-4) ** 0.5 for stem in stems])
    owners = np.sort(random.choice(len(stems), size=max(count - len(ends), 0), p=weight / weight.sum()))
    places += [(stems[k], random.uniform(0.25, 0.95)) for k in owners]
    shares = np.array([0.25 + random.random() for _ in places])
    borne = np.floor(np.cumsum(shares / shares.sum()) * plant.leaves + 1e-9).astype(int)
    for number, (stem, at) in enumerate(places):
        foot, tip = np.array(stem.foot), np.array(stem.tip)
        ahead = (tip - foot) / np.linalg.norm(tip - foot)
        side = np.cross(ahead, UP if abs(ahead[2]) < 0.9 else [1.0, 0, 0])
        side /= np.linalg.norm(side)
        turn = TURN * number
        # Twigs of a level stem stand to its sides rather than up and down, as they reach for light.
        out = np.cos(turn) * side + (0.55 if abs(ahead[2]) < 0.7 else 1.0) * np.sin(turn) * np.cross(side, ahead)
        grows = ahead + (0.35 if at == 1.0 else 1.1) * out + 0.25 * UP
        grows /= np.linalg.norm(grows)
        long = plant.long_m * (0.2 if plant.word != "tree" else 0.17) * random.uniform(0.7, 1.25)
        start = foot + at * (tip - foot)
        first = 0 if number == 0 else int(borne[number - 1])
        thick = _grown_thick(plant, long, int(borne[number]) - first)
        leaves = _leaves(plant, start, grows, long, int(borne[number]) - first, random)
        end = start + long * grows
        found.append(Limb(f"twig{number + 1}", stem.name, _point(start), _point(end), (thick, 0.35 * thick), leaves))
    return found


def _grown_thick(plant: Plant, long: float, leaves: int) -> float:
    """Diameter of a twig at its foot, m: wood grows as thick as what it bears needs, in a fresh breeze it bends by `GIVES`."""
    push = 0.6 * FRESH_M_S**2 * 0.5 * plant.leaf_area_m2 * leaves * 0.6 * long
    mean = (64 * (push / GIVES) * long / (np.pi * plant.modulus_pa)) ** 0.25
    return float(max(mean / 0.675, 0.002 + 0.006 * long))


def _leaves(
    plant: Plant, start: np.ndarray, grows: np.ndarray, long: float, count: int, random: np.random.Generator
) -> tuple[tuple[Point, Point, Point], ...]:
    """Leaves along a twig, to its left and right in turn, hanging a little; on side shoots where there are many."""
    found = []
    left = np.cross(UP, grows)
    left = left / np.linalg.norm(left) if np.linalg.norm(left) > 1e-6 else np.array([1.0, 0.0, 0.0])
    spread = min(0.5 * long, 0.035 * long * count**0.5 + 0.3 * plant.leaf_m)
    for number in range(count):
        at = 0.15 + 0.85 * (number + random.random()) / count
        foot = start + at * long * grows + spread * random.uniform(-1, 1, 3) * [1, 1, 0.7]
        way = 0.7 * grows + (1 if number % 2 else -1) * random.uniform(0.4, 1.2) * left - random.uniform(0.1, 0.7) * UP
        way = way + 0.25 * random.normal(size=3)
        way /= np.linalg.norm(way)
        up = UP + 0.55 * random.normal(size=3)
        size = plant.leaf_m * random.uniform(0.7, 1.2)
        found.append((_point(foot), _point(foot + size * way), _point(up)))
    return tuple(found)


def _point(values: np.ndarray) -> Point:
    x, y, z = (round(float(v), 6) for v in values)
    return x, y, z

"""Trees of a species and a season, drawn only: a trunk, limbs, branches and twigs, each as its kind grows, and leaves by their depth.

The method is Weber and Penn's (Creation and Rendering of Realistic Trees, SIGGRAPH 1995): levels of branches with a length, an angle and
a bend each. Fewer leaves are larger ones, so that a tree far away keeps its crown at a tenth of the cost.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .trees import TURN, joined, limb

SEASONS = ("spring", "summer", "autumn", "winter")
Points = np.ndarray
HUES = 3
"""Of leaves: in the crown's depth, at its middle, where light falls on it."""


class Grown(NamedTuple):
    """One tree, its foot at the origin."""

    wood: np.ndarray
    """(V, 3), m."""
    wood_faces: np.ndarray
    """(F, 3)."""
    leaves: tuple[np.ndarray, ...]
    """By hue (L, 4, 3), m: foot, side, tip and other side of each."""


@dataclass(frozen=True)
class Species:
    """How one kind grows; lengths are shares of its height, angles radians from the vertical."""

    trunk: float = 0.7
    """How far up the trunk goes as one."""
    thick: float = 0.022
    """Radius of the trunk at its foot."""
    limbs: int = 13
    first: float = 0.22
    """Where the lowest limb leaves."""
    lean: tuple[float, float] = (1.25, 0.35)
    """Of the lowest and the highest limb."""
    reach: tuple[float, float, float] = (0.40, 0.44, 0.26)
    """Of the lowest, the middle and the highest."""
    bend: float = 0.35
    """How much limbs turn up on their way, or down."""
    rough: float = 0.13
    """How crooked all of it is."""
    side: int = 6
    """Branches of a limb."""
    twigs: int = 7
    """Of a branch."""
    twig: float = 0.085
    hang: float = 0.25
    """How much twigs hang."""
    leaf: tuple[float, float] = (1.0, 0.62)
    """Longer than others of its area by this; its width by its length."""
    droop: float = 0.35
    spread: float = 0.026
    """How far leaves stand from their twig."""
    cover: float = 1.7
    """Area of all leaves by the square of the height."""
    evergreen: bool = False
    bark: str = "bark"
    green: tuple[str, str, str] = ("foliage_dark", "foliage", "foliage_young")
    autumn: tuple[str, str, str] = ("foliage_dark", "foliage_gold", "foliage_rust")
    stems: int = 1
    """From one root."""


KNOWN = {
    "oak": Species(),
    "birch": Species(
        trunk=0.97, thick=0.011, limbs=26, first=0.24, lean=(0.95, 0.4), reach=(0.24, 0.22, 0.05), bend=-0.15, rough=0.08,
        side=5, twigs=5, twig=0.075, hang=0.9, leaf=(0.9, 0.7), cover=0.42, bark="#d8d3c8",
        green=("foliage", "foliage_young", "foliage_young"), autumn=("foliage_gold", "foliage_gold", "foliage_young"),
    ),
    "pine": Species(
        trunk=0.98, thick=0.016, limbs=24, first=0.42, lean=(1.5, 0.5), reach=(0.24, 0.25, 0.07), bend=0.25, rough=0.12,
        side=6, twigs=4, twig=0.05, hang=-0.35, leaf=(2.6, 0.075), droop=-0.1, spread=0.012, cover=0.55, evergreen=True,
        bark="#7d5640", green=("#24391f", "#33502b", "#4a6a38"),
    ),
    "willow": Species(
        trunk=0.5, thick=0.03, limbs=12, first=0.2, lean=(0.95, 0.2), reach=(0.42, 0.5, 0.42), bend=-0.75, rough=0.1,
        side=7, twigs=5, twig=0.30, hang=2.6, leaf=(1.9, 0.17), droop=1.2, spread=0.012, cover=0.75,
        green=("foliage", "foliage_young", "foliage_young"), autumn=("foliage_gold", "foliage_gold", "foliage_young"),
    ),
    "bush": Species(
        trunk=0.3, thick=0.012, limbs=4, first=0.12, lean=(0.95, 0.3), reach=(0.5, 0.55, 0.5), bend=0.2, rough=0.16, side=4,
        twigs=4, twig=0.16, hang=0.1, spread=0.06, cover=2.4, stems=5,
    ),
}  # fmt: skip
OTHERS = ("palm", "hedge")
NAMES = (*KNOWN, *OTHERS)
LEAFY = {"spring": 0.5, "summer": 1.0, "autumn": 0.7, "winter": 0.0}
"""Share of its leaves that a tree has which sheds them."""


def looks(kind: str, season: str) -> tuple[str, tuple[str, str, str]]:
    """The bark, and the leaves by hue."""
    if kind == "palm":
        return "#8b7a62", ("#36512a", "#4d6b33", "#6c843f")
    if kind == "hedge":
        return "bark", ("#1f3318", "#35552a", "#4d7036")
    one = KNOWN[kind]
    if season == "spring" and not one.evergreen:
        return one.bark, ("foliage", "foliage_young", "foliage_young")
    return one.bark, one.autumn if season == "autumn" and not one.evergreen else one.green


def grown(kind: str, height: float, season: str, seed: int, triangles: int) -> Grown:
    """A tree of about `height`, m, and at most so many triangles, the same for the same seed."""
    random = np.random.default_rng(seed)
    if kind == "palm":
        made = _palm(height, random, triangles)
    elif kind == "hedge":
        made = _hedge(height, random, triangles)
    else:
        one = KNOWN[kind]
        made = _tree(one, height, 1.0 if one.evergreen else LEAFY[season], random, triangles)
    top = max([made.wood[:, 2].max(), *(part[..., 2].max() for part in made.leaves if len(part))])
    factor = height / top
    above = [np.concatenate([part[..., :2], np.maximum(part[..., 2:], 0.0)], axis=-1) for part in made.leaves]
    return Grown(made.wood * factor, made.wood_faces, tuple(part * factor for part in above))


def _tree(one: Species, height: float, leafy: float, random: np.random.Generator, triangles: int) -> Grown:
    tubes: list[tuple[Points, np.ndarray]] = []
    twigs: list[Points] = []
    rich = triangles > 12_000
    for number in range(one.stems):
        lean = np.zeros(3)
        if one.stems > 1:
            turn = TURN * number
            lean = random.uniform(0.25, 0.8) * np.array([np.cos(turn), np.sin(turn), 0.0])
        stem = _way(
            0.06 * height * lean,
            np.array([0, 0, 1.0]) + lean,
            one.trunk * height,
            np.zeros(3),
            0.35 * one.rough,
            random,
            7,
        )
        share = np.linspace(0, 1, len(stem))
        radii = one.thick * height * (1 - 0.78 * one.trunk * share)
        radii[0] *= 1.35  # where the roots begin
        tubes.append(limb(stem, list(radii), sides=9 if rich else 6))
        _limbs(one, height, stem, tubes, twigs, random, rich)
    ways = np.array(twigs)
    fine = ways if one.hang > 1 or not leafy else ways[:, [0, -1]]
    left = triangles - sum(len(part) for _, part in tubes) if rich or not leafy else 0
    most = int(np.clip(left // (6 * (fine.shape[1] - 1)), 0, len(fine)))
    drawn = _sticks(fine[np.linspace(0, len(fine) - 1, most).astype(int)], 0.0011 * height)
    wood, faces = joined([*tubes, drawn])
    count = int(max((triangles - len(faces)) // 2, 200) * leafy)
    return Grown(wood, faces, _leaves(one, height, ways, count, leafy, random))


def _limbs(
    one: Species, height: float, stem: Points, tubes: list, twigs: list[Points], random: np.random.Generator, rich: bool
) -> None:
    """Limbs around a stem by the golden angle, branches to both sides of each, twigs around these."""
    start = random.uniform(0, 2 * np.pi)
    for number in range(one.limbs):
        share = (number + random.uniform(0.1, 0.9)) / one.limbs
        at = one.first / one.trunk + (1 - one.first / one.trunk) * share
        foot, along = _on(stem, at)
        lean = np.interp(share, (0, 1), one.lean) * random.uniform(0.85, 1.12)
        turn = start + TURN * number
        out = np.array([np.cos(turn), np.sin(turn), 0.0])
        ahead = np.sin(lean) * out + np.cos(lean) * along
        long = height * np.interp(share, (0, 0.45, 1), one.reach) * random.uniform(0.78, 1.12)
        thick = one.thick * height * (0.42 - 0.2 * share)
        way = _way(foot, ahead, long, one.bend * np.array([0, 0, 1.0]), one.rough, random, 5)
        tubes.append(limb(way, list(thick * np.linspace(1, 0.25, len(way))), sides=6 if rich else 3))
        for branch in range(one.side):
            place = 0.22 + 0.78 * (branch + random.random()) / one.side
            foot, along = _on(way, place)
            sideways = np.cross(along, [0, 0, 1.0]) * (1 if branch % 2 else -1)
            ahead = along + random.uniform(0.6, 1.2) * sideways + np.array([0, 0, random.uniform(-0.2, 0.5)])
            own = 0.5 * long * (1.15 - 0.6 * place) * random.uniform(0.75, 1.15)
            part = _way(
                foot, ahead, own, 0.5 * one.bend * np.array([0, 0, 1.0]), 1.3 * one.rough, random, 3 if rich else 2
            )
            tubes.append(limb(part, list(0.38 * thick * np.linspace(1, 0.3, len(part))), sides=4 if rich else 3))
            for twig in range(one.twigs):
                foot, along = _on(part, 0.2 + 0.8 * (twig + random.random()) / one.twigs)
                ahead = 0.8 * along + random.normal(0, 0.55, 3)
                size = one.twig * height * random.uniform(0.6, 1.25)
                if one.hang > 1:  # what hangs ends a little over the ground
                    size = min(size, max(foot[2] - 0.06 * height * random.uniform(0.6, 2.5), 0.03 * height))
                twigs.append(_way(foot, ahead, size, -one.hang * np.array([0, 0, 1.0]), 0.08, random, 3))


def _way(
    foot: Points, ahead: Points, long: float, bend: Points, rough: float, random: np.random.Generator, parts: int
) -> Points:
    """A middle line (parts + 1, 3) that turns towards `bend` on its way."""
    points = [np.asarray(foot, float)]
    ahead = np.asarray(ahead, float)
    for _ in range(parts):
        ahead = ahead / np.linalg.norm(ahead) + bend / parts + rough * random.normal(size=3)
        points.append(points[-1] + long / parts * ahead / np.linalg.norm(ahead))
    return np.array(points)


def _on(way: Points, share: float) -> tuple[Points, Points]:
    """A place on a line, and its direction there."""
    at = min(share, 0.999) * (len(way) - 1)
    k = int(at)
    step = way[k + 1] - way[k]
    return way[k] + (at - k) * step, step / np.linalg.norm(step)


def _sticks(ways: Points, radius: float) -> tuple[Points, np.ndarray]:
    """Thin tubes of three sides along lines (N, K, 3), pointed at their ends."""
    count, long = ways.shape[:2]
    ahead = ways[:, -1] - ways[:, 0]
    one = np.cross(ahead, [0.3, 0.5, 0.8])
    one /= np.maximum(np.linalg.norm(one, axis=1, keepdims=True), 1e-12)
    other = np.cross(ahead / np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-12), one)
    turn = 2 * np.pi * np.arange(3) / 3
    ring = np.cos(turn)[None, :, None] * one[:, None] + np.sin(turn)[None, :, None] * other[:, None]
    thin = radius * np.linspace(1, 0.15, long)
    points = ways[:, :, None] + thin[None, :, None, None] * ring[:, None]
    k = np.arange(count * long * 3).reshape(count, long, 3)
    a, b = k[:, :-1].ravel(), np.roll(k, -1, axis=2)[:, :-1].ravel()
    faces = np.concatenate([np.stack([a, b, b + 3], 1), np.stack([a, b + 3, a + 3], 1)])
    return points.reshape(-1, 3), faces


def _leaves(
    one: Species, height: float, ways: Points, count: int, leafy: float, random: np.random.Generator
) -> tuple[np.ndarray, ...]:
    """Leaves along twigs, by hue: what lies deep in the crown is dark, what stands at its outside and above is light."""
    if count == 0:
        return tuple(np.zeros((0, 4, 3)) for _ in range(HUES))
    owner = random.integers(len(ways), size=count)
    at = random.random(count) ** 0.7 * (ways.shape[1] - 1)
    k = np.minimum(at.astype(int), ways.shape[1] - 2)
    step = ways[owner, k + 1] - ways[owner, k]
    foot = ways[owner, k] + (at - k)[:, None] * step + random.normal(0, one.spread * height, (count, 3)) * [1, 1, 0.8]
    middle = np.median(ways.reshape(-1, 3), axis=0)
    off = (foot - middle) / np.maximum(np.quantile(np.abs(ways.reshape(-1, 3) - middle), 0.9, axis=0), 1e-6)
    outward = off / np.maximum(np.linalg.norm(off, axis=1, keepdims=True), 1e-6)
    ahead = step / np.maximum(np.linalg.norm(step, axis=1, keepdims=True), 1e-12)
    ahead = 0.5 * ahead + 0.5 * outward + 0.5 * random.normal(size=(count, 3)) - np.array([0, 0, one.droop])
    cards = _cards(foot, ahead, outward + np.array([0, 0, 0.5]), one, leafy * one.cover * height**2 / count, random)
    light = 0.55 * np.linalg.norm(off, axis=1) + 0.35 * off[:, 2] + 0.28 * random.normal(size=count)
    low, high = np.quantile(light, (0.34, 0.74))
    return cards[light < low], cards[(light >= low) & (light < high)], cards[light >= high]


def _cards(
    foot: Points, ahead: Points, up: Points, one: Species, area: float, random: np.random.Generator
) -> np.ndarray:
    """Leaves of an area, m^2, each a folded blade of four corners, their upper sides about `up`."""
    count = len(foot)
    ahead = ahead / np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    across = np.cross(ahead, up + 0.7 * random.normal(size=(count, 3)))
    across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-9)
    over = np.cross(across, ahead)
    wide = one.leaf[1]
    long = ((2 * area / wide) ** 0.5 * random.uniform(0.7, 1.25, count))[:, None]
    middle = foot + 0.45 * long * ahead + 0.06 * long * over
    side = 0.5 * wide * long * across
    return np.stack([foot, middle - side, foot + long * ahead, middle + side], axis=1)


def _palm(height: float, random: np.random.Generator, triangles: int) -> Grown:
    """A coconut palm: a slender, curved trunk, and fronds that arch over, each with leaflets to both sides."""
    top = 0.82 * height
    lean = 0.10 * height * np.array([1.0, random.uniform(-0.6, 0.6), 0])
    share = np.linspace(0, 1, 26)[:, None]
    trunk = lean * share**1.7 + np.array([0, 0, top]) * share
    rings = 0.021 * height * (1 - 0.45 * share.ravel()) * np.where(np.arange(26) % 2, 1.0, 0.9)
    rings[0] *= 1.6
    tubes = [limb(trunk, list(rings), sides=9)]
    fronds = 22
    pairs = int(np.clip((triangles - 1800) / (fronds * 4), 14, 46))
    cards, age = [], []
    for number in range(fronds):
        old = (number + 0.5) / fronds
        turn, lift = TURN * number, 1.25 - 1.9 * old
        out = np.array([np.cos(turn), np.sin(turn), 0.0])
        ahead = np.cos(lift) * out + np.sin(lift) * np.array([0, 0, 1.0])
        long = 0.36 * height * random.uniform(0.85, 1.1)
        way = _way(trunk[-1], ahead, long, np.array([0, 0, -1.5]), 0.03, random, 8)
        tubes.append(limb(way, list(0.0042 * height * np.linspace(1, 0.15, len(way))), sides=3))
        at = np.repeat(np.linspace(0.12, 0.99, pairs), 2)
        hand = np.tile([-1.0, 1.0], pairs)
        feet, alongs = (np.array(part) for part in zip(*(_on(way, a) for a in at), strict=True))
        level = np.cross(alongs, [0, 0, 1.0])
        level /= np.maximum(np.linalg.norm(level, axis=1, keepdims=True), 1e-9)
        tips = 0.55 * alongs + hand[:, None] * level - np.array([0, 0, 1.0]) * (0.35 + 0.5 * old)
        tips += random.normal(0, 0.08, tips.shape)
        tips /= np.linalg.norm(tips, axis=1, keepdims=True)
        size = (0.125 * height * np.sin(np.pi * (0.16 + 0.8 * at)) ** 0.6)[:, None]
        half = 0.055 * size * alongs * 46 / pairs
        middle = feet + 0.4 * size * tips + 0.05 * size * np.array([0, 0, 1.0])
        cards.append(np.stack([feet, middle - half, feet + size * tips, middle + half], axis=1))
        age.append(np.full(len(feet), old) + 0.15 * random.normal(size=len(feet)))
    wood, faces = joined(tubes)
    every, ages = np.concatenate(cards), np.concatenate(age)
    return Grown(wood, faces, (every[ages > 0.66], every[(ages > 0.3) & (ages <= 0.66)], every[ages <= 0.3]))


def _hedge(height: float, random: np.random.Generator, triangles: int) -> Grown:
    """A piece of clipped hedge, twice as long as high along x, full of leaves around a dark core."""
    half = np.array([1.0, 0.32, 0.5]) * height
    core = 0.86 * half
    corners = np.array([[x, y, z] for z in (0, 2 * core[2]) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))], float)
    corners[:, :2] *= core[:2]
    box = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 6, 7)]
    faces = np.array([corner for a, b, c, d in box for corner in ((a, b, c), (a, c, d))])
    count = max((triangles - len(faces)) // 2, 200)
    areas = np.array([half[0] * half[2], half[0] * half[2], half[1] * half[2], half[1] * half[2], half[0] * half[1]])
    normals = np.array([[0, 1, 0], [0, -1, 0], [1, 0, 0], [-1, 0, 0], [0, 0, 1.0]])
    plane = random.choice(5, size=count, p=areas / areas.sum())
    out = normals[plane]
    depth = random.random(count) ** 1.5
    place = random.uniform(-1, 1, (count, 3)) * half
    shell = half * (1.0 - 0.14 * depth[:, None]) * (1 + 0.02 * random.normal(size=(count, 1)))
    place = np.where(np.abs(out) > 0.5, out * shell, place) + np.array([0, 0, half[2]])
    one = Species(cover=1.0, leaf=(1.0, 0.6))
    ahead = 0.8 * out + 0.7 * random.normal(size=(count, 3)) - np.array([0, 0, 0.15])
    area = 3.2 * float(areas.sum()) * 4 / count
    cards = _cards(place, ahead, out + np.array([0, 0, 0.6]), one, area, random)
    light = -depth + 0.25 * out[:, 2] + 0.3 * random.normal(size=count)
    low, high = np.quantile(light, (0.3, 0.75))
    return Grown(corners, faces, (cards[light < low], cards[(light >= low) & (light < high)], cards[light >= high]))

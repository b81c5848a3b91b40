"""Things that break: plate, rod, bar with grooves, vessel, and any convex solid. Metres; the frame is the middle of the box around it.

Where a thing can break is planned, by seeds that a number decides; where, when and whether it does is the load's answer.
"""

from collections.abc import Callable, Sequence

import numpy as np

from .convex_cells import OUTSIDE, Cell, Face, solid
from .fragments import GAP_M, Fragments, joined, voronoi

Array = np.ndarray
Vec3 = tuple[float, float, float]
STAVES = 32
"""Flat strips that a vessel is turned of."""
TRIES = 40
"""Random places per seed, of which the one farthest from the others is taken."""


def plate(size: Vec3, shards: int = 48, seed: int = 0, struck_at: Vec3 | None = None) -> Fragments:
    """A pane or slab of full extents `size`, m, whose cracks run across its thinnest extent.

    Args:
        size: m.
        shards: how many pieces.
        seed: of the pattern.
        struck_at: from the middle, m: cracks then run out from there and round it, small near it, as in glass; None: evenly.
    """
    extents = _counted("plate", size, shards)
    rng, thin = np.random.default_rng(seed), int(extents.argmin())
    flat = [axis for axis in range(3) if axis != thin]
    half = extents[flat] / 2
    if struck_at is None:
        places = _spread(lambda count: rng.uniform(-half, half, (count, 2)), shards)
    else:
        centre = np.array(struck_at, float)[flat]
        if (np.abs(centre) >= half).any():
            raise ValueError(f"plate: struck_at {struck_at} lies beside a plate of {size} m")
        places = _struck(rng, centre, half, shards)
    seeds = np.zeros((shards, 3))
    seeds[:, flat] = places
    return voronoi([box(extents)], seeds)


def rod(
    diameter: float,
    length: float,
    pieces: int = 8,
    seed: int = 0,
    tip: float | None = None,
    skew: float = 0.5,
    sides: int = 12,
) -> Fragments:
    """A twig, a stick of chalk, an icicle: a rod along z whose cracks run across it, aslant.

    Args:
        diameter: m.
        length: m.
        pieces: how many.
        seed: of where it may break, and how aslant.
        tip: diameter of its upper end, m, which is no point; None: as thick as the other.
        skew: 0 cuts straight across; 1 up to about 45 degrees where pieces are as long as thick.
        sides: corners of its section, whose area is that of the circle.
    """
    tip = diameter if tip is None else tip
    _counted("rod", (diameter, diameter, length), pieces)
    if not 0 < tip < np.inf:
        raise ValueError(
            f"rod: a tip of {tip} m across: give a diameter above 0, or None for one as thick as the other end"
        )
    rng = np.random.default_rng(seed)
    turn = (np.arange(sides) + 0.5) * 2 * np.pi / sides
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=1) * np.sqrt(2 * np.pi / sides / np.sin(2 * np.pi / sides)) / 2
    ends = [np.insert(d * ring, 2, z, axis=1) for d, z in ((diameter, -length / 2), (tip, length / 2))]
    pitch = length / pieces
    seeds = np.zeros((pieces, 3))
    seeds[:, 2] = (np.arange(pieces) + 0.5) * pitch - length / 2
    if skew:
        seeds[:, 2] += rng.uniform(-0.2, 0.2, pieces) * pitch * min(skew, 1.0)
        seeds[:, :2] = rng.uniform(-0.35, 0.35, (pieces, 2)) * skew * min(pitch, diameter, tip)
    return voronoi([solid(np.concatenate(ends))], seeds)


def grooved(size: Vec3, columns: int, rows: int, groove: float) -> Fragments:
    """A bar of chocolate: `columns` along x and `rows` along y of blocks with a bevel; grooves from above, `groove` deep, m."""
    extents = _counted("grooved", size, columns * rows)
    if not 0 < groove < extents[2]:
        raise ValueError(f"grooved: a groove of {groove} m in a bar {extents[2]} m thick: give one between")
    pitch = extents[:2] / (columns, rows)
    bevel = min(groove, float(pitch.min()) / 4)
    groups, hulls = [], []
    for number in range(columns * rows):
        column, row = divmod(number, rows)
        low = np.array([column, row]) * pitch - extents[:2] / 2
        beyond = {(-1, 0): column > 0, (1, 0): column < columns - 1, (0, -1): row > 0, (0, 1): row < rows - 1}
        block = _bevelled(low, low + pitch, extents[2], groove, bevel)
        faces = []
        for face in block.faces:
            way = np.round(np.cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[1]), 15)
            side = (int(np.sign(way[0])), int(np.sign(way[1]))) if way[2] == 0 else (0, 0)
            other = number + side[0] * rows + side[1] if beyond.get(side) else OUTSIDE
            faces.append(Face(face.corners, other))
        groups.append([Cell(tuple(faces))])
        hulls.append(
            np.concatenate(
                [f.corners for f in _bevelled(low + GAP_M, low + pitch - GAP_M, extents[2], groove, bevel).faces]
            )
        )
    return joined(groups, hulls)


def vessel(
    profile: Sequence[tuple[float, float]], wall: float, shards: int = 40, seed: int = 0, smooth: int = 0
) -> Fragments:
    """A vase, bowl or plate: a thin shell turned round z, open at the top, as `worldkit.forms.lathe` makes it.

    Args:
        profile: (radius, height) of its outer line from the middle of the bottom to the rim, m.
        wall: thickness, m.
        shards: how many pieces.
        seed: of the pattern.
        smooth: points put between each two of the profile.
    """
    from ..forms import lathe
    from ..forms.outlines import cells, line, smoothed, thickened

    if shards < 2:
        raise ValueError(f"vessel: {shards} shards are none to break into: give 2 or more")
    lathe(profile=profile, wall=wall, smooth=smooth)  # refuses what cannot be turned
    outline = thickened(smoothed(line("vessel", profile, 2, 2), smooth), wall)
    outline[:, 0] = np.maximum(outline[:, 0], 0.0)
    if outline[0, 0] == 0.0:
        outline[-1, 0] = 0.0
    turn = np.arange(STAVES) * 2 * np.pi / STAVES
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    blocks, middles, volumes = [], [], []
    for corners in (outline[cell] for cell in cells(outline)):
        for k in range(STAVES):
            both = [np.column_stack([np.outer(corners[:, 0], way), corners[:, 1]]) for way in ring[[k, k - 1]]]
            blocks.append(solid(np.unique(np.round(np.concatenate(both), 12), axis=0)))
            middles.append(np.concatenate(both))
            volumes.append(float(corners[:, 0].mean()) * float(np.ptp(corners, axis=0).max()))
    rng, share = np.random.default_rng(seed), np.array(volumes) / sum(volumes)

    def somewhere(count: int) -> Array:
        chosen = rng.choice(len(blocks), count, p=share)
        weights = [rng.dirichlet(np.ones(len(middles[one]))) for one in chosen]
        return np.array([weight @ middles[one] for weight, one in zip(weights, chosen, strict=True)])

    return voronoi(blocks, _spread(somewhere, shards))


def convex(corners: Sequence[Vec3], seeds: Sequence[Vec3]) -> Fragments:
    """Any convex solid, the hull of its corners, cut by the cells of seeds of your own, m."""
    return voronoi([solid(np.array(corners, float))], np.array(seeds, float))


def box(extents: Array) -> Cell:
    """A box of full extents (3,), m, about the origin."""
    return solid(np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * extents)


def _counted(what: str, size: Vec3, pieces: int) -> Array:
    extents = np.array(size, float)
    if extents.shape != (3,) or not (np.isfinite(extents).all() and (extents > 4 * GAP_M).all()):
        raise ValueError(f"{what}: its extents must be three numbers above {4 * GAP_M} m, got {size}")
    if pieces < 2:
        raise ValueError(f"{what}: {pieces} pieces are none to break into: give 2 or more")
    return extents


def _bevelled(low: Array, high: Array, height: float, groove: float, bevel: float) -> Cell:
    """A block from (x, y) to (x, y), its upper edges cut off: `bevel` wide, `groove` high."""
    shoulder = height / 2 - groove
    rows = ((low, high, -height / 2), (low, high, shoulder), (low + bevel, high - bevel, height / 2))
    return solid(np.array([(x, y, z) for a, b, z in rows for x in (a[0], b[0]) for y in (a[1], b[1])]))


def _spread(draw: Callable[[int], Array], count: int) -> Array:
    """Places (count, d) that keep apart: each is the farthest from the others of many drawn.

    Source: Mitchell's best candidate, 1991.
    """
    found = draw(1)
    while len(found) < count:
        offered = draw(TRIES)
        apart = np.linalg.norm(offered[:, None] - found[None], axis=2).min(axis=1)
        found = np.concatenate([found, offered[[int(apart.argmax())]]])
    return np.asarray(found)


def _struck(rng: np.random.Generator, centre: Array, half: Array, count: int) -> Array:
    """Places (count, 2) on rings about a blow, closer the nearer they are: cells between spokes and rings."""
    far = float(np.linalg.norm(np.abs(centre) + half))
    spokes = max(5, round(np.sqrt(count) * 1.3))
    rings = 1
    while True:
        radii = far * np.geomspace(0.14, 0.9, rings)
        found = [centre[None] + rng.normal(0, 1e-4, (1, 2)) * half]
        for k, radius in enumerate(radii):
            turn = (np.arange(spokes) + 0.5 * (k % 2) + rng.uniform(-0.28, 0.28, spokes)) * 2 * np.pi / spokes
            away = radius * (1 + rng.uniform(-0.15, 0.15, spokes))
            found.append(centre + (away * np.stack([np.cos(turn), np.sin(turn)])).T)
        places = np.concatenate(found)
        inside = places[(np.abs(places) < 0.96 * half).all(axis=1)]
        if len(inside) >= count:
            return inside[np.sort(np.argsort(np.linalg.norm(inside - centre, axis=1), kind="stable")[:count])]
        rings += 1

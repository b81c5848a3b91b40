"""Particles that hang together are seen as one thing: how large the clumps are that a film's particles make, frame by frame."""

from typing import TYPE_CHECKING, Any

import numpy as np

from .one_surface import REACH

if TYPE_CHECKING:
    from collections.abc import Iterator

POINTS, FRAMES = 400_000, 48
"""So many particles in all are looked at, in at most so many frames, evenly spread."""
NEAREST = 9
"""So many of the nearest, itself among them, link nearly all that hang together."""
MERGED = 0.5
"""Of the largest radius: those in one cell so wide are one to whoever looks."""


def sizes(things: "tuple[dict[str, Any], ...]", arrays: "dict[str, np.ndarray]") -> "dict[str, np.ndarray]":
    """(K,) m for each of some particles (things with `ways`), by name: the longest sides of all clumps of at least two of which some
    are its own, whosesoever the others."""
    flying = [thing for thing in things if thing.get("ways")]
    found: dict[str, list[float]] = {thing["name"]: [] for thing in flying}
    if flying:
        count = sum(arrays[thing["ways"]].shape[1] for thing in flying)
        frames = len(arrays[flying[0]["ways"]])
        looked = min(frames, looks_at(count))
        owner = np.repeat(np.arange(len(flying)), [arrays[thing["ways"]].shape[1] for thing in flying])
        for frame in np.unique(np.linspace(0, frames - 1, looked).astype(int)):
            points = np.concatenate([arrays[thing["ways"]][frame] for thing in flying])
            radii = np.concatenate([_radius(thing, arrays) * arrays[thing["sizes"]][frame] for thing in flying])
            seen = radii > 0
            for mine, side in _clumps(points[seen].astype(float), radii[seen]):
                for number in np.unique(owner[seen][mine]):
                    found[flying[number]["name"]].append(side)
    return {name: np.array(sides) for name, sides in found.items()}


def looks_at(count: int) -> int:
    """In how many frames so many points are looked at."""
    return int(np.clip(POINTS // max(count, 1), 4, FRAMES))


def sides(points: np.ndarray, radii: np.ndarray) -> list[float]:
    """The longest sides, m, of all clumps of at least two of balls (P, 3), m, of radii (P,), m."""
    return [side for _, side in _clumps(points, radii)]


def _radius(thing: "dict[str, Any]", arrays: "dict[str, np.ndarray]") -> float:
    """Of a particle whose size is 1; of a shape that is copied, half its longest side."""
    if "turns" not in thing:
        return 0.5
    return float(np.ptp(arrays[thing["vertices"]] * np.array(thing["size"]), axis=0).max()) / 2


def _clumps(points: np.ndarray, radii: np.ndarray) -> "Iterator[tuple[np.ndarray, float]]":
    """Indices of those in each clump of at least two of balls (P, 3), m, of radii (P,), m, and the longest side of the box around it."""
    if len(points) < 2:
        return
    _, node = np.unique(np.floor(points / (MERGED * radii.max())), axis=0, return_inverse=True)
    node = node.ravel()
    count = int(node.max()) + 1
    places = np.stack([np.bincount(node, points[:, k]) for k in range(3)], axis=1) / np.bincount(node)[:, None]
    wide = np.zeros(count)
    np.maximum.at(wide, node, radii)
    clump = linked(places, wide)[node]
    order = np.argsort(clump, kind="stable")
    first = np.flatnonzero(np.diff(clump[order], prepend=-1))
    low = np.minimum.reduceat((points - radii[:, None])[order], first)
    high = np.maximum.reduceat((points + radii[:, None])[order], first)
    for mine, side in zip(np.split(order, first[1:]), (high - low).max(axis=1), strict=True):
        if len(mine) > 1:
            yield mine, float(side)


def linked(places: np.ndarray, wide: np.ndarray) -> np.ndarray:
    """(P,) the clump of each of some balls at (P, 3), m, of radii (P,), m: two whose middles are within `REACH` mean radii hang together.

    To list all such pairs takes hundreds of each ball where they lie close. Its nearest link what is in the middle of a clump; all
    pairs are asked only where more than one clump is within reach.
    """
    from scipy.spatial import cKDTree

    count, reach = len(places), REACH * float(wide.max())
    away, others = cKDTree(places).query(
        places, range(1, min(NEAREST, count) + 1), distance_upper_bound=reach * (1 + 1e-9)
    )
    some = np.isfinite(away)
    ones = np.repeat(np.arange(count), some.sum(axis=1))
    clump = _joined(np.stack([ones, others[some]], axis=1), places, wide, np.arange(count))
    cells, cell = np.unique(np.floor(places / reach).astype(np.int64), axis=0, return_inverse=True)
    cell, low, high = cell.ravel(), np.full(len(cells), count), np.full(len(cells), -1)
    np.minimum.at(low, cell, clump)
    np.maximum.at(high, cell, clump)
    one, other = cKDTree(cells).query_pairs(1.5, p=np.inf, output_type="ndarray").T
    least, most = low.copy(), high.copy()
    for mine, theirs in ((one, other), (other, one)):
        np.minimum.at(least, mine, low[theirs])
        np.maximum.at(most, mine, high[theirs])
    left = np.flatnonzero((least < most)[cell])
    if not len(left):
        return clump
    return _joined(left[cKDTree(places[left]).query_pairs(reach, output_type="ndarray")], places, wide, clump)


def _joined(pairs: np.ndarray, places: np.ndarray, wide: np.ndarray, clump: np.ndarray) -> np.ndarray:
    """Clumps (P,) of balls that were in such already, with those of pairs (N, 2) joined that are near enough."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    one, other = pairs.T
    near = np.linalg.norm(places[one] - places[other], axis=1) <= REACH * (wide[one] + wide[other]) / 2
    links = coo_array((np.ones(int(near.sum())), (clump[one[near]], clump[other[near]])), shape=(len(clump),) * 2)
    return np.asarray(connected_components(links, directed=False)[1][clump])

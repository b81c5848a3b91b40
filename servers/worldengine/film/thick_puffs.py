"""What a film's puffs hide of a world, and which are so thick together that they look like a thing.

A puff hides by its optical depth on the way of a ray, exp(-depth) of what is behind it, as it is drawn (`puffs`).
"""

from typing import TYPE_CHECKING, Any

from . import clumps
from .wisps import depth_of

if TYPE_CHECKING:
    import numpy as np

HIDES = 0.5
"""From this share on of what is behind them puffs count as hiding it, and as thick where they lie in one place."""
PLACE = 0.25
"""In diameters: puffs in one cell so wide look like one."""


def before(
    puffs: "tuple[dict[str, Any], ...]",
    arrays: "dict[str, np.ndarray]",
    frame: int,
    eye: "np.ndarray",
    to: "np.ndarray",
    wisps: "tuple[tuple[str, np.ndarray, np.ndarray, np.ndarray], ...]" = (),
) -> str:
    """The name of the puffs that hide most of a point from an eye (3,), m, in a frame; empty where all of them hide too little.

    `wisps` are those of clouds in that frame: a name, places (Q, 3), radii (Q,), m, and opacities (Q,) of each (`wisps.Cloud.puffs`).
    """
    import numpy as np

    away = float(np.linalg.norm(to - eye))
    way, depths = (to - eye) / max(away, 1e-9), dict[str, float]()
    told = [*wisps]
    for one in puffs:
        places, wide, opaque = (np.asarray(arrays[one[what]][frame], float) for what in ("places", "wide", "opaque"))
        told.append((str(one["name"]), places, wide / 2, opaque))
    for name, places, radius, opaque in told:
        there = (radius > 0) & (opaque > 0)
        place = places[there] - eye
        along = place @ way
        met = (along > 0) & (along < away)
        aside = ((place[met] - along[met, None] * way) ** 2).sum(axis=1)
        thick = depth_of(opaque[there][met])
        depths[name] = depths.get(name, 0.0) + float((thick * np.exp(-2.0 * aside / radius[there][met] ** 2)).sum())
    hides = -np.expm1(-sum(depths.values())) >= HIDES
    return max(depths, key=lambda name: depths[name]) if hides else ""


def thick(one: dict[str, Any], arrays: "dict[str, np.ndarray]", frame: int) -> "np.ndarray":
    """(P,) whether each puff of a frame hides as much as a thing, with those in its place."""
    import numpy as np

    wide = np.asarray(arrays[one["wide"]][frame], float)
    depth = np.where(wide > 0, depth_of(arrays[one["opaque"]][frame]), 0.0)
    found = np.zeros(len(wide), bool)
    seen = np.flatnonzero(depth > 0)
    if len(seen):
        cells = np.floor(np.asarray(arrays[one["places"]][frame][seen], float) / (PLACE * float(np.median(wide[seen]))))
        _, cell = np.unique(cells, axis=0, return_inverse=True)
        found[seen] = -np.expm1(-np.bincount(cell.ravel(), depth[seen])[cell.ravel()]) >= HIDES
    return found


def sizes(one: dict[str, Any], arrays: "dict[str, np.ndarray]") -> "np.ndarray":
    """(K,) m: the longest sides of what its thick puffs make, alone and together, in frames spread evenly."""
    import numpy as np

    frames, count = arrays[one["places"]].shape[:2]
    found: list[float] = []
    for frame in np.unique(np.linspace(0, frames - 1, min(frames, clumps.looks_at(count))).astype(int)):
        seen = thick(one, arrays, int(frame))
        wide = np.asarray(arrays[one["wide"]][frame][seen], float)
        if len(wide):
            found.append(float(wide.max()))
            found += clumps.sides(np.asarray(arrays[one["places"]][frame][seen], float), wide / 2)
    return np.array(found)

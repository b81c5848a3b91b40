"""A body, or several together, has its centre of mass over what it stands on.

Measures how far inside the convex hull of the contact points with the support the centre of mass lies, seen along gravity,
metres: the least over the window, negative outside. Contact points of 20 ms around each instant count together; the engine touches
a plane with few of them (a cylinder with three or four of its rim, so that half its radius may be all). Source:
statics; a body stands as long as the line of gravity through its centre of mass meets its base of support.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import falling
from ....known.standing import standing
from ....measuring.measured import (
    HOP_S,
    Measured,
    Name,
    OfBodies,
    UnknowableError,
    at_least,
    contacts_of,
    masses,
    window,
)

CODE = "WE148"
LASTING = True
MOST_ROWS = 400


class Given(OfBodies):
    """On what, with how much to spare."""

    support: Name = Field(description="what it stands on; `ground` is the world")
    min_margin_m: float = Field(
        0.0, description="least distance of the centre of mass inside the edge of the support, m"
    )


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The least margin."""
    bodies = given.indices(trajectory)
    weights = masses(trajectory)[bodies]
    rows = window(trajectory, given.window_s)
    contacts = trajectory.contacts
    if contacts is None:
        raise UnknowableError("no contacts were recorded")
    gravity = float(np.linalg.norm(trajectory.gravity))
    if not gravity or not weights.sum() > 0:
        raise UnknowableError("nothing weighs anything here, so nothing can balance")
    mine = np.any([contacts_of(trajectory, name, given.support) for name in given.names], axis=0) & contacts.live
    at, points = contacts.row[mine], contacts.position[mine]
    flat = _across(trajectory.gravity / gravity)
    centre = np.einsum("b,tbi->ti", weights / weights.sum(), trajectory.com[:, bodies]) @ flat.T
    near = max(1, round(HOP_S / 2 / max(trajectory.interval_s, 1e-9)))
    chosen = np.unique(np.linspace(rows.start, rows.stop - 1, min(MOST_ROWS, rows.stop - rows.start)).astype(int))
    margins = []
    for row in chosen:
        low, high = np.searchsorted(at, (row - near, row + near + 1))
        if high > low:
            margins.append((inside(points[low:high] @ flat.T, centre[row]), row))
    told = " and ".join(given.names)
    if not margins:
        reach = float(trajectory.size_m[bodies].max())
        return at_least(
            min(-reach, given.min_margin_m - reach),
            given.min_margin_m,
            "m",
            f"{told} does not stand on {given.support}",
        )
    least, row = min(margins)
    message = f"the centre of mass of {told} is {abs(least):.4g} m {'inside' if least >= 0 else 'outside'} its support"
    return at_least(least, given.min_margin_m, "m", f"{message} at {trajectory.t[row]:.3f} s")


def _across(down: np.ndarray) -> np.ndarray:
    """(2, 3) two directions at right angles to gravity and each other."""
    seed = np.eye(3)[np.abs(down).argmin()]
    first = np.cross(down, seed)
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(down, first)])


def inside(points: np.ndarray, place: np.ndarray) -> float:
    """How far a place (2,) lies inside the convex hull of points (N, 2); negative is its distance from the hull."""
    corners = _hull(points)
    edges = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(edges[:, 0], edges[:, 1])
    apart = place - corners
    if len(corners) > 2:
        left = (edges[:, 0] * apart[:, 1] - edges[:, 1] * apart[:, 0]) / lengths
        if left.min() >= 0:
            return float(left.min())
    share = np.clip((apart * edges).sum(axis=1) / np.maximum(lengths, 1e-300) ** 2, 0.0, 1.0)
    return -float(np.linalg.norm(apart - share[:, None] * edges, axis=1).min())


def _hull(points: np.ndarray) -> np.ndarray:
    """(H, 2) convex hull, counter-clockwise (A. M. Andrew's monotone chain, 1979)."""
    ordered = sorted({(float(x), float(y)) for x, y in points})
    if len(ordered) < 3:
        return np.array(ordered)
    found: list[tuple[float, float]] = []
    for sequence in (ordered, ordered[::-1]):
        start = len(found)
        for x, y in sequence:
            while len(found) - start >= 2:
                (ax, ay), (bx, by) = found[-2:]
                if (bx - ax) * (y - by) - (by - ay) * (x - bx) > 0:
                    break
                found.pop()
            found.append((x, y))
        found.pop()
    return np.array(found)


GOOD = (
    (standing, {"body": "body", "support": "ground", "min_margin_m": 0.0999}),
    (lambda: standing(lean_m=0.06), {"body": "body", "support": "ground", "min_margin_m": 0.0399}),
)
BAD = (
    (lambda: standing(lean_m=0.12), {"body": "body", "support": "ground"}),
    (lambda: standing(lean_m=0.06), {"body": "body", "support": "ground", "min_margin_m": 0.05}),
    (lambda: falling(seconds=0.3, touches=[]), {"body": "body", "support": "ground"}),
)

"""How far the points of an author's laws lie from where they were recorded, and how far their colours are from those: the
trajectory's own motion says nothing of them.
"""

from pathlib import Path

from .digest import POSITION_M, SHARE

COLOUR = 4
"""Of 255: what reckons a colour in another environment may be off by."""


def apart(recorded: Path, asked: Path) -> str:
    """Why the points of two recordings are not alike, by the tolerance that bodies have; empty where they are."""
    import numpy as np

    from worldengine.recording import point_colours, stored

    rows = [stored.Replayable(folder).media for folder in (recorded, asked)]
    keys, places, colours = [], [], []
    for table in rows:
        order = np.lexsort((table.step, table.point, table.medium))
        keys.append(np.stack([table.medium, table.point, table.step])[:, order])
        places.append(np.asarray(table.place, float)[order])
        colours.append(255.0 * point_colours.shares(table.colour[order]))
    if keys[0].shape != keys[1].shape or (keys[0] != keys[1]).any():
        return f"its laws tell {len(rows[1])} places, recorded {len(rows[0])}, or at other steps"
    if not len(places[0]):
        return ""
    begins = np.flatnonzero(np.r_[True, (np.diff(keys[0][:2]) != 0).any(axis=0)])  # where another point's rows begin
    ways = []
    for place in places:
        way = np.r_[0.0, np.linalg.norm(np.diff(place, axis=0), axis=1)]
        way[begins] = 0.0
        total = np.cumsum(way)
        ways.append(total - np.repeat(total[begins], np.diff(np.r_[begins, len(way)])))
    # By the shorter way: points that were written to tremble would else earn what they are off.
    off, allowed = np.linalg.norm(places[1] - places[0], axis=1), POSITION_M + SHARE * np.minimum(*ways)
    other = np.abs(colours[1] - colours[0]).max(axis=1)
    if other.max() > COLOUR:
        medium, point, step = keys[0][:, int(np.argmax(other))]
        return (
            f"point {point} of law {medium} is {other.max():.0f} of 255 off in colour at step {step} (allowed {COLOUR})"
        )
    excess = off / allowed
    excess = np.where(np.isfinite(excess), excess, np.inf)
    worst = int(np.argmax(excess))
    if excess[worst] <= 1.0:
        return ""
    medium, point, step = keys[0][:, worst]
    return f"point {point} of law {medium} is {off[worst]:.2e} m off at step {step} (allowed {allowed[worst]:.2e} m)"

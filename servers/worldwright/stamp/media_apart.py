"""How far the points of an author's laws lie from where they were recorded: the trajectory's own motion says nothing of them."""

from pathlib import Path

from .digest import POSITION_M, SHARE


def apart(recorded: Path, asked: Path) -> str:
    """Why the points of two recordings are not alike, by the tolerance that bodies have; empty where they are."""
    import numpy as np

    from worldengine.recording import stored

    rows = [stored.Replayable(folder).media for folder in (recorded, asked)]
    keys, places = [], []
    for table in rows:
        order = np.lexsort((table.step, table.point, table.medium))
        keys.append(np.stack([table.medium, table.point, table.step])[:, order])
        places.append(np.asarray(table.place, float)[order])
    if keys[0].shape != keys[1].shape or (keys[0] != keys[1]).any():
        return f"its laws tell {len(rows[1])} places, recorded {len(rows[0])}, or at other steps"
    if not len(places[0]):
        return ""
    way = np.zeros(len(places[0]))
    way[1:] = np.linalg.norm(np.diff(places[0], axis=0), axis=1)
    begins = np.flatnonzero(np.r_[True, (np.diff(keys[0][:2]) != 0).any(axis=0)])  # where another point's rows begin
    way[begins] = 0.0
    total = np.cumsum(way)
    travelled = total - np.repeat(total[begins], np.diff(np.r_[begins, len(way)]))
    off, allowed = np.linalg.norm(places[1] - places[0], axis=1), POSITION_M + SHARE * travelled
    excess = np.where(np.isfinite(off), off / allowed, np.inf)
    worst = int(np.argmax(excess))
    if excess[worst] <= 1.0:
        return ""
    medium, point, step = keys[0][:, worst]
    return f"point {point} of law {medium} is {off[worst]:.2e} m off at step {step} (allowed {allowed[worst]:.2e} m)"

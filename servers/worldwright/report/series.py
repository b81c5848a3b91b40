"""What the plots of a report show, taken from a recording: a few hundred points a line that keep every peak."""

from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..model.recording.trajectory import Trajectory

POINTS = 480
"""Bins a line is reduced to; each keeps its lowest and highest value."""
LINES = 8
"""Bodies shown in one plot: those that move most."""
PAIRS = 10
"""Rows of the contact timeline: first the pairs whose contact begins, ends or is broken, then the lasting ones."""
MOVED_M, TURNED_RAD = 2e-3, 0.05
"""A body that travelled or turned less than this is not drawn as moving."""
WENT_M = 0.05
"""Paths from above are drawn when some body went at least this far."""


@dataclass(frozen=True)
class Line:
    """One curve."""

    name: str
    x: list[float]
    y: list[float]


@dataclass(frozen=True)
class Touch:
    """One row of the contact timeline."""

    name: str
    spans: list[tuple[float, float]]
    """Start and end of each contact, s."""
    peak_n: float
    """Largest normal force, N."""

    def lasts(self, start: float, end: float) -> bool:
        """Whether it is one contact from `start` or earlier to `end` or later."""
        return len(self.spans) == 1 and self.spans[0][0] <= start and self.spans[0][1] >= end


@dataclass(frozen=True)
class Motion:
    """Everything the plots need."""

    duration_s: float
    rows: int
    time_step: float
    bodies: int
    complete: bool
    heights: list[Line] = field(default_factory=list)
    speeds: list[Line] = field(default_factory=list)
    energies: list[Line] = field(default_factory=list)
    paths: list[Line] = field(default_factory=list)
    """Seen from above: x right, y up, metres."""
    contacts: list[Touch] = field(default_factory=list)
    more_bodies: int = 0
    """Moving bodies that are not shown."""
    more_pairs: int = 0
    sampled: bool = False
    """Whether only the stamp's samples are available, not the recording."""


def read(recording: Path, first: tuple[str, ...] = ()) -> Motion:
    """Reduce a recording folder (see `of`). A broken recording is a `RecordingError`."""
    from ..model.recording.trajectory_files import read_trajectory

    return of(read_trajectory(recording), first)


def of(trajectory: "Trajectory", first: tuple[str, ...] = ()) -> Motion:
    """Reduce a trajectory to what the plots show; bodies named in `first` come before those that move more."""
    import numpy as np

    from worldkit.turning import angles_between

    t = np.asarray(trajectory.t, dtype=float)
    went = _extent_m(trajectory.pos)
    turned = np.fmax.reduce(angles_between(trajectory.quat, trajectory.quat[0]), axis=0)
    named = [name in first for name in trajectory.names]
    moving = [i for i, name in enumerate(named) if name or went[i] > MOVED_M or turned[i] > TURNED_RAD]
    moving.sort(key=lambda i: (not named[i], -went[i]))
    shown = sorted(moving[:LINES])
    names = trajectory.names
    energies = []
    if trajectory.energy is not None:
        potential, kinetic = trajectory.energy[:, 0], trajectory.energy[:, 1]
        lowest = np.nanmin(potential) if np.isfinite(potential).any() else 0.0
        energies = [
            Line("total", *reduce(t, potential - lowest + kinetic)),
            Line("kinetic", *reduce(t, kinetic)),
            Line("potential, above its lowest", *reduce(t, potential - lowest)),
        ]
    contacts, more_pairs = _contacts(trajectory)
    return Motion(
        duration_s=float(t[-1]) if len(t) else 0.0,
        rows=len(t),
        time_step=trajectory.time_step,
        bodies=len(names),
        complete=trajectory.complete,
        heights=[Line(names[i], *reduce(t, trajectory.pos[:, i, 2])) for i in shown],
        speeds=[Line(names[i], *reduce(t, trajectory.speed[:, i])) for i in shown],
        energies=energies,
        paths=_paths([Line(names[i], *_path(trajectory.pos[:, i])) for i in shown]),
        contacts=contacts,
        more_bodies=len(moving) - len(shown),
        more_pairs=more_pairs,
    )


def _extent_m(pos: Any) -> Any:
    """(B,) diagonal of the box that each body's origin (T, B, 3) stays in; jitter at rest does not add up."""
    import numpy as np

    values = np.where(np.isfinite(pos), pos, np.nan)
    with np.errstate(all="ignore"):
        sides = np.fmax.reduce(values, axis=0) - np.fmin.reduce(values, axis=0)
    return np.nan_to_num(np.linalg.norm(sides, axis=1))


def reduce(t: Any, y: Any) -> tuple[list[float], list[float]]:
    """At most 2 x `POINTS` points of a curve (T,), keeping the extremes of every bin; values that are not finite are left out."""
    import numpy as np

    y = np.asarray(y, dtype=float)
    keep = np.isfinite(y)
    t, y = t[keep], y[keep]
    if len(t) > 2 * POINTS:
        edges = np.linspace(0, len(t), POINTS + 1).astype(int)
        chosen = {0, len(t) - 1}
        for start, end in pairwise(edges):
            chosen |= {start + int(np.argmin(y[start:end])), start + int(np.argmax(y[start:end]))}
        rows = np.array(sorted(chosen))
        t, y = t[rows], y[rows]
    return t.tolist(), y.tolist()


def _paths(lines: list[Line]) -> list[Line]:
    """The paths, when one of them leads anywhere."""
    spans = [max(max(line.x) - min(line.x), max(line.y) - min(line.y)) for line in lines if line.x]
    return lines if max(spans, default=0.0) >= WENT_M else []


def _path(pos: Any) -> tuple[list[float], list[float]]:
    """A path seen from above, thinned to points that lie apart."""
    import numpy as np

    flat = pos[np.isfinite(pos).all(axis=1)][:, :2]
    if len(flat) > POINTS:
        flat = flat[np.unique(np.linspace(0, len(flat) - 1, POINTS).astype(int))]
    return flat[:, 0].tolist(), flat[:, 1].tolist()


def _contacts(trajectory: Any) -> tuple[list[Touch], int]:
    """The bodies that touched, and when: gaps shorter than five recorded rows are bridged, so that chatter is one bar."""
    import numpy as np

    if trajectory.contacts is None or not len(trajectory.contacts.row):
        return [], 0
    found = trajectory.contacts.take(trajectory.contacts.live)
    low, high = np.minimum(found.body1, found.body2), np.maximum(found.body1, found.body2)
    pairs = np.stack([low, high], axis=1)
    touches = []
    t = trajectory.t
    interval = trajectory.interval_s or 0.0
    for one, other in np.unique(pairs, axis=0):
        mask = (low == one) & (high == other)
        rows = np.unique(found.row[mask])
        breaks = np.flatnonzero(np.diff(rows) > 5)
        starts, ends = rows[np.r_[0, breaks + 1]], rows[np.r_[breaks, len(rows) - 1]]
        spans = [(float(t[a]), float(t[b]) + interval) for a, b in zip(starts, ends, strict=True)]
        force = found.normal_force[mask]
        peak = float(np.nanmax(force)) if np.isfinite(force).any() else 0.0
        names = [_name(trajectory, int(i)) for i in (one, other)]
        touches.append(Touch(" · ".join(sorted(names, key=lambda n: n == "world")), spans, peak))
    first, last = float(t[0]) + 2 * interval, float(t[-1])
    touches.sort(key=lambda h: (h.lasts(first, last), -sum(end - start for start, end in h.spans)))
    kept = touches[:PAIRS]
    kept.sort(key=lambda touch: touch.spans[0][0])
    return kept, max(0, len(touches) - PAIRS)


def _name(trajectory: Any, index: int) -> str:
    return "world" if index < 0 else str(trajectory.names[index])


def from_samples(sampled: Any, summary: dict[str, Any]) -> Motion:
    """What a stamp's few motion samples can still show when the recording itself is not here."""
    import numpy as np

    t = list(sampled.time_s)
    position = np.asarray(sampled.position, dtype=float).reshape(len(t), len(sampled.bodies), 3)
    travelled = np.asarray(sampled.travelled_m, dtype=float).reshape(len(t), len(sampled.bodies))
    shown = sorted(np.argsort(-travelled[-1], kind="stable")[:LINES].tolist()) if len(t) else []
    return Motion(
        duration_s=t[-1] if t else 0.0,
        rows=int(summary.get("rows") or len(t)),
        time_step=float(summary.get("time_step") or 0.0),
        bodies=len(sampled.bodies),
        complete=True,
        heights=[Line(sampled.bodies[i], t, position[:, i, 2].tolist()) for i in shown],
        paths=_paths([Line(sampled.bodies[i], *_path(position[:, i])) for i in shown]),
        more_bodies=len(sampled.bodies) - len(shown),
        sampled=True,
    )

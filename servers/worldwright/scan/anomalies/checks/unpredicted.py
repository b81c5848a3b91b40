"""A body moves otherwise than its own model makes it move.

What it means: a force that the model does not have acted, a state was written, a parameter was changed while it ran, or
the recording was edited: frozen, shifted, swapped, run backwards, its clock renumbered, or its velocities written in
another frame.

Formula: the state of each row, in the joints of the model beside the recording, is stepped forward by the engine to the
time of the next row; left over is recorded less predicted. A jump: |dv| + r |dw| > 0.3 sqrt(g r) in one step (0.1 where
nothing is touched), or a place more than 0.05 r off. A force: the mean of dv / dt, or of r dw / dt, over 0.3 s exceeds a
twentieth of gravity. What actuators of unknown control move, or touch, is not judged; of an equality, either state counts.
Threshold: the engine repeats its own free motion to 1e-4 m/s^2, and chattering contacts to 0.4 m/s^2 over 0.3 s. A jump
apart from everything blocks; a smooth force may be meant by a program that is not here, and warns.
Source: Newton's second law, by one step of forward dynamics (Featherstone, Rigid Body Dynamics Algorithms).
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import modelled
from ...predicting.forward import Left, left_over
from ..sign import Case, Context, Sign, sliding_sum, spans

CODE = "WS134"
NEEDS = ("model",)
HELD_S = 0.3
JUMP, JUMP_APART, MISPLACED = 0.3, 0.1, 0.05
SHARE = 0.05
G = 9.81


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each body's worst jump and its longest unexplained force."""
    if len(trajectory.t) < 3:
        return
    _, left = left_over(trajectory)
    dt = np.diff(trajectory.t)[left.row]
    for b, name in enumerate(trajectory.names):
        if not left.judged[:, b].any() or not trajectory.moves_freely[b]:
            continue
        yield from _jumps(trajectory, left, b, name)
        yield from _force(trajectory, left, b, name, dt)


def _jumps(trajectory: Trajectory, left: Left, b: int, name: str) -> Iterator[Sign]:
    size = (
        np.sqrt((left.speed[:, b] ** 2).sum(axis=1))
        + np.sqrt((left.spin[:, b] ** 2).sum(axis=1)) * trajectory.size_m[b]
    )
    limit = trajectory.speed_scale[b] * np.where(left.touching[:, b], JUMP, JUMP_APART)
    # Between rows that lie far apart a force of any kind may act; only what happens at once is a jump.
    share = size / limit
    share = np.maximum(share, left.way[:, b] / (MISPLACED * trajectory.size_m[b]))
    share = np.where(left.judged[:, b], share, 0.0)
    off = np.flatnonzero(share > 1)
    if not len(off):
        return
    for start, stop in _groups(left.row[off])[:3]:
        mine = off[(left.row[off] >= start) & (left.row[off] < stop)]
        k = int(mine[np.argmax(share[mine])])
        message = (
            f"{name} is not where its model takes it from one row to the next: {left.way[k, b]:.3g} m off, "
            f"{size[k]:.3g} m/s of velocity from nowhere"
        )
        certain = not left.touching[k, b] and share[k] > 3 and len(mine) <= 3
        window = (trajectory.t[start], trajectory.t[min(stop, len(trajectory.t) - 1)])
        yield Sign(name, window, float(share[k]), 1.0, "of the limit", "blocking" if certain else "warn", message)


def _groups(rows: np.ndarray) -> list[tuple[int, int]]:
    """(first, last + 1) of groups of rows that lie within five rows of each other, the longest group first."""
    mask = np.zeros(int(rows[-1]) + 1, dtype=bool)
    mask[rows] = True
    found = [(int(a), int(z)) for a, z in spans(mask, bridge=5)]
    return sorted(found, key=lambda pair: pair[0] - pair[1])


def _force(trajectory: Trajectory, left: Left, b: int, name: str, dt: np.ndarray) -> Iterator[Sign]:
    rows = max(2, round(HELD_S / trajectory.interval_s))
    if len(dt) < rows:
        return
    good = left.judged[:, b]
    seconds = sliding_sum(np.where(good, dt, 0.0), rows)
    both = np.concatenate((left.speed[:, b], left.spin[:, b] * trajectory.size_m[b]), axis=1)
    both = np.where(good[:, None], both, 0.0)
    total = sliding_sum(both, rows)
    mean = np.maximum(*(np.sqrt((part**2).sum(axis=1)) for part in (total[:, :3], total[:, 3:])))
    mean = np.where(seconds > 0.5 * HELD_S, mean / np.maximum(seconds, 1e-9), 0.0)
    size = np.sqrt((both[:, :3] ** 2).sum(axis=1)) + np.sqrt((both[:, 3:] ** 2).sum(axis=1))
    # A force lasts: what is left over of a single step is a jump.
    lasting = sliding_sum((size > SHARE * G * np.maximum(dt, 1e-9)).astype(float), rows) > 0.5 * rows
    off = (mean > SHARE * G) & lasting
    found = spans(off, bridge=rows)
    if not len(found):
        return
    start, stop = max(found, key=lambda pair: pair[1] - pair[0])
    peak = float(mean[start:stop].max())
    first, last = int(left.row[start]), int(left.row[min(stop + rows - 2, len(left.row) - 1)]) + 1
    window = (trajectory.t[first], trajectory.t[last])
    message = (
        f"{name} moves as if {peak:.3g} m/s^2 acted on it that its model does not have, "
        f"for {window[1] - window[0]:.2g} s; a program may mean it, or the recording was changed"
    )
    yield Sign(name, window, peak, SHARE * G, "m/s^2", "warn", message)


@cache
def _tumbling() -> Trajectory:
    return modelled.run(modelled.scene(modelled.box("crate", "0 0 1"), modelled.box("other", "1 0 0.1")), 1.0)


def _pushed() -> Case:
    made = _tumbling()
    pos, vel = made.pos.copy(), made.linvel.copy()
    late = np.maximum(made.t - 0.1, 0.0)[:, None]
    pos[:, 1] += np.array([0.5, 0, 0]) * late**2
    vel[:, 1] += np.array([1.0, 0, 0]) * late
    return Case("a box glides off by itself", replace(made, pos=pos, linvel=vel), severity="warn")


def _swapped() -> Case:
    made = _tumbling()
    pos = made.pos.copy()
    pos[20:] = pos[20:, ::-1]
    return Case("two boxes change places", replace(made, pos=pos))


GOOD = (lambda: Case("a box falls beside another", _tumbling()),)
BAD = (_pushed, _swapped)

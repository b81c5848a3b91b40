"""A body buzzes: its velocity turns round from row to row, while it holds its place.

What it means: an actuator whose gains are too high for the time step, two constraints that fight, a damping that the
integrator overshoots. A real vibration has several rows to a swing; this one has as few as the clock allows.

Formula: over 0.3 s, w (or v) changes its sign in six of ten steps or more, its rms exceeds 0.1 sqrt(g / r) (or a twentieth
of sqrt(g r)), and the mean is under a fifth of the rms. With fewer than ten rows in 0.3 s nothing is said.
Threshold: six tenths: the swing of a spring that is recorded at all takes more than three rows. A warning.
Source: Shannon's sampling theorem; the manual on actuator gains against the time step.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, sliding_sum, spans
from ..survey import survey

CODE = "WS140"
NEEDS = ("linvel", "angvel")
HELD_S, LEAST_ROWS, TURNS = 0.3, 10, 0.6
MOST_BITS = 255
"""The largest number that a byte can count to."""


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that buzz."""
    rows = round(HELD_S / trajectory.interval_s) if trajectory.interval_s else 0
    if rows < LEAST_ROWS or len(trajectory.t) <= rows:
        return
    look = survey(trajectory)
    spin_scale = trajectory.speed_scale / trajectory.size_m
    may = (look.spin.max(axis=0) > 0.1 * spin_scale) | (look.speed.max(axis=0) > 0.05 * trajectory.speed_scale)
    least = TURNS * (rows - 1)
    turning, shaking = (_dense(channel, rows - 1) >= least for channel in (trajectory.angvel, trajectory.linvel))
    for b in np.flatnonzero(may & trajectory.moves_freely & (turning | shaking)):
        for often, channel, limit, unit in (
            (turning[b], trajectory.angvel[:, b], 0.1 * spin_scale[b], "rad/s"),
            (shaking[b], trajectory.linvel[:, b], 0.05 * trajectory.speed_scale[b], "m/s"),
        ):
            if not often:
                continue
            axis = int(np.argmax((channel**2).sum(axis=0)))
            signal = channel[:, axis]
            flips = (signal[1:] * signal[:-1] < 0).astype(float)
            if flips.sum() < least:
                continue
            often = sliding_sum(flips, rows - 1) >= least
            level = np.sqrt(sliding_sum(signal**2, rows) / rows)
            loud = often[: len(level)] & (level[: len(often)] > limit)
            if trajectory.touching is not None:  # `contact_chatter` judges bodies in contact
                held = sliding_sum(trajectory.touching[:, b].astype(float), rows) < 0.2 * rows
                loud &= held[: len(loud)]
            loud &= np.abs(sliding_sum(signal, rows) / rows)[: len(loud)] < 0.2 * level[: len(loud)]
            found = spans(loud, bridge=rows)
            if len(found):
                start, stop = max(found, key=lambda pair: pair[1] - pair[0])
                last = min(stop + rows - 1, len(trajectory.t) - 1)
                name, rms = trajectory.names[b], float(level[start:stop].max())
                message = f"{name} buzzes at {rms:.3g} {unit}, to and fro with the rows of the recording"
                severity = "info" if context.acts_on(name, ("control", "force", "torque")) else "warn"
                window = (trajectory.t[start], trajectory.t[last])
                yield Sign(name, window, rms, limit, unit, severity, message)
                break


def _dense(channel: np.ndarray, steps: int) -> np.ndarray:
    """(B,) an upper bound of the sign changes that a component of a channel (T, B, 3) has within so many steps."""
    block = min(steps, MOST_BITS)
    negative = np.signbit(channel)
    changed = (negative[1:] != negative[:-1]).view(np.uint8)
    whole = len(changed) // block * block
    # Bytes are summed as bytes, block by block, which is ten times as fast as summing them as whole numbers.
    blocks = np.add.reduce(changed[:whole].reshape(-1, block, *changed.shape[1:]), axis=1, dtype=np.uint8)
    rest = changed[whole:].sum(axis=0, dtype=int)
    return np.asarray((-(-steps // block) + 1) * np.maximum(blocks.max(axis=0, initial=0), rest).max(axis=1))


def _buzzing(rows_to_a_swing: float) -> Trajectory:
    made = analytic.resting(1.0)
    angle = 2 * np.pi * np.arange(len(made.t)) / rows_to_a_swing + 0.3
    spin = np.zeros_like(made.angvel)
    spin[:, 0, 1] = 5.0 * np.cos(angle)
    bare = replace(made.mechanics, ground_z=None)
    turned = 5.0 * np.sin(angle) * rows_to_a_swing * analytic.DT / (2 * np.pi)
    quat = np.stack((np.cos(turned / 2), 0 * turned, np.sin(turned / 2), 0 * turned), axis=1)
    return replace(made, quat=quat[:, None], angvel=spin, contacts=None, mechanics=bare)


GOOD = (
    lambda: Case("a body at rest", analytic.resting()),
    lambda: Case("a vibration of eight rows to a swing", _buzzing(8.0)),
)
BAD = (lambda: Case("a joint that buzzes at every step", _buzzing(2.05), severity="warn"),)

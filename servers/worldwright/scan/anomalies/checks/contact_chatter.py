"""A body that should rest keeps jittering on its contact and does not calm down.

What it means: a contact too stiff or too elastic for the step, or two constraints that fight. It shows as buzzing in
the pictures and feeds energy into everything stacked above. Bouncing decays, and rolling or sliding goes somewhere.

Formula: over windows of 0.5 s, the body stays within a tenth of r (and turns less than 0.2 rad) while its vertical
velocity (or its angular velocity times r) changes sign more than 10 times with contact in between; u is its rms there.
Chatter when at least 1 s of such windows has u > 0.02 sqrt(g r) and the last third keeps 0.6 of the first third's u.
Likewise six hops on one spot (higher than both ends), none higher than r, whose last third keeps 0.8 of the first
third's height: a warning.
Threshold: 0.02 sqrt(g r) is a hop of r / 5000, about what a picture begins to show; 0.2 sqrt(g r) blocks.
Source: the reference paper's scanner; the manual on contact stiffness against the time step.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, sliding_sum, spans
from ..survey import survey

CODE = "WS106"
SHOWN_AS = "speed"
NEEDS = ("linvel", "touching")
WHOLE = True
WINDOW_S = 0.5
MINIMUM_S = 1.0
REVERSALS = 10
HOPS = 6


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that chatter."""
    rows = round(WINDOW_S / trajectory.interval_s)
    touching = trajectory.touching
    if touching is None or rows < 4 or len(trajectory.t) < 2 * rows:
        return
    look = survey(trajectory)
    loudest = np.maximum(look.speed, trajectory.size_m * look.spin).max(axis=0)
    lively = trajectory.moves_freely & (look.touches > 0).any(axis=0) & (loudest >= 0.02 * trajectory.speed_scale)
    for b in np.flatnonzero(lively):
        size, scale = trajectory.size_m[b], trajectory.speed_scale[b]
        if not _on_the_spot(trajectory, b, rows):
            yield from _hops(trajectory, int(b), touching[:, b])
            continue
        parts = np.concatenate((trajectory.linvel[:, b, 2:], size * trajectory.angvel[:, b]), axis=1)
        if np.abs(parts).max() < 0.02 * scale:
            continue
        loud, rms = _jitter(trajectory, b, parts, touching[:, b], rows)
        for start, stop in spans(loud, bridge=rows // 4):
            stop = min(stop + rows - 1, len(rms) - 1)
            seconds = trajectory.t[stop] - trajectory.t[start]
            if seconds < MINIMUM_S:
                continue
            third = (stop - start) // 3
            first = np.sqrt(np.mean(rms[start : start + third] ** 2))
            last = np.sqrt(np.mean(rms[stop - third : stop] ** 2))
            if last < 0.6 * first or last < 0.02 * scale or _goes_round(trajectory.angvel[start : stop + 1, b]):
                continue
            name = trajectory.names[b]
            part = slice(start, stop + 1)
            others = np.delete(trajectory.speed[part] + trajectory.size_m * trajectory.spin[part], b, axis=1)
            # Others that move as fast may shake a body: its own contact need not be at fault.
            shaken = float(np.mean((others > 0.5 * last).sum(axis=1))) >= 1.0
            driven = context.acts_on(name, ("force", "torque", "control", "mocap"))
            sized = trajectory.mechanics.half_extents is not None  # without a size, both thresholds rest on a guess
            certain = sized and last > 0.2 * scale and not shaken
            severity = "info" if driven else "blocking" if certain else "warn"
            message = f"{name} jitters on its contact at {last:.3g} m/s for {seconds:.2g} s without calming down"
            yield Sign(name, (trajectory.t[start], trajectory.t[stop]), last, 0.02 * scale, "m/s", severity, message)
            break
        else:
            yield from _hops(trajectory, int(b), touching[:, b])


def _goes_round(spin: np.ndarray) -> bool:
    """Whether the axis of a spin goes round steadily: a coin that rolls on its edge, not a body that buzzes."""
    flat = np.sqrt((spin[:, :2] ** 2).sum(axis=1))
    if np.percentile(flat, 10) < 0.3 * np.median(flat) or not flat.max():
        return False
    turn = np.diff(np.unwrap(np.arctan2(spin[:, 1], spin[:, 0])))
    return bool(np.abs(turn.sum()) > 4 * np.pi and (np.sign(turn) == np.sign(turn.sum())).mean() > 0.9)


def _on_the_spot(trajectory: Trajectory, b: int, rows: int) -> bool:
    """Whether any window of `rows` begins and ends, and has its middle, within a tenth of the body's size."""
    pos, windows = trajectory.pos[:, b], len(trajectory.t) - rows + 1
    limit, height = 0.1 * trajectory.size_m[b], pos[:, 2].copy()
    near = np.abs(height[rows - 1 :] - height[:windows]) < limit
    near &= np.abs(height[rows // 2 : rows // 2 + windows] - sliding_sum(height, rows) / rows) < limit
    starts = np.flatnonzero(near)
    return bool((np.abs(pos[starts + rows - 1, :2] - pos[starts, :2]) < limit).all(axis=1).any())


def _hops(trajectory: Trajectory, b: int, touching: np.ndarray) -> Iterator[Sign]:
    """Find small hops on one spot that stay as high; only a warning, since a ball without losses does the same."""
    flights = spans(~touching)
    flights = flights[(flights[:, 0] > 0) & (flights[:, 1] < len(touching))]
    if len(flights) < HOPS:
        return
    # A hop goes up and comes down again: a body that swings down (or is lifted) about its edge, letting go now and then,
    # changes its height between two touches as well.
    height, edges = trajectory.pos[:, b, 2].copy(), flights.ravel()
    ends = np.maximum(height[flights[:, 0] - 1], height[flights[:, 1]])
    rise = np.maximum.reduceat(height, edges)[::2] - ends
    real = rise > 0.01 * trajectory.size_m[b]
    flights, rise = flights[real], rise[real]
    if len(rise) < HOPS or rise.max() > trajectory.size_m[b]:
        return
    third = len(rise) // 3
    drift = float(np.sqrt(((trajectory.pos[flights[-1, 0], b, :2] - trajectory.pos[flights[0, 0], b, :2]) ** 2).sum()))
    if rise[-third:].mean() < 0.8 * rise[:third].mean() or drift > trajectory.size_m[b]:
        return
    name, window = trajectory.names[b], (trajectory.t[flights[0, 0]], trajectory.t[flights[-1, 1]])
    message = f"{name} hops {len(rise)} times on one spot and its hops do not get lower"
    yield Sign(name, window, len(rise), HOPS, "hops", "warn", message)


def _jitter(
    trajectory: Trajectory, b: int, parts: np.ndarray, touching: np.ndarray, rows: int
) -> tuple[np.ndarray, np.ndarray]:
    """(W,) windows that look like chatter, and (T,) the magnitude of the swinging part of the velocity."""
    size = trajectory.size_m[b]
    mean = np.repeat(parts.mean(axis=0, keepdims=True), len(parts), axis=0)
    mean[rows // 2 : rows // 2 + len(parts) - rows + 1] = sliding_sum(parts, rows) / rows
    swing = parts - mean
    magnitude = np.sqrt((swing**2).sum(axis=1))
    # Only reversals between real speeds count: the last digits of a resting body change sign all the time.
    floor = 0.005 * trajectory.speed_scale[b]
    signs = np.where(np.abs(swing) > floor, np.sign(swing), 0.0)
    reversals = np.zeros(len(parts))
    for column in range(signs.shape[1]):
        known = np.flatnonzero(signs[:, column])
        flips = known[1:][np.diff(signs[known, column]) != 0]
        count = np.zeros(len(parts))
        count[flips] = 1
        reversals = np.maximum(reversals, _padded(sliding_sum(count, rows), len(parts)))
    windows = len(parts) - rows + 1
    drift = np.abs(trajectory.pos[rows - 1 :, b] - trajectory.pos[:windows, b]).max(axis=1)
    height = trajectory.pos[:, b, 2]
    half = rows // 2
    wobble = np.abs(height[half : half + windows] - sliding_sum(height, rows) / rows)
    turned = np.abs(sliding_sum(trajectory.angvel[:, b], rows) * trajectory.interval_s).max(axis=1)
    held = sliding_sum(touching.astype(float), rows) > 0.02 * rows
    loud = (
        (reversals[:windows] > REVERSALS)
        & (drift < 0.1 * size)
        & (wobble < 0.1 * size)
        & (turned < 0.2)
        & held
        & (np.sqrt(sliding_sum(magnitude**2, rows) / rows) > 0.02 * trajectory.speed_scale[b])
    )
    return loud, magnitude


def _padded(values: np.ndarray, length: int) -> np.ndarray:
    return np.concatenate((values, np.zeros(length - len(values))))


def _buzzing(decay: float) -> Case:
    still = analytic.resting(3.0)
    pos, speed = still.pos.copy(), still.linvel.copy()
    rate, size = 2 * np.pi * 40, 0.001 * np.exp(-decay * still.t)
    pos[:, 0, 2] += size * np.abs(np.sin(rate * still.t / 2))
    speed[:, 0, 2] = np.gradient(pos[:, 0, 2], still.t)
    return Case("a box buzzing at 40 Hz", replace(still, pos=pos, linvel=speed))


def _swinging_down() -> Case:
    """A plank falls over about one end, which leaves the ground for moments in hops too low to see."""
    t = analytic.clock(2.0)
    fall = np.clip(t - 0.5, 0.0, 1.0)
    height = 0.6 - 0.5 * fall**2
    pos = np.stack([0 * t, 0 * t, height], axis=1)
    speed = np.stack([0 * t, 0 * t, np.where((t > 0.5) & (t < 1.5), -fall, 0.0)], axis=1)
    lets_go = (t > 0.5) & (t < 1.5) & (np.arange(len(t)) % 40 > 4)
    made = analytic.motion(t, pos, speed, size_m=1.2, touches=[(-1, 0, ~lets_go, 1e-5, 9.81)], free=False)
    return Case("a plank that falls over about its end", made)


GOOD = (
    _swinging_down,
    lambda: Case("a body at rest", analytic.resting()),
    lambda: Case("a bouncing ball coming to rest", analytic.bouncing()),
    lambda: Case("a rolling ball", analytic.rolling()),
    lambda: _buzzing(decay=6.0),
)
BAD = (lambda: _buzzing(decay=0.0),)

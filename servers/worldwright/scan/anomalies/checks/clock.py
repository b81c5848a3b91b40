"""The recording's clock stands still or runs backwards.

What it means: rows were lost, doubled or shuffled, or two recordings were joined. Only the rows in order are looked at.

Formula: rows whose time is not larger than that of every row before. A leap: a step three times the usual one, over which
everything that moves went only as far as in one usual step.
Threshold: none; for a leap, within a fifth of the usual way, and a quarter of what the velocity says for the leap.
Source: the interchange's definition, `t` strictly increasing.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign

CODE = "WS132"
NEEDS = ("t",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the rows that were out of order."""
    late = trajectory.out_of_order
    if late:
        message = f"{len(late)} rows are not later than the ones before them and were left out"
        yield Sign("world", (min(late), max(late)), len(late), 0, "rows", "blocking", message)
        name = _torn(trajectory, min(late), max(late))
        if name:
            told = f"the motion of {name} goes on through rows that are out of order"
            yield Sign(name, (min(late), max(late)), len(late), 0, "rows", "warn", told)
    yield from _leaps(trajectory)


def _torn(trajectory: Trajectory, start: float, end: float) -> str:
    """The body that moves fastest around the lost rows; an empty name when nothing moves."""
    near = trajectory.rows(start - 3 * trajectory.interval_s, end + 3 * trajectory.interval_s)
    pace = trajectory.speed[near].max(axis=0) / trajectory.speed_scale
    return trajectory.names[int(np.argmax(pace))] if len(pace) and pace.max() > 0.01 else ""


def _leaps(trajectory: Trajectory) -> Iterator[Sign]:
    """Find steps of the clock that do not show in the motion."""
    dt, usual = np.diff(trajectory.t), trajectory.interval_s
    for n in np.flatnonzero(dt > 3 * usual)[:5]:
        mean = (trajectory.linvel[n] + trajectory.linvel[n + 1]) / 2
        way = np.sqrt(((trajectory.pos[n + 1] - trajectory.pos[n] - mean * usual) ** 2).sum(axis=1))
        pace = np.sqrt((mean**2).sum(axis=1))
        gone = np.sqrt(((trajectory.pos[n + 1] - trajectory.pos[n]) ** 2).sum(axis=1))
        moving = pace > 0.05 * trajectory.speed_scale
        fits = (way < 0.2 * pace * usual) & (gone < 0.25 * pace * dt[n])
        if moving.any() and fits[moving].all():
            fastest = trajectory.names[int(np.argmax(np.where(moving, pace, 0.0)))]
            window = (trajectory.t[n], trajectory.t[n + 1])
            message = f"the clock leaps by {dt[n]:.3g} s, while what moves goes on by one step of {usual:.3g} s"
            for name in ("world", fastest):
                yield Sign(name, window, dt[n], usual, "s", "blocking", message)


def _leaping() -> Case:
    slide = analytic.sliding()
    t = slide.t + np.where(slide.t > slide.t[len(slide.t) // 2], 0.7, 0.0)
    return Case("a clock that leaps", replace(slide, t=t), severity="blocking")


GOOD = (lambda: Case("rows in order", analytic.resting()),)
BAD = (
    lambda: Case("a doubled row", replace(analytic.resting(), out_of_order=(0.5,)), severity="blocking"),
    _leaping,
)

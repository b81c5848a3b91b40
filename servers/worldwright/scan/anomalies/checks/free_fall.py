"""A body falls, but not with the gravity of its world.

What it means: gravity was edited while it ran, a force helps or holds the body, or the recording's clock or scale is
wrong. All loose bodies of a world fall alike.

Formula: over each stretch of flight of at least eight rows and 0.08 s, a is the mean of dv/dt. It counts as a fall when
it is even (each row within a tenth of g of it) and points along gravity (less than a tenth across): f = a·g / g². Judged
where f > 0, or f within 0.05 of -1 (reversed); other upward accelerations are a thruster's, which flight_force names.
Without a model: two even falls of one body that differ; one that is not the earth's is a warning.
Threshold: |f - 1| > 0.05.
Source: Galileo's law of falling bodies.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from .. import flight
from ..sign import Case, Context, Sign, spans
from ..survey import survey

CODE = "WS119"
SHOWN_AS = "height"
NEEDS = ("linvel",)
WHOLE = True
ROWS = 8
SECONDS = 0.08
LONG_ROWS = 12
TOLERANCE = 0.05


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the worst fall of each body."""
    g = float(np.sqrt((trajectory.gravity**2).sum()))
    if g == 0 or len(trajectory.t) <= ROWS:
        return
    known = trajectory.mechanics.unforced is not None and trajectory.mechanics.gravity is not None
    for b, falls in _falls(trajectory, known).items():
        expected = 1.0 if known else falls[0][2]
        wrong = [fall for fall in falls if abs(fall[2] - expected) > TOLERANCE * max(1.0, abs(expected))]
        if not wrong:
            if not known and abs(expected - 1) > TOLERANCE:
                start, stop, share = falls[0]
                message = (
                    f"{trajectory.names[b]} falls with {share * g:.3g} m/s^2, not the {g:.3g} m/s^2 of the earth; "
                    "whether its world has another gravity, only a model beside the recording could tell"
                )
                window = (trajectory.t[start], trajectory.t[stop])
                yield Sign(trajectory.names[b], window, share * g, g * TOLERANCE, "m/s^2", "warn", message)
            continue
        start, stop, share = max(wrong, key=lambda fall: abs(fall[2] - expected))
        name = trajectory.names[b]
        severity = "info" if context.acts_on(name, flight.PUSHES) else "blocking"
        than = f"gravity is {g:.3g}" if known else f"it fell with {falls[0][2] * g:.3g} before"
        message = f"{name} falls with {share * g:.3g} m/s^2 where {than} m/s^2"
        limit = expected * g * TOLERANCE
        yield Sign(name, (trajectory.t[start], trajectory.t[stop]), share * g, limit, "m/s^2", severity, message)


def _falls(trajectory: Trajectory, known: bool) -> dict[int, list[tuple[int, int, float]]]:
    """(first row, last row, share of gravity) of each even fall, by body."""
    if known:
        flying = flight.in_flight(trajectory)
    else:
        touching = trajectory.touching
        if touching is None:
            return {}
        flying = ~(touching[1:] | touching[:-1]) & trajectory.moves_freely
    dt = np.diff(trajectory.t)
    pull = trajectory.gravity
    g2 = float((pull**2).sum())
    found: dict[int, list[tuple[int, int, float]]] = {}
    odd = survey(trajectory).odd_fall.sum(axis=0) >= ROWS
    for b in np.flatnonzero(odd):
        rate = np.diff(trajectory.com_velocity[:, b] if known else trajectory.linvel[:, b], axis=0) / dt[:, None]
        share = rate @ pull / g2
        across = np.sqrt(np.maximum((rate**2).sum(axis=1) / g2 - share**2, 0.0))
        # A change of strength splits a flight: cut it where the share moves by more than the tolerance.
        even = flying[:, b] & (across < 0.1)
        even[1:] &= np.abs(np.diff(share)) < TOLERANCE
        for start, stop in spans(even):
            inner = share[start:stop]
            mean = float(np.median(inner))
            drift = abs(float(inner[-1] - inner[0]))  # a force that grows with depth or speed is no gravity
            short = trajectory.t[stop] - trajectory.t[start] < SECONDS or stop - start < (ROWS if known else LONG_ROWS)
            if short or np.abs(inner - mean).max() > 0.1 or drift > 0.03:
                continue
            right = abs(mean - 1) <= TOLERANCE
            if known and not right and not flight.certain(trajectory, int(b), int(start), int(stop)):
                continue
            if (mean > 0.02 and (known or mean < 3)) or (known and (abs(mean + 1) < TOLERANCE)):
                found.setdefault(int(b), []).append((int(start), int(stop), mean))
    return found


def _slow(share: float) -> Case:
    t = analytic.clock(0.8)
    rate = share * analytic.G
    pos = np.stack([0 * t, 0 * t, 5.0 - rate * t**2 / 2], axis=1)
    vel = np.stack([0 * t, 0 * t, -rate * t], axis=1)
    return Case(f"a fall with {share:g} of gravity", analytic.motion(t, pos, vel), severity="blocking")


def _changed() -> Case:
    t = analytic.clock(0.8)
    rate = np.where(t < 0.4, analytic.G, 2.0)
    vz = -np.concatenate(([0.0], np.cumsum(rate[1:] * np.diff(t))))
    z = 9.0 + np.concatenate(([0.0], np.cumsum((vz[1:] + vz[:-1]) / 2 * np.diff(t))))
    zero = np.zeros_like(t)
    made = analytic.motion(t, np.stack([zero, zero, z], axis=1), np.stack([zero, zero, vz], axis=1))
    bare = replace(made, mechanics=replace(made.mechanics, unforced=None, gravity=None))
    return Case("a fall whose gravity changes, model not known", bare, severity="blocking")


GOOD = (
    lambda: Case("free fall", analytic.falling()),
    lambda: Case("a bouncing ball", analytic.bouncing()),
    lambda: Case("a pendulum", analytic.swinging()),
    lambda: Case("a collision without gravity", analytic.collision()),
)


def _bare(share: float) -> Case:
    made = _slow(share).trajectory
    bare = replace(made, mechanics=replace(made.mechanics, unforced=None, gravity=None))
    return Case(f"a fall with {share:g} of gravity, model not known", bare, severity="warn")


BAD = (lambda: _bare(0.5), lambda: _slow(0.5), lambda: _slow(-1.0), lambda: _slow(1.6), _changed)

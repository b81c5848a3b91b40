"""What motors and brakes of a vehicle exert, and how it steers, against the plan's timed `inputs`, or the path that it `follows`.

What is asked seldom does meanwhile what the inputs said when it was asked: as long as a control stands, at most `SELDOM_S`.
A brake and a drive exert at most their share of their most (a drive gives less at its power's end, a brake at rest); a wheel's
steering angle is the inputs' own. Nor do they less while the wheels turn. A bicycle's rider balances, and a tracked vehicle steers
by its belts: of those the brakes count. What a driver on a path would do is asked of the plan's own (`followed_courses`).
"""

from collections.abc import Iterator
from math import radians

import numpy as np

from worldkit.vehicles.bicycle_numbers import Bicycle
from worldkit.vehicles.wheeled import ackermann

from ...model.plan.committed import Plan
from ...model.plan.vehicle_rows import Vehicle
from ...model.recording.trajectory import Trajectory
from .followed_courses import Known, commands
from .sign import Sign, spans

SHARE, DELAY_S, TURN_RAD, SELDOM_S = 0.05, 0.02, 0.01, 0.1
LEAST, TURNING_RAD_S = 0.8, 5.0
"""The share of what its driver gives that an actuator exerts at least, where its wheels turn as fast as this."""
MOST_ROWS = 2000


def check(trajectory: Trajectory, plan: Plan) -> Iterator[Sign]:
    """Yield each actuator that does more than the plan's driver gives it, or less."""
    ledger = trajectory.interventions
    if ledger is None:
        return
    for name, vehicle in ((one, row.vehicle) for row in plan.assets if row.vehicle for one in row.instances):
        known = vehicle.commands() or commands(vehicle, name, trajectory)
        if not known:
            continue
        sent = {target.rsplit("/", 1)[-1]: rows for (kind, target), rows in ledger.groups.items() if kind == "control"}
        for own in vehicle.made().actuators(name):
            rows = sent.get(own, np.zeros(0, int))
            times_s, value = np.asarray(ledger.time)[rows], np.asarray(ledger.value)[rows]
            part = own.removeprefix(f"{name}_")
            for over, least, unit in _beyond(vehicle, known, part, times_s, value) if len(rows) else ():
                worst = int(np.argmax(over))
                if over[worst] > least:
                    time = float(times_s[worst])
                    message = f"{own} goes {over[worst]:.3g} {unit} beyond what the plan's inputs of {name} give it"
                    yield Sign(own, (time, time), float(over[worst]), least, unit, "blocking", message)
            yield from _lacking(trajectory, (name, vehicle), known, part, times_s, value)


def _beyond(
    vehicle: Vehicle, known: Known, part: str, times_s: np.ndarray, value: np.ndarray
) -> Iterator[tuple[np.ndarray, float, str]]:
    """(N,) how far an actuator goes beyond the inputs, how much of that is free, and the unit."""
    made, asked_s = vehicle.made(), _asked(times_s, value[:, 0])
    if part.startswith("brake_"):
        most = made.brake_n_m
        yield np.abs(value[:, 1]) - most * _within(known, "brake", asked_s, times_s)[1], SHARE * most, "N·m"
    elif part == "drive" and (isinstance(made, Bicycle) or not made.belts):
        low, high = (made.drive_n_m * share for share in _within(known, "throttle", asked_s, times_s))
        yield (
            np.maximum(value[:, 1] - np.maximum(high, 0), np.minimum(low, 0) - value[:, 1]),
            SHARE * made.drive_n_m,
            "N·m",
        )
    elif part.startswith("steer_") and not isinstance(made, Bicycle) and len(made.steered_wheels) == 2:
        side = made.steered_wheels.index(part.removeprefix("steer_"))
        low, high = (
            np.array(
                [ackermann(made, radians(min(max(deg, -made.steering_deg), made.steering_deg)))[side] for deg in ends]
            )
            for ends in _within(known, "steering_deg", asked_s, times_s)
        )
        yield np.maximum(value[:, 0] - high, low - value[:, 0]), TURN_RAD, "rad"


def _lacking(
    trajectory: Trajectory, driven: tuple[str, Vehicle], known: Known, part: str, times_s: np.ndarray, value: np.ndarray
) -> Iterator[Sign]:
    """Find a brake or drive that for longer than anybody waits exerts less than its driver gives, while its wheels turn."""
    name, made = driven[0], driven[1].made()
    brakes = part.startswith("brake_")
    wheels = [part.removeprefix("brake_")] if brakes else [*made.corners]
    turning = [f"{name}_{corner}_wheel" for corner in wheels]
    if not (brakes or (part == "drive" and (isinstance(made, Bicycle) or not made.belts))):
        return
    if not {*turning} <= {*trajectory.names}:
        return
    rows = np.arange(0, len(trajectory.t), max(len(trajectory.t) // MOST_ROWS, 1))
    at = np.asarray(trajectory.t[rows], float)
    spins = trajectory.spin[rows][:, [trajectory.index(one) for one in turning]]
    low, high = _within(known, "brake" if brakes else "throttle", at - SELDOM_S, at)
    given = np.where(low > 0, low, 0.0) if brakes else np.where(low > 0, low, np.where(high < 0, -high, 0.0))
    wanted = LEAST * given * (made.brake_n_m if brakes else made.drive_n_m)
    if not brakes:
        wanted = np.minimum(wanted, LEAST * made.power_w / np.maximum(spins.max(axis=1), 1e-9))
    exerted = np.zeros(len(at))
    if len(times_s):
        near = np.clip(np.searchsorted(times_s, at), 0, len(times_s) - 1)
        there = np.abs(times_s[near] - at) < 0.51 * (trajectory.time_step or trajectory.interval_s)
        exerted = np.abs(value[near, 1]) * there
    short = (exerted < wanted) & (spins.min(axis=1) > TURNING_RAD_S)
    for first, last in spans(short):
        if at[min(last, len(at) - 1)] - at[first] > SELDOM_S + DELAY_S:
            worst = first + int(np.argmax((wanted - exerted)[first:last]))
            message = f"{name}_{part} exerts {exerted[worst]:.3g} N·m; the plan's inputs of {name} give it {wanted[worst] / LEAST:.3g}"
            yield Sign(
                f"{name}_{part}",
                (float(at[first]), float(at[last - 1])),
                float(exerted[worst]),
                float(wanted[worst]),
                "N·m",
                "blocking",
                message,
            )
            return


def _asked(times_s: np.ndarray, control: np.ndarray) -> np.ndarray:
    """(N,) s when each control was asked for, as far as it shows: since then it stands unchanged."""
    begins = np.concatenate([[True], control[1:] != control[:-1]])
    since = times_s[np.maximum.accumulate(np.where(begins, np.arange(len(times_s)), 0))]
    return np.maximum(since, times_s - SELDOM_S)


def _within(known: Known, what: str, asked_s: np.ndarray, times_s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(N,) the least and the most that the inputs give between when each was asked and its time, a little more at either end."""
    t, given = np.array([row[0] for row in known]), np.array([row[1][what] for row in known])
    begin, end = asked_s - DELAY_S, times_s + DELAY_S
    near = np.stack([np.interp(begin + share * (end - begin), t, given) for share in np.linspace(0.0, 1.0, 9)])
    near = np.concatenate([near, np.interp([asked_s, times_s], t, given)])
    return near.min(axis=0), near.max(axis=0)

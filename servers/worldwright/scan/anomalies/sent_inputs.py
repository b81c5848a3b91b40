"""Vehicles whose plan has timed `inputs`: what their motors and brakes exert, and how they steer, against what the inputs allow.

A brake and a drive exert at most their share of their most (a drive gives less at its power's end, a brake at rest); a wheel's
steering angle is the inputs' own. A bicycle's rider balances, and a tracked vehicle steers by its belts: of those the brakes count.
"""

from collections.abc import Iterator
from math import radians

import numpy as np

from worldkit.vehicles.bicycle_numbers import Bicycle
from worldkit.vehicles.wheeled import ackermann

from ...model.plan.committed import Plan
from ...model.plan.vehicle_rows import Vehicle
from ...model.recording.trajectory import Trajectory
from .sign import Sign

SHARE, DELAY_S, TURN_RAD = 0.05, 0.02, 0.01


def check(trajectory: Trajectory, plan: Plan) -> Iterator[Sign]:
    """Yield each actuator that does more than the plan's timed inputs."""
    ledger = trajectory.interventions
    if ledger is None:
        return
    for name, vehicle in ((one, row.vehicle) for row in plan.assets if row.vehicle for one in row.instances):
        if not vehicle.inputs:
            continue
        for (kind, target), rows in ledger.groups.items():
            own = target.rsplit("/", 1)[-1]
            if kind != "control" or not own.startswith(f"{name}_"):
                continue
            times_s, value = np.asarray(ledger.time)[rows], np.asarray(ledger.value)[rows]
            for over, least, unit in _beyond(vehicle, own.removeprefix(f"{name}_"), times_s, value):
                worst = int(np.argmax(over))
                if over[worst] > least:
                    time = float(times_s[worst])
                    message = f"{own} goes {over[worst]:.3g} {unit} beyond what the plan's inputs of {name} give it"
                    yield Sign(own, (time, time), float(over[worst]), least, unit, "blocking", message)


def _beyond(
    vehicle: Vehicle, part: str, times_s: np.ndarray, value: np.ndarray
) -> Iterator[tuple[np.ndarray, float, str]]:
    """(N,) how far an actuator goes beyond the inputs, how much of that is free, and the unit."""
    made = vehicle.made()
    if part.startswith("brake_"):
        most = made.brake_n_m
        yield np.abs(value[:, 1]) - most * _within(vehicle, "brake", times_s)[1], SHARE * most, "N·m"
    elif part == "drive" and (isinstance(made, Bicycle) or not made.belts):
        low, high = (made.drive_n_m * share for share in _within(vehicle, "throttle", times_s))
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
            for ends in _within(vehicle, "steering_deg", times_s)
        )
        yield np.maximum(value[:, 0] - high, low - value[:, 0]), TURN_RAD, "rad"


def _within(vehicle: Vehicle, what: str, times_s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(N,) the least and the most that the inputs give about each time."""
    known = vehicle.commands()
    t, given = np.array([row[0] for row in known]), np.array([row[1][what] for row in known])
    near = np.stack(
        [np.interp(times_s + late, t, given) for late in (-DELAY_S, -DELAY_S / 2, 0.0, DELAY_S / 2, DELAY_S)]
    )
    return near.min(axis=0), near.max(axis=0)

"""A driver whose inputs stand in the plan does no more than those."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from worldwright.model.plan.vehicle_rows import Vehicle
from worldwright.model.recording.records import Interventions
from worldwright.scan.anomalies import sent_inputs
from worldwright.scan.known import analytic

CAR = Vehicle.model_validate(
    {
        "kind": "car",
        "inputs": [{"t": 0, "throttle": 0, "brake": 0.05, "steering_deg": 0}, {"t": 0.3, "brake": 0.5, "over_s": 0.1}],
    }
)
MOST = CAR.made().brake_n_m


@pytest.mark.parametrize(
    ("part", "ctrl", "exerted", "time", "found"),
    [
        ("brake_fl", 0.1, -0.05 * MOST, 0.1, False),
        ("brake_fl", 0.1, -0.5 * MOST, 0.5, False),
        ("brake_fl", 0.1, -1.0 * MOST, 0.1, True),
        ("drive", 0.0, 0.0, 0.1, False),
        ("drive", 900.0, 900.0, 0.1, True),
        ("steer_fl", 0.0, 100.0, 0.1, False),
        ("steer_fl", 0.2, 0.0, 0.1, True),
    ],
)
def test_a_driver_that_does_more_than_the_plans_inputs_is_found(part, ctrl, exerted, time, found):
    plan = SimpleNamespace(assets=(SimpleNamespace(vehicle=CAR, instances=("car",)),))
    value = np.zeros((1, 6))
    value[0, :2] = ctrl, exerted
    sent = Interventions(np.array([time]), ["control"], [f"car/car_{part}"], value, np.zeros(1))
    signs = list(sent_inputs.check(replace(analytic.resting(), interventions=sent), plan))
    assert bool(signs) == found
    assert all(sign.severity == "blocking" for sign in signs)


def test_a_bicycles_rider_balances_and_his_brakes_count():
    inputs = [{"t": 0, "throttle": 0.2}]
    row = SimpleNamespace(vehicle=Vehicle.model_validate({"kind": "bicycle", "inputs": inputs}), instances=("bike",))
    value = np.zeros((3, 6))
    value[:, 1] = 50.0, 50.0, 1e-3
    targets = ["bike/bike_steer_f", "bike/bike_brake_f", "bike/bike_drive"]
    sent = Interventions(np.full(3, 0.1), ["control"] * 3, targets, value, np.zeros(3))
    signs = sent_inputs.check(replace(analytic.resting(), interventions=sent), SimpleNamespace(assets=(row,)))
    assert [sign.body for sign in signs] == ["bike_brake_f"]


def test_a_driver_who_is_asked_seldom_does_meanwhile_what_the_inputs_said_then():
    back = Vehicle.model_validate({"kind": "car", "inputs": [{"t": 0, "brake": 0.5}, {"t": 0.05, "brake": 0.0}]})
    times = np.arange(0, 0.2, 0.002)
    plan = SimpleNamespace(assets=(SimpleNamespace(vehicle=back, instances=("car",)),))
    for until, found in ((0.08, False), (0.2, True)):  # asked at 0 s only; so seldom is nobody asked
        mine = times[times < until]
        value = np.zeros((len(mine), 6))
        value[:, 0], value[:, 1] = 0.01, 0.5 * back.made().brake_n_m
        sent = Interventions(
            mine, ["control"] * len(mine), ["car/car_brake_fl"] * len(mine), value, np.zeros(len(mine))
        )
        signs = list(sent_inputs.check(replace(analytic.resting(), interventions=sent), plan))
        assert bool(signs) == found

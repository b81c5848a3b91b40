"""A driver on a path is held to what the plan's own driver does in the recorded states, no more and no less."""

from dataclasses import replace
from functools import cache
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from worldkit import contacts, scene, vehicles
from worldwright.model.plan.vehicle_rows import Vehicle
from worldwright.model.recording.records import Interventions
from worldwright.scan.anomalies import sent_inputs
from worldwright.scan.known import analytic

WAY = {"path": ((0, 0), (8, 0), (16, 4), (20, 12)), "speed_m_s": 5.0}
ROW = Vehicle.model_validate({"kind": "car", "follows": WAY})
CAR = ROW.made()
EVERY = 5


def honest(told: vehicles.Commands, time: float) -> vehicles.Commands:
    return told


def flooring(told: vehicles.Commands, time: float) -> vehicles.Commands:
    return replace(told, throttle=1.0, brake=0.0) if time > 2 else told


def braking(told: vehicles.Commands, time: float) -> vehicles.Commands:
    return replace(told, throttle=0.0, brake=0.6) if 1.5 < time < 1.7 else told


def straying(told: vehicles.Commands, time: float) -> vehicles.Commands:
    return replace(told, steering_deg=told.steering_deg + 6.0) if time > 1 else told


def idling(told: vehicles.Commands, time: float) -> vehicles.Commands:
    return replace(told, throttle=0.0) if 1.0 < time < 1.5 else told


@cache
def driven(deed) -> tuple:
    """A recording of three seconds of a car whose driver does a deed, and a plan that knows nothing of that."""
    spec = scene.new("road", time_step=0.002, floor_surface=contacts.surface(friction=0.9))
    vehicles.add(spec, CAR, name="car", pos=(CAR.wheelbase_m / 2, 0, 0), look=None)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    driver = vehicles.Driver(CAR, vehicles.Course(WAY["path"]), top_m_s=WAY["speed_m_s"])
    names = ["car", *(f"car_{corner}_wheel" for corner in CAR.corners)]
    controls, rows, sent = list(CAR.actuators("car")), [], []
    while data.time < 3:
        told = deed(driver.commands(data, "car"), float(data.time))
        vehicles.pedals(CAR, model, data, "car", **vars(told))
        spins = [(0.0, float(data.joint(f"car_{corner}_axle").qvel[0]), 0.0) for corner in CAR.corners]
        rows.append((data.time, data.qpos[:7].copy(), data.qvel[:3].copy(), [(0.0, 0.0, 0.0), *spins]))
        at = data.time
        mujoco.mj_step(model, data, nstep=EVERY)
        for name in controls:
            value = (data.actuator(name).ctrl[0], data.actuator(name).force[0], 0, 0, 0, 0)
            if value[0]:
                sent.append((at, f"car/{name}", value))
    t, pose, linvel, spin = (np.array([row[n] for row in rows]) for n in range(4))
    some = np.repeat(pose[:, None, :3], len(names), axis=1)
    quat = np.repeat(pose[:, None, 3:], len(names), axis=1)
    moved = analytic.motion(
        t, some, np.repeat(linvel[:, None], len(names), axis=1), names=names, quat=quat, angvel=spin
    )
    when, targets, values = zip(*sent, strict=True)
    ledger = Interventions(
        np.array(when), ["control"] * len(sent), list(targets), np.array(values), np.zeros(len(sent))
    )
    plan = SimpleNamespace(assets=(SimpleNamespace(vehicle=ROW, instances=("car",)),))
    return replace(moved, interventions=ledger), plan


@pytest.mark.parametrize(
    ("deed", "part"), [(honest, ""), (flooring, "drive"), (braking, "brake"), (straying, "steer"), (idling, "drive")]
)
def test_what_a_driver_does_is_asked_of_the_plans_own(deed, part):
    signs = list(sent_inputs.check(*driven(deed)))
    assert bool(signs) == bool(part), [sign.message for sign in signs]
    assert all(sign.severity == "blocking" for sign in signs)
    assert not part or any(f"car_{part}" in sign.body for sign in signs)

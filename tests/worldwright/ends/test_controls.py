"""The bounds of an action: who says so, and what was recorded is always allowed."""

from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from worldwright.ends.controls import control_inputs

PLAN = SimpleNamespace(topology=SimpleNamespace(actuators=()), simulation_parameters=SimpleNamespace(constants={}))


def bounds(recorded, ctrlrange=None):
    """Of a position servo on a hinge of -0.5 to 0.5 rad."""
    spec = mujoco.MjSpec()
    arm = spec.worldbody.add_body(name="arm")
    arm.add_joint(name="way", range=(-np.degrees(0.5), np.degrees(0.5)), limited=mujoco.mjtLimited.mjLIMITED_TRUE)
    arm.add_geom(size=(0.1, 0, 0))
    servo = spec.add_actuator(name="servo", target="way", trntype=mujoco.mjtTrn.mjTRN_JOINT)
    servo.set_to_position(kp=10)
    if ctrlrange:
        servo.ctrllimited, servo.ctrlrange = mujoco.mjtLimited.mjLIMITED_TRUE, ctrlrange
    (row,) = control_inputs(spec.compile(), PLAN, (0,), np.array([recorded]).T)
    return row.low, row.high, row.bounded_by


def test_a_servo_may_be_sent_where_the_recording_sent_it():
    assert bounds([0.0, 0.4]) == (pytest.approx(-0.5), pytest.approx(0.5), "the joint's range")
    assert bounds([0.0, 0.8]) == (pytest.approx(-0.5), 0.8, "the joint's range, and the recording")
    assert bounds([-0.7, 0.2]) == (-0.7, pytest.approx(0.5), "the joint's range, and the recording")


def test_what_the_model_clamps_stays_clamped():
    assert bounds([-0.7, 0.8], (-0.2, 0.2)) == (-0.2, 0.2, "the model's ctrlrange")

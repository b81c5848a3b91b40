"""The recording tells what equalities and tendons carry."""

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, record


def hung(stiffness=0.0, slack=False):
    """A ball of 2 kg on a rope or a spring."""
    spec = empty()
    body = ball(spec, "ball", (0, 0, 1), mass=2.0)
    body.add_site(name="eye")
    spec.worldbody.add_site(name="hook", pos=(0, 0, 2))
    rope = spec.add_tendon(name="rope")
    if stiffness:
        rope.stiffness[0], rope.damping[0] = stiffness, 20.0
        rope.springlength = (1.0, 1.0)
    else:
        rope.range, rope.limited = (0, 5.0 if slack else 1.0), True
    rope.wrap_site("hook")
    rope.wrap_site("eye")
    return spec


@pytest.mark.parametrize("stiffness", [0.0, 500.0])
def test_a_taut_tendon_carries_the_weight(stiffness, tmp_path):
    recording = record(hung(stiffness), tmp_path / "t", 4000)
    assert recording.tendon_force[-1, 0] == pytest.approx(2 * 9.81, rel=0.01)
    assert recording.tendon_length[-1, 0] == pytest.approx(1 + (2 * 9.81 / 500 if stiffness else 0), abs=0.01)


def test_a_slack_tendon_carries_nothing(tmp_path):
    recording = record(hung(slack=True), tmp_path / "t", 200)
    np.testing.assert_array_equal(recording.tendon_force, 0)


def test_an_equality_carries_the_weight_until_it_is_switched_off(tmp_path):
    spec = empty()
    ball(spec, "ball", (0, 0, 1), mass=2.0)
    hold = spec.add_equality(name="hold", type=mujoco.mjtEq.mjEQ_CONNECT, name1="ball")
    hold.objtype, hold.data[:3] = mujoco.mjtObj.mjOBJ_BODY, 0  # held at its centre

    def let_go(model, data):
        data.eq_active[0] = data.time < 2.9995

    recording = record(spec, tmp_path / "t", 3500, let_go)
    assert recording.eq_force[2990, 0] == pytest.approx(2 * 9.81, rel=0.01)
    assert recording.eq_force[3005, 0] == 0
    assert record(empty_world(), tmp_path / "none", 5).eq_force.shape == (6, 0)


def empty_world():
    spec = empty()
    ball(spec, "ball", (0, 0, 1))
    return spec


def test_a_weld_tells_its_force_from_its_torque(tmp_path):
    """An arm of 2 kg whose mass sits 0.5 m beside the weld: 19.62 N and 9.81 N m; the connection before it turns nothing."""
    spec = empty()
    other = ball(spec, "other", (3, 0, 1))
    held = spec.add_equality(name="pin", type=mujoco.mjtEq.mjEQ_CONNECT, name1="other")
    held.objtype, held.data[:3] = mujoco.mjtObj.mjOBJ_BODY, 0
    assert other.name == "other"
    arm = spec.worldbody.add_body(name="arm")
    arm.add_freejoint()
    arm.add_geom(size=(0.05, 0, 0), pos=(0.5, 0, 0), mass=2.0)
    weld = spec.add_equality(name="weld", type=mujoco.mjtEq.mjEQ_WELD, name1="arm", name2="world")
    weld.objtype = mujoco.mjtObj.mjOBJ_BODY
    weld.data[:] = (
        0,
        0,
        0,
        0,
        0,
        0,
        1,
        0,
        0,
        0,
        3,
        0,
    )  # anchor, place, quaternion, and a torque scale that must not show
    recording = record(spec, tmp_path / "t", 2000)
    assert recording.eq_force[-1] == pytest.approx((9.81, 2 * 9.81), rel=0.02)
    assert recording.eq_torque[-1] == pytest.approx((0, 9.81), rel=0.02)

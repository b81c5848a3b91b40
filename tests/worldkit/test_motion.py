import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, record
from worldkit import motion
from worldkit.motion import Launch


def test_a_launched_body_starts_with_world_frame_velocities(tmp_path):
    spec = empty(gravity=0.0)
    body = ball(spec, "ball", (0, 0, 1))
    body.quat = (np.cos(0.6), np.sin(0.6), 0, 0)  # turned, so that body frame and world frame differ
    motion.launch(spec, {"ball": Launch(linear=(1, 2, 3), angular=(0, 5, 0))})
    recording = record(spec, tmp_path / "t", 5)
    assert recording.linvel[0, 0] == pytest.approx((1, 2, 3))
    assert recording.angvel[0, 0] == pytest.approx((0, 5, 0))


def test_joints_take_position_and_velocity():
    spec = empty()
    body = spec.worldbody.add_body(name="door")
    body.add_joint(name="hinge", type=mujoco.mjtJoint.mjJNT_HINGE, axis=(0, 0, 1))
    body.add_geom(size=(0.1, 0, 0))
    other = spec.worldbody.add_body(name="drawer", pos=(1, 0, 0))
    other.add_joint(name="slide", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(1, 0, 0))
    other.add_geom(size=(0.1, 0, 0))
    motion.launch(spec, {"hinge": Launch(position=0.5, velocity=-1.0), "drawer": Launch(position=0.2)})
    model = spec.compile()
    assert model.key("start").qpos == pytest.approx((0.5, 0.2))
    assert model.key("start").qvel == pytest.approx((-1.0, 0.0))


def test_a_mocap_body_keeps_its_place():
    spec = empty()
    spec.worldbody.add_body(name="hand", mocap=True, pos=(1, 2, 3)).add_geom(size=(0.1, 0, 0))
    ball(spec, "ball", (0, 0, 1))
    motion.launch(spec, {})
    assert spec.compile().key("start").mpos.ravel() == pytest.approx((1, 2, 3))


@pytest.mark.parametrize(
    ("name", "launch", "message"),
    [
        ("bell", Launch(), "no body or joint 'bell'; bodies: ball"),
        ("post", Launch(), "part of the scenery"),
        ("ball", Launch(position=1.0), "free joint: give linear and angular"),
        ("ball", Launch(linear=(float("inf"), 0, 0)), "must be finite"),
    ],
)
def test_motions_that_cannot_be_are_refused(name, launch, message):
    spec = empty()
    ball(spec, "ball", (0, 0, 1))
    spec.worldbody.add_body(name="post").add_geom(size=(0.1, 0, 0))
    with pytest.raises(ValueError, match=message):
        motion.launch(spec, {name: launch})


def test_a_second_launch_is_refused():
    spec = empty()
    ball(spec, "ball", (0, 0, 1))
    motion.launch(spec, {})
    with pytest.raises(ValueError, match="one call"):
        motion.launch(spec, {})

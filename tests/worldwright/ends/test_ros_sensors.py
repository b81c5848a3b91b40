"""Instruments of a live world against what is known of it: a wall's distance, free fall, rest, a spin."""

from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from small_worlds import empty, floor
from worldengine.clock.state_frames import signature
from worldwright.ends.live_row import LiveRow
from worldwright.ends.ros_sensors import FARTHEST_M, OVER_M, Imu, Lidar

HALF = (0.4, 0.2, 0.1)


class Box:
    """A box over a floor, with a wall before it and a pole to its left."""

    def __init__(self):
        spec = empty()
        floor(spec)
        box = spec.worldbody.add_body(name="box", pos=(0, 0, 1))
        box.add_freejoint()
        box.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=HALF)
        spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 5, 5), pos=(3.1, 0, 0))
        spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=(0.5, 5, 0), pos=(0, 2, 0))
        model = spec.compile()
        self.row = LiveRow(SimpleNamespace(model=model, given=SimpleNamespace(visual_only=())))
        self.model, self.data = model, mujoco.MjData(model)

    def stand(self, time, velocity=(0, 0, 0, 0, 0, 0), quat=(1, 0, 0, 0)):
        self.data.time, self.data.qvel[:], self.data.qpos[3:7] = time, velocity, quat
        state = np.zeros(mujoco.mj_stateSize(self.model, signature()))
        mujoco.mj_getState(self.model, self.data, state, signature())
        self.row.stand(state)


@pytest.fixture
def box():
    return Box()


def test_a_row_has_the_velocities_that_the_engine_has(box):
    box.stand(1.5, (1, 2, 3, 0.4, 0.5, 0.6), (np.cos(0.3), 0, np.sin(0.3), 0))
    mujoco.mj_forward(box.model, box.data)
    assert box.row.time[0] == 1.5 and tuple(box.row.pos[0, 0]) == (0, 0, 1)
    assert box.row.linvel[0, 0] == pytest.approx([1, 2, 3])
    assert box.row.angvel[0, 0] == pytest.approx(box.data.xmat[1].reshape(3, 3) @ (0.4, 0.5, 0.6))


def test_a_ring_sees_what_stands_about_it_and_not_its_own_body(box):
    lidar = Lidar(box.row, "box")
    assert lidar.mount()["transform"]["translation"]["z"] == pytest.approx(HALF[2] + OVER_M)
    told = lidar.told()
    at = {round(np.degrees(angle)): distance for angle, distance in zip(lidar.angles, told["ranges"], strict=True)}
    assert at[0] == pytest.approx(3.0) and at[45] == pytest.approx(3.0 / np.cos(np.pi / 4))
    assert at[90] == pytest.approx(1.5) and np.isinf(at[-180]) and np.isinf(at[-90])
    assert told["angle_min"] + 90 * told["angle_increment"] == pytest.approx(-np.pi / 2)
    assert len(told["ranges"]) == 360 and told["range_max"] == FARTHEST_M and told["header"]["frame_id"] == "box/lidar"
    box.stand(
        0.0, quat=(np.cos(np.pi / 4), 0, 0, np.sin(np.pi / 4))
    )  # turned left: the pole is ahead, the wall to the right
    turned = dict(zip(np.round(np.degrees(lidar.angles)), lidar.told()["ranges"], strict=True))
    assert turned[0] == pytest.approx(1.5) and turned[-90] == pytest.approx(3.0)


def test_an_inertial_unit_weighs_nothing_in_free_fall_and_its_weight_at_rest(box):
    imu = Imu(box.row, "box")
    assert imu.told()["linear_acceleration_covariance"][0] == -1.0, "nothing is known of the first instant"
    turned = (np.cos(np.pi / 4), 0, np.sin(np.pi / 4), 0)  # nose down: the body's x is down
    box.stand(0.1, (0, 0, -0.981, 0, 0.2, 0), turned)
    told = imu.told()
    assert list(told["linear_acceleration"].values()) == pytest.approx([0, 0, 0], abs=1e-9)
    assert told["angular_velocity"]["y"] == pytest.approx(0.2) and told["orientation"]["y"] == pytest.approx(
        np.sin(np.pi / 4)
    )
    box.stand(0.2, (0, 0, -0.981, 0, 0, 0), turned)
    told = imu.told()
    assert list(told["linear_acceleration"].values()) == pytest.approx([-9.81, 0, 0], abs=1e-9)
    assert told["linear_acceleration_covariance"][0] == 0.0
    assert imu.told()["linear_acceleration_covariance"][0] == -1.0, "no time has passed"

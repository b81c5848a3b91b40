"""Walkers are shown what their policy was trained with, all in one call a tick, and their servos hold its answer."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

import packaged_dogs
from worldkit import contacts, model_files, models, scene
from worldkit.beside_program import below
from worldkit.robots import GAITS, Walkers, along, packaged, policy_observations
from worldkit.robots.policies import opened

GAIT = GAITS[packaged_dogs.KEY]
SHARED = next(
    (
        path
        for place in Path(__file__).parents
        if (path := place / "shared/data/policies/playground/t1_policy.onnx").is_file()
    ),
    Path("t1_policy.onnx"),
)


@pytest.fixture
def two():
    """Two dogs that hang still, the second turned by 90 degrees, both with the gait's servos."""
    world = mujoco.MjSpec()
    for number in (1, 2):
        dog = mujoco.MjSpec.from_string(packaged_dogs.BARE)
        for joint in GAIT.joints:
            made = dog.add_actuator(name=GAIT.servo(joint), target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
            made.set_to_position(kp=35, kv=0.5)
        world.attach(dog, prefix=f"dog_{number}_", frame=world.worldbody.add_frame(pos=(0, number, 1)))
    model = world.compile()
    data = mujoco.MjData(model)
    turned = model.joint(model.body("dog_2_trunk").jntadr[0]).qposadr[0]
    data.qpos[turned + 3 : turned + 7] = (np.sqrt(0.5), 0, 0, np.sqrt(0.5))
    mujoco.mj_forward(model, data)
    return model, data


class Heard:
    """A policy that keeps what it is shown."""

    name, observation, action = "heard", GAIT.observation, len(GAIT.joints)

    def __init__(self):
        self.shown = []

    def __call__(self, rows):
        self.shown.append(rows)
        return np.full((len(rows), self.action), 0.2 * len(self.shown))


def test_one_call_a_tick_sets_all_servos(two):
    model, data = two
    heard = Heard()
    walkers = Walkers(("dog_1", "dog_2"), GAIT, heard)
    for step in range(25):
        data.time = 0.002 * step
        walkers(model, data, [(0.5, 0, 0), (0, 0, 0.1)])
    assert [rows.shape for rows in heard.shown] == [(2, 48)] * 3  # at 0, 20 and 40 ms
    assert np.allclose(data.ctrl.reshape(2, 12), np.asarray(GAIT.home) + 0.5 * 0.6)
    assert np.allclose(heard.shown[1][:, 33:45], 0.2)  # the action before
    assert np.allclose(heard.shown[0][:, 9:21], -np.asarray(GAIT.home)) and np.allclose(
        heard.shown[0][0, 45:], (0.5, 0, 0)
    )
    data.time = 0.0
    walkers(model, data, [(0, 0, 0)] * 2)
    assert len(heard.shown) == 4 and np.allclose(heard.shown[3][:, 33:45], 0)  # a repetition starts anew


def test_a_start_later_and_a_leap_in_time_leave_one_call_a_tick(two):
    model, data = two
    heard = Heard()
    walkers = Walkers(("dog_1",), GAIT, heard)
    for first, calls in ((3.0, 3), (5.0, 6)):
        for step in range(25):
            data.time = first + 0.002 * step
            walkers(model, data, [(0.5, 0, 0)])
        assert len(heard.shown) == calls  # at 0, 20 and 40 ms from there


def test_what_is_felt_is_in_the_sensors_frame(two):
    model, data = two
    start = model.body("dog_2_trunk").dofadr[0]
    data.qvel[start : start + 6] = (0, 2, 0, 0, 0, 3)  # along world Y, which is its own X; and turning
    mujoco.mj_forward(model, data)
    felt = policy_observations.felt(model, data, "dog_2_imu")
    assert np.allclose(felt, (2, 0.3, 0, 0, 0, 3, 0, 0, -1))  # 3 rad/s at 0.1 m from its middle


def test_each_layout_has_the_width_of_its_policy():
    felt, command = np.arange(9.0), np.array([0.1, 0.2, 0.3])
    joints = {n: np.full(n, 0.5) for n in (12, 23, 29)}
    own = {n: (felt, row, 2 * row, 3 * row) for n, row in joints.items()}
    assert len(policy_observations.four_legs(*own[12], command)) == 48
    scaled = policy_observations.scaled_four_legs(*own[12], command)
    assert len(scaled) == 45 and scaled[0] == 0.25 * 3 and scaled[21] == 0.05
    for count, width in ((23, 85), (29, 103)):
        row = policy_observations.two_legs(*own[count], command, policy_observations.stride(0.0))
        assert len(row) == width and np.allclose(row[-4:], (1, -1, 0, 0), atol=1e-12)
    assert (
        np.allclose(policy_observations.stride(1 / 3), (-np.pi, 0))
        and (policy_observations.stride(1, standing=True) == np.pi).all()
    )


def test_one_on_two_legs_is_shown_its_stride_and_no_head():
    gait, heard = GAITS["t1"], Heard()
    heard.observation, heard.action = gait.observation, len(gait.joints)
    joints = "".join(
        f'<body><joint name="t1_{joint}" axis="0 0 1"/><geom size="0.01"/></body>' for joint in gait.joints
    )  # each of its own
    servos = "".join(f'<position name="t1_{gait.servo(joint)}" joint="t1_{joint}"/>' for joint in gait.joints)
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><worldbody><body><freejoint/><geom size="0.1"/><site name="t1_torso"/></body>{joints}</worldbody>'
        f"<actuator>{servos}</actuator></mujoco>"
    )
    data = mujoco.MjData(model)
    data.qpos[7:] = np.asarray(gait.home) + 0.1
    walkers = Walkers(("t1",), gait, heard)
    for time, command in ((0.0, (0.8, 0, 0)), (0.02, (0.0, 0, 0))):
        data.time = time
        mujoco.mj_forward(model, data)
        walkers(model, data, [command])
    first, second = (rows[0] for rows in heard.shown)
    assert np.allclose(first[12:35], [0, 0] + [0.1] * 21) and np.allclose(first[9:12], (0.8, 0, 0))
    assert np.allclose(first[81:], (1, -1, 0, 0)) and np.allclose(second[81:], (-1, -1, 0, 0))  # it stands
    assert np.allclose(data.ctrl, np.asarray(gait.home) + 0.4)


def test_along_steers_back_to_its_line(two):
    _, data = two
    assert along(data, "dog_1_trunk", speed=0.8, y=1.0) == (0.8, 0.0, 0.0)
    assert along(data, "dog_1_trunk", speed=0.8, y=0.0)[2] < 0 < along(data, "dog_1_trunk", speed=0.8, y=2.0)[2]
    assert along(data, "dog_2_trunk", speed=0.8, y=2.0)[2] == -0.5  # across its line: as fast as it may
    assert along(data, "dog_2_trunk", speed=0.0) == (0.0, 0.0, 0.0)


def test_without_a_line_each_keeps_to_that_through_its_start(two):
    model, data = two
    assert along(data, "dog_1_trunk", speed=0.8) == (0.8, 0.0, 0.0)  # started at y = 1
    ahead = along(data, "dog_2_trunk", speed=0.8, heading=np.pi / 2)
    assert ahead == pytest.approx((0.8, 0.0, 0.0))  # faces +Y, at y = 2
    start = model.joint(model.body("dog_2_trunk").jntadr[0]).qposadr[0]
    data.qpos[start : start + 2] += (0.2, 5.0)
    mujoco.mj_kinematics(model, data)
    assert along(data, "dog_2_trunk", speed=0.8, heading=np.pi / 2)[2] == pytest.approx(1.5 * 0.2)  # back to the left


def test_a_policy_of_another_gait_is_refused(tmp_path):
    path = packaged_dogs.policy(tmp_path / "w.onnx", 45, 12)
    with pytest.raises(ValueError, match="takes 45"):
        Walkers(("dog",), GAIT, opened(path, observation=45, action=12))


REAL = [
    pytest.param(key, path, id=key)
    for key, path in (("t1", SHARED), ("go2", None))
    if key in packaged.found() and (path is None or path.is_file())
]
"""Robots of wheels, with published policies, where this machine has them."""
if REAL:

    @pytest.mark.parametrize(("key", "policy"), REAL)
    def test_a_packaged_robot_walks_five_metres_and_stands(tmp_path, key, policy):
        made = model_files.whole(packaged.lay(key, tmp_path / key), tmp_path)
        gait, spec = GAITS[key], scene.new("pitch", time_step=0.002)
        grip = contacts.surface(friction=0.8, time_constant=0.008)
        half = packaged.ROBOTS[key].extents[2] / 2
        with below(tmp_path):
            models.attach(spec, made.text, name=key, pos=(0, 0, half), files=made.files, surface=grip)
        model = spec.compile()
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        walk = opened(policy or tmp_path / key / "walk.onnx", observation=gait.observation, action=len(gait.joints))
        walkers, height = Walkers((key,), gait, walk), data.body(key).xpos[2]
        while data.time < 9:
            walkers(model, data, [along(data, key, speed=0.8 if data.body(key).xpos[0] < 5 else 0.0)])
            mujoco.mj_step(model, data)
        x, y, z = data.body(key).xpos
        assert 5 < x < 6 and abs(y) < 0.2 and z > 0.8 * height and data.body(key).xmat[8] > 0.95

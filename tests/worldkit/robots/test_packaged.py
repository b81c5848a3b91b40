"""A robot of an installed wheel is found, and laid out in its home pose with its servos and its licence, whole or not at all."""

import json

import mujoco
import numpy as np
import pytest

import packaged_dogs
import packaged_machines
from worldkit import model_files, models
from worldkit.beside_program import below
from worldkit.errors import IntakeError
from worldkit.robots import ARMS, DRONES, GAITS, packaged


def test_a_robot_stands_in_its_home_pose_with_its_servos(tmp_path, monkeypatch):
    robot = packaged_dogs.install(tmp_path / "site", monkeypatch)
    assert packaged.found()[robot.key][0] is robot and packaged.licence(robot) == "MIT"
    model_file = packaged.lay(robot.key, tmp_path / "run/dog")
    origin = json.loads((tmp_path / "run/dog/origin.json").read_text())
    assert (origin["licence"], origin["creator"], origin["version"]) == ("MIT", "a breeder", "2.0")
    assert (tmp_path / "run/dog/LICENSE").is_file() and (tmp_path / "run/dog/assets/shin.obj").is_file()
    made = model_files.whole(model_file, tmp_path / "run")
    with below(tmp_path / "run"):
        model = models.parsed(made.text, "dog", files=made.files).compile()
    gait = GAITS[robot.key]
    assert [model.actuator(a).name for a in range(model.nu)] == [gait.servo(joint) for joint in gait.joints]
    assert np.allclose(model.geom("FR_foot").solimp[:2], (0.9, 0.95))  # no foot sinks in by its radius
    data = mujoco.MjData(model)
    assert np.allclose(data.qpos[7:], gait.home, atol=1e-6)  # the joints count from where they are
    mujoco.mj_kinematics(model, data)
    thigh, calf = 0.9, 0.9 - 1.8
    reach = 0.2 * (np.cos(thigh) + np.cos(calf))  # both links, leaning forward and back
    low = 0.4 - 0.1 * np.sin(0.1) - reach * np.cos(0.1)  # each leg is turned in by 0.1 rad at its hip, 0.1 m aside
    assert [data.geom(f"{leg}_foot").xpos[2] for leg in ("FR", "FL", "RR", "RL")] == pytest.approx([low] * 4, abs=1e-6)
    data.qpos[7:] = 0
    mujoco.mj_kinematics(model, data)
    assert data.geom("FR_foot").xpos[2] == pytest.approx(
        0.4 - 0.4, abs=1e-6
    )  # straight legs at angle 0, as in the wheel


@pytest.mark.parametrize(("key", "model"), [("yam", packaged_machines.ARM), ("cf21b", packaged_machines.DRONE)])
def test_an_arm_and_a_drone_get_what_drives_them(tmp_path, monkeypatch, key, model):
    packaged_dogs.install(tmp_path / "site", monkeypatch, key, model)
    made = mujoco.MjModel.from_xml_path(str(packaged.lay(key, tmp_path / "run/it")))
    driven = [made.actuator(number) for number in range(made.nu)]
    if key == "yam":
        arm = ARMS[key]
        assert [one.name for one in driven] == [arm.motor(joint) for joint in arm.driven]
        assert [made.joint(one.trnid[0]).name for one in driven] == list(arm.driven)
        assert [one.forcerange[1] for one in driven] == [28, 28, 28, 10, 10, 10, 20]
        assert made.joint("joint6").armature[0] == 0.0018 and made.joint("left_finger").armature[0] == 2.6
    else:
        drone = DRONES[key]
        assert [one.name for one in driven] == [rotor.name for rotor in drone.rotors]
        assert all(tuple(one.ctrlrange) == (0, 0.2) for one in driven)
        assert np.allclose([one.gear[[2, 5]] for one in driven], [(1, rotor.spin * 0.00594) for rotor in drone.rotors])
        assert (
            made.ngeom == 1
            and made.geom("col_box").contype[0] == 1
            and made.body_subtreemass[0] == pytest.approx(0.0434)
        )


def test_what_is_not_there_or_not_whole_leaves_nothing(tmp_path, monkeypatch):
    robot = packaged_dogs.install(tmp_path / "site", monkeypatch)
    (tmp_path / "site/dogs/assets/shin.obj").unlink()
    for folder, key, code in (
        ("a", robot.key, "truncated"),
        ("b", "unicorn", "not_found"),
        ("site", robot.key, "taken"),
    ):
        with pytest.raises(IntakeError) as told:
            packaged.lay(key, tmp_path / folder)
        assert told.value.code == code and told.value.next_move
    assert [path.name for path in tmp_path.iterdir()] == ["site"]

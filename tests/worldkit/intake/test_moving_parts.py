"""A leaf that a file has apart turns on its pin or slides on its rail, and the thing as a whole stays what it was."""

from pathlib import Path

import mujoco
import numpy as np
import pytest
import trimesh

from worldkit.intake import group_names, taken_in

OAK = {"name": "oak", "density": 690.0, "friction": 0.4, "restitution": 0.4, "source": "a table"}
ASKED = {
    "key": "door", "category": "door", "description": "a door", "licence": "CC0-1.0", "creator": "somebody", "source": "a test",
    "material": OAK, "height": 2.2, "up": "+z", "front": "+x",
}  # fmt: skip


def obj(path: Path, groups: dict[str, list[tuple[tuple, tuple]]]) -> Path:
    """Boxes (size, middle) by group, z up."""
    rows, count = [], 0
    for name, boxes in groups.items():
        rows.append(f"g {name}")
        for size, middle in boxes:
            box = trimesh.creation.box(size)
            rows += [f"v {x:g} {y:g} {z:g}" for x, y, z in box.vertices + middle]
            rows += ["f " + " ".join(str(int(corner) + 1 + count) for corner in face) for face in box.faces]
            count += 8
    path.write_text("\n".join(rows) + "\n")
    return path


FRAME = [((0.1, 0.1, 2.1), (0, -0.5, 1.05)), ((0.1, 0.1, 2.1), (0, 0.5, 1.05)), ((0.1, 1.1, 0.1), (0, 0, 2.15))]
DOOR = {
    "frame": FRAME,
    "sweethome3d_hinge_1_pins": [((0.01, 0.01, 1.8), (0, -0.445, 1.05))],
    "sweethome3d_opening_on_hinge_1_door": [((0.04, 0.88, 2.08), (0, 0, 1.05))],
    "sweethome3d_opening_on_hinge_1_handle": [((0.1, 0.1, 0.03), (0, 0.38, 1.05))],
}


def taken(path: Path, **more) -> tuple[dict, mujoco.MjModel]:
    files, facts = taken_in.take_in(path, ASKED | more)
    taken_in.write(path.parent / "door", files, facts)
    return facts, mujoco.MjModel.from_xml_path(str(path.parent / "door/moving.xml"))


def test_a_door_opens_towards_its_front_and_carries_its_handle(tmp_path: Path) -> None:
    facts, model = taken(obj(tmp_path / "door.obj", DOOR))
    assert facts["measured"]["moving"] == {"leaf_hinge": [-110.0, 0.0]}
    assert model.jnt_axis[0].tolist() == [0, 0, 1] and model.jnt_pos[0] == pytest.approx((0, -0.445, -0.05), abs=1e-6)
    assert model.body_mass.sum() == pytest.approx(690 * facts["solid_volume"], rel=1e-3)
    volume = 0.04 * 0.88 * 2.08
    assert model.body("leaf").mass[0] == pytest.approx(690 * volume, rel=0.05), "the leaf weighs what it is of"
    data = mujoco.MjData(model)
    data.qpos[0] = np.radians(-90)
    mujoco.mj_forward(model, data)
    seen = [g for g in range(model.ngeom) if model.geom(g).name.startswith("leaf_look")]
    assert len(seen) == 2 and all(data.geom_xpos[g][0] > 0.4 for g in seen)
    assert data.ncon == 0, "the doorway is free"


def test_a_door_that_is_pushed_turns_and_stays_where_it_is_left(tmp_path: Path) -> None:
    _, model = taken(obj(tmp_path / "door.obj", DOOR))
    data = mujoco.MjData(model)
    data.qvel[0] = -1.0
    mujoco.mj_step(model, data, 2_000)
    assert -1.9 < data.qpos[0] < -0.2 and abs(data.qvel[0]) < 1e-3


def test_a_lid_on_a_level_pin_stays_where_it_is_left(tmp_path: Path) -> None:
    laptop = {
        "base": [((0.25, 0.35, 0.02), (0, 0, 0.01))],
        "sweethome3d_hinge_1_pins": [((0.008, 0.3, 0.008), (-0.12, 0, 0.024))],
        "sweethome3d_opening_on_hinge_1_lid": [((0.24, 0.35, 0.008), (0, 0, 0.026))],
    }
    facts, model = taken(obj(tmp_path / "door.obj", laptop), height=0.03)
    assert [*facts["measured"]["moving"]] == ["leaf_hinge"] and abs(model.jnt_axis[0][1]) == 1
    data = mujoco.MjData(model)
    for degrees in (20, 60):
        mujoco.mj_resetData(model, data)
        left = data.qpos[0] = np.radians(degrees) * np.sign(model.jnt_range[0].sum())
        mujoco.mj_forward(model, data)
        assert abs(data.qfrc_bias[0]) > 0.3 * 9.81 * model.body("leaf").mass[0] * 0.12, "it is pulled down"
        mujoco.mj_step(model, data, 2_500)
        assert np.degrees(abs(data.qpos[0] - left)) < 0.1


def test_a_sash_that_is_pushed_up_does_not_come_down(tmp_path: Path) -> None:
    hung = {
        "sweethome3d_unique_rail_frame": FRAME,
        "sweethome3d_opening_on_rail_1_sash": [((0.04, 1.0, 0.9), (0, 0, 0.5))],
    }
    _, model = taken(obj(tmp_path / "door.obj", hung))
    assert model.jnt_axis[0].tolist() == [0, 0, 1]
    data = mujoco.MjData(model)
    data.qpos[0] = 0.5
    mujoco.mj_step(model, data, 2_500)
    assert data.qpos[0] == pytest.approx(0.5, abs=1e-3)


def test_a_sash_slides_as_far_as_its_frame_is_wide(tmp_path: Path) -> None:
    sliding = {
        "sweethome3d_unique_rail_frame": FRAME,
        "sweethome3d_opening_on_rail_1_sash": [((0.04, 0.45, 2.0), (0, -0.2, 1.05))],
    }
    facts, model = taken(obj(tmp_path / "door.obj", sliding))
    ((name, (low, high)),) = facts["measured"]["moving"].items()
    assert name == "leaf_slide" and model.jnt_axis[0].tolist() == [0, 1, 0]
    assert low == 0 and high == pytest.approx(0.95 * (0.55 - 0.025), abs=1e-3)


def test_what_tells_no_axis_stays_whole(tmp_path: Path) -> None:
    round_pin = DOOR | {"sweethome3d_hinge_1_pins": [((0.02, 0.02, 0.02), (0, -0.445, 1.05))]}
    for groups in (round_pin, {name: rows for name, rows in DOOR.items() if "pins" not in name}, {"frame": FRAME}):
        files, facts = taken_in.take_in(obj(tmp_path / "door.obj", groups), ASKED)
        assert "moving.xml" not in files and "moving" not in facts["measured"]


def test_a_group_belongs_to_the_leaf_that_carries_it() -> None:
    assert group_names.part_of("sweethome3d_opening_on_hinge_1_hinge2_sweethome3d_hinge_2") == "hinge 1"
    assert group_names.part_of("door_sweethome3d_window_pane_on_rail_2_GLASS") == "rail 2"
    assert group_names.part_of("sweethome3d_window_mirror_Cube") == ""

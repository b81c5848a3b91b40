"""A recording as one table for each body that moves, read back as whoever gets the zip would."""

import csv
import io
import zipfile

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor, record
from worldwright.ends import tables
from worldwright.model.errors import NotFoundError


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    """A loose cart whose arm a motor turns, a ball, and a door on the world, 0.5 s."""
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 2))
    cart = spec.worldbody.add_body(name="cart", pos=(3, 0, 0.2))
    cart.add_freejoint()
    cart.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.3, 0.2, 0.1))
    arm = cart.add_body(name="cart_arm", pos=(0, 0, 0.2))
    arm.add_joint(name="cart_elbow", axis=(0, 0, 1))
    arm.add_geom(size=(0.05, 0, 0), pos=(0.2, 0, 0))
    door = spec.worldbody.add_body(name="door", pos=(0, 2, 1))
    door.add_joint(name="hinge", axis=(0, 0, 1))
    door.add_geom(size=(0.1, 0, 0), pos=(0.4, 0, 0))
    spec.add_actuator(name="cart_motor", target="cart_elbow", trntype=mujoco.mjtTrn.mjTRN_JOINT)

    def control(_, data):
        data.ctrl[0] = 0.5 * data.time

    rows = (("control", frozenset({"cart_motor"})),)
    return record(spec, tmp_path_factory.mktemp("cart") / "recording", 500, control, rows=rows)


def read(path, name):
    with zipfile.ZipFile(path) as file:
        heads, *rows = csv.reader(io.StringIO(file.read(name).decode()))
    return heads, np.array(rows, dtype=float)


def test_each_body_that_moves_has_a_table_with_its_joints_and_controls(recording, tmp_path):
    path = tmp_path / "recording.zip"
    assert tables.write(recording, path, rate_hz=0, plan=b"# A plan") == 3
    with zipfile.ZipFile(path) as file:
        assert sorted(file.namelist()) == ["ball.csv", "cart.csv", "door.csv", "plan.md"]
    heads, rows = read(path, "cart.csv")
    assert heads == [*tables.OF_BODY, "elbow", "elbow_rate", "motor_control"]
    joint = next(row for row in recording.meta["joints"] if row["name"] == "cart_elbow")
    assert np.allclose(rows[:, heads.index("elbow")], recording.qpos[:, joint["qpos_address"]], rtol=1e-8, atol=0)
    assert np.ptp(rows[:, heads.index("elbow")]) > 0 and np.allclose(rows[1:, -1], 0.5 * rows[:-1, 0], atol=2e-3)
    heads, rows = read(path, "door.csv")  # which hangs on the world
    assert heads == [*tables.OF_BODY, "hinge", "hinge_rate"]
    heads, rows = read(path, "ball.csv")
    fallen = 2 - 9.81 * rows[:, 0] ** 2 / 2
    assert heads == tables.OF_BODY and np.allclose(rows[:, 3], fallen, atol=0.01)


def test_so_many_rows_a_second_as_asked(recording, tmp_path):
    tables.write(recording, tmp_path / "few.zip", rate_hz=10)
    assert len(read(tmp_path / "few.zip", "ball.csv")[1]) == 6
    with pytest.raises(NotFoundError):
        tables.write(recording, tmp_path / "none.zip", rate_hz=-1)

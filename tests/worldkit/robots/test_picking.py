"""An arm picks a mug up and puts it on a shelf, held by nothing but its fingers' friction; what it cannot is named."""

import mujoco
import numpy as np
import pytest

import packaged_machines
from worldkit import bodies, contacts, models, scene
from worldkit.robots import actuated
from worldkit.robots.arm_control import ArmControl
from worldkit.robots.arms import ARMS
from worldkit.robots.graspable import boards
from worldkit.robots.picking import Picker, PickError

ARM = ARMS["yam"]
STEP, HEIGHT, RADIUS = 0.004, 0.08, 0.034


def _world(radius: float = RADIUS, away: float = 0.45) -> mujoco.MjModel:
    spec = scene.new("kitchen", time_step=STEP)
    grip = contacts.surface(friction=0.5, time_constant=4 * STEP)
    text = actuated.model("yam", packaged_machines.ARM)
    models.attach(spec, text, name="yam", pos=(-0.01, 0, 0.1), fixed=True, surface=grip)
    bodies.box(spec, "crate", size=(0.12, 0.12, 0.1), pos=(away, 0, 0.05), fixed=True, surface=grip)
    bodies.box(spec, "shelf", size=(0.2, 0.2, 0.02), pos=(0.33, 0.33, 0.19), fixed=True, surface=grip, yaw_deg=45)
    bodies.box(
        spec, "side", size=(0.2, 0.02, 0.1), pos=(0, 0.11, 0.0), parent="shelf", surface=grip
    )  # higher, and too thin
    bodies.cylinder(
        spec, "mug", diameter=2 * radius, height=HEIGHT, pos=(away, 0, 0.1 + HEIGHT / 2), mass=0.25, surface=grip
    )
    return spec.compile()


@pytest.fixture(scope="module")
def picked():
    """The world after it is done, and of each step the height of the mug's middle and the bodies that touch it."""
    model = _world()
    data, rows = mujoco.MjData(model), []
    mujoco.mj_forward(model, data)
    picker = Picker("yam", ARM, "mug", "shelf", speed=0.5)
    mug = model.body("mug").id
    while data.time < 6.5:
        picker(model, data)
        mujoco.mj_step(model, data)
        pairs = model.geom_bodyid[data.contact.geom[: data.ncon]]
        touching = {int(one) for pair in pairs if mug in pair for one in pair} - {mug}
        rows.append((float(data.xpos[mug, 2]), frozenset(model.body(one).name for one in touching)))
    return model, data, rows


def test_the_mug_ends_on_the_shelf_and_the_hand_is_off_it(picked):
    _, data, rows = picked
    at = data.body("mug").xpos
    assert rows[-1][1] == {"shelf"} and at == pytest.approx((0.33, 0.33, 0.2 + HEIGHT / 2), abs=0.02)
    assert data.body("mug").xmat[8] > 0.999 and np.abs(data.joint("mug").qvel).max() < 0.01


def test_the_fingers_alone_carry_it(picked):
    model, _, rows = picked
    fingers = {"yam_link_left_finger", "yam_link_right_finger"}
    carried = [touching for height, touching in rows if height > 0.1 + HEIGHT / 2 + 0.02 and "shelf" not in touching]
    assert len(carried) * STEP > 1 and all(touching == fingers for touching in carried)
    assert max(height for height, _ in rows) < 0.3
    assert [model.equality(number).name for number in range(model.neq)] == ["yam_tie_0"]
    assert mujoco.mjtEq(model.eq_type[0]) == mujoco.mjtEq.mjEQ_JOINT  # that of the two fingers: nothing welds


def test_a_repetition_is_the_same_run():
    model = _world()
    data, picker, found = mujoco.MjData(model), Picker("yam", ARM, "mug", "shelf", speed=0.5), []
    for _ in range(2):
        mujoco.mj_resetData(model, data)
        mujoco.mj_forward(model, data)
        for _ in range(20):
            picker(model, data)
            mujoco.mj_step(model, data)
        found.append(data.qpos.copy())
    assert (found[0] == found[1]).all()


def test_joints_are_held_at_angles():
    model = _world()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    control, wanted = ArmControl(model, "yam", ARM), np.array((0.3, 0.9, 0.8, 0.2, -0.3, 0.4))
    for _ in range(400):
        control.hold(data, wanted, 0.02)
        mujoco.mj_step(model, data)
    assert control.angles(data) == pytest.approx(wanted, abs=0.02)
    assert data.joint("yam_left_finger").qpos[0] == pytest.approx(0.02, abs=0.003)


@pytest.mark.parametrize(("radius", "board", "code"), [(0.04, -1, "too_wide"), (RADIUS, 3, "no_board")])
def test_what_is_beyond_it_is_named(radius, board, code):
    model = _world(radius)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    picker = Picker("yam", ARM, "mug", "shelf", board=board)
    with pytest.raises(PickError) as told:
        picker(model, data)
    assert told.value.code == code and told.value.next_move and "mm" in str(told.value)


def test_what_is_out_of_reach_is_named_when_the_hand_does_not_get_there():
    model = _world(away=0.9)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    picker = Picker("yam", ARM, "mug", "shelf", speed=0.5)

    def go() -> None:
        while data.time < 4:
            picker(model, data)
            mujoco.mj_step(model, data)

    with pytest.raises(PickError, match="mm from where it is to be at `mug`") as told:
        go()
    assert told.value.code == "out_of_reach" and data.time > 1


def test_a_drum_is_a_board_where_it_stands_and_none_on_its_side():
    spec = scene.new("kitchen", time_step=STEP)
    for name, quat in (("upright", (1, 0, 0, 0)), ("lying", (0.5**0.5, 0, 0.5**0.5, 0))):
        drum = spec.worldbody.add_body(name=name, pos=(0, 0, 0.5), quat=quat)
        drum.add_geom(type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=(0.2, 0.3, 0))
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    (top,) = boards(model, data, "upright", 0.1)
    assert top == pytest.approx((0, 0, 0.8)) and not boards(model, data, "lying", 0.1)

"""Whatever a program does to the state besides stepping is in the ledger; a passive program's ledger is empty."""

import mujoco
import numpy as np
import pytest
from small_worlds import INTEGRATORS, ball, empty, floor, heap, record

from worldkit import variants


def entries(recording):
    """(kind, target, time, value, work) of every intervention."""
    table = recording.interventions
    return list(zip(table.kind, table.target, table.time, table.value, table.work_j, strict=True))


def two_balls(gravity=0.0, **options):
    spec = empty(gravity=gravity, **options)
    ball(spec, "still", (1, 0, 1), mass=2.0)
    ball(spec, "other", (-1, 0, 1), mass=0.5)
    return spec


def at(moment, act):
    """A control that acts once, at the step nearest to a time."""

    def control(model, data):
        if abs(data.time - moment) < 1e-6:
            act(model, data)

    return control


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_passive_program_records_none(integrator, tmp_path):
    looked = []

    def control(model, data):
        looked.append(data.qpos[2] + model.geom_friction[0, 0] + data.xfrc_applied.sum())

    spec = heap(integrator=integrator)
    assert entries(record(spec, tmp_path / "looking", 100, control)) == []
    assert entries(record(spec, tmp_path / "none", 100)) == []
    assert len(looked) == 100


def test_looking_on_does_not_change_the_motion(tmp_path):
    with_ledger = record(heap(), tmp_path / "a", 200, lambda model, data: None)
    assert with_ledger.sha256 == record(heap(), tmp_path / "b", 200).sha256


def test_a_written_position_is_told_with_its_displacement_and_energy(tmp_path):
    def lift(model, data):
        data.qpos[2] += 0.5
        data.qpos[3:7] = (np.cos(0.2), 0, 0, np.sin(0.2))

    recording = record(two_balls(gravity=-10.0), tmp_path / "t", 20, at(0.01, lift))
    ((kind, target, time, value, work),) = entries(recording)
    assert (kind, target, time) == ("pose", "still", pytest.approx(0.01))
    assert value == pytest.approx((0, 0, 0.5, 0, 0, 0.4))
    assert work == pytest.approx(2.0 * 10.0 * 0.5)
    assert recording.pos[10, 0, 2] - recording.pos[9, 0, 2] > 0.49  # the row shows the state that was acted on


def test_a_written_velocity_is_told_with_the_kinetic_energy(tmp_path):
    def kick(model, data):
        data.qvel[6:9] = (0, 3, 0)

    recording = record(two_balls(), tmp_path / "t", 20, at(0.005, kick))
    ((kind, target, _, value, work),) = entries(recording)
    assert (kind, target) == ("velocity", "other")
    assert value == pytest.approx((0, 3, 0, 0, 0, 0))
    assert work == pytest.approx(0.5 * 0.5 * 9)
    assert recording.energy[5, 1] == pytest.approx(2.25)
    assert recording.linvel[5, 1, 1] == pytest.approx(3.0)


def test_two_bodies_written_at_once_get_each_its_own_share(tmp_path):
    def both(model, data):
        data.qpos[2] += 1.0
        data.qpos[9] += 2.0
        data.qvel[0] = 4.0

    found = {(k, t): w for k, t, _, _, w in entries(record(two_balls(-10.0), tmp_path / "t", 5, at(0.0, both)))}
    assert found == {
        ("pose", "still"): pytest.approx(20.0),
        ("velocity", "still"): pytest.approx(16.0),
        ("pose", "other"): pytest.approx(10.0),
    }


def test_a_carried_body_counts_for_its_carrier(tmp_path):
    spec = empty(gravity=-10.0)
    lower = spec.worldbody.add_body(name="lift")
    lower.add_joint(name="rail", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(0, 0, 1))
    lower.add_geom(size=(0.1, 0, 0), mass=1.0)
    upper = lower.add_body(name="rider", pos=(0, 0, 0.5))
    upper.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE)
    upper.add_geom(size=(0.1, 0, 0), mass=3.0)
    ball(spec, "ball", (3, 0, 0))

    def raise_both(model, data):
        data.qpos[0] += 1.0
        data.qpos[4] += 1.0  # the ball's z, so that shares must be told apart

    found = {t: w for _, t, _, _, w in entries(record(spec, tmp_path / "t", 5, at(0.0, raise_both)))}
    assert found == {"lift": pytest.approx(40.0), "ball": pytest.approx(10.0)}


@pytest.mark.parametrize("integrator", ["IMPLICITFAST", "RK4", "DISCRETE"])
def test_the_work_of_a_force_is_the_energy_it_gave(integrator, tmp_path):
    def push(model, data):
        data.xfrc_applied[1, :3] = (0, 6.0, 0) if data.time < 0.0495 else 0.0
        data.xfrc_applied[2, 3:] = (0, 0, 0.01)

    recording = record(two_balls(integrator=integrator), tmp_path / "t", 100, push)
    table = recording.interventions
    force, torque = table.kind == "force", table.kind == "torque"
    assert (force.sum(), torque.sum()) == (50, 100)
    assert set(table.target[force]) == {"still"} and set(table.target[torque]) == {"other"}
    assert table.value[force][0] == pytest.approx((0, 6, 0, 0, 0, 0))
    assert table.value[torque][0] == pytest.approx((0, 0, 0, 0, 0, 0.01))
    assert table.work_j[force].sum() == pytest.approx(0.5 * 2.0 * (6.0 / 2.0 * 0.05) ** 2, rel=1e-6)
    assert table.work_j.sum() == pytest.approx(recording.energy[-1, 1], rel=1e-6)


def test_joint_forces_are_told_as_wrenches_on_the_body(tmp_path):
    spec = two_balls()
    spec.bodies[1].quat = (np.cos(0.4), np.sin(0.4), 0, 0)
    door = spec.worldbody.add_body(name="door", pos=(0, 5, 0))
    door.add_joint(name="hinge", type=mujoco.mjtJoint.mjJNT_HINGE, axis=(0, 0, 1))
    door.add_geom(size=(0.1, 0, 0), pos=(0.5, 0, 0), mass=1.0)

    def push(model, data):
        data.qfrc_applied[0] = 2.0
        data.qfrc_applied[3:6] = data.xmat[1].reshape(3, 3).T @ (0.03, 0, 0)
        data.qfrc_applied[12] = 0.4

    recording = record(spec, tmp_path / "t", 60, push)
    first = {(k, t): v for k, t, _, v, _ in entries(recording)[:3]}
    assert first[("force", "still")] == pytest.approx((2, 0, 0, 0, 0, 0))
    assert first[("torque", "still")] == pytest.approx((0, 0, 0, 0.03, 0, 0))
    assert first[("torque", "door")] == pytest.approx((0, 0, 0, 0, 0, 0.4))
    assert recording.interventions.work_j.sum() == pytest.approx(recording.energy[-1, 1], rel=1e-3)


def cart():
    spec = empty(gravity=0.0)
    body = spec.worldbody.add_body(name="cart")
    body.add_joint(name="rail", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(1, 0, 0))
    body.add_geom(size=(0.1, 0, 0), mass=2.0)
    motor = spec.add_actuator(name="motor", trntype=mujoco.mjtTrn.mjTRN_JOINT, target="rail")
    motor.gainprm[0] = 5.0
    return spec


def test_controls_are_told_with_the_force_and_work_of_their_actuator(tmp_path):
    def drive(model, data):
        data.ctrl[0] = 2.0 if data.time < 0.0495 else 0.0

    recording = record(cart(), tmp_path / "t", 100, drive)
    table = recording.interventions
    assert set(table.kind) == {"control"} and set(table.target) == {"cart/motor"}
    assert len(table) == 51  # fifty steps of driving, and letting go
    assert table.value[0] == pytest.approx((2, 10, 0, 0, 0, 0))
    assert table.work_j.sum() == pytest.approx(recording.energy[-1, 1], rel=1e-6)


def test_a_moved_mocap_body_is_told_with_the_work_it_does(tmp_path):
    spec = empty(gravity=0.0)
    hand = spec.worldbody.add_body(name="hand", mocap=True)
    hand.add_geom(size=(0.1, 0, 0))
    ball(spec, "ball", (0.2, 0, 0), mass=1.0)

    def shove(model, data):
        if data.time < 0.3:
            data.mocap_pos[0, 0] += 0.001

    recording = record(spec, tmp_path / "t", 400, shove)
    table = recording.interventions
    assert set(table.kind) == {"mocap"} and set(table.target) == {"hand"}
    assert table.value[0] == pytest.approx((0.001, 0, 0, 0, 0, 0))
    assert recording.energy[-1, 1] > 0.3
    assert table.work_j.sum() > 0  # contact damping eats some of it


def test_a_switched_constraint_and_an_edited_model_are_told(tmp_path):
    spec = two_balls()
    weld = spec.add_equality(name="hold", type=mujoco.mjtEq.mjEQ_WELD, name1="still", name2="other")
    weld.objtype = mujoco.mjtObj.mjOBJ_BODY

    def let_go(model, data):
        data.eq_active[0] = 0
        model.geom_friction[0] = (0.9, 0.1, 0.01)
        model.body_mass[2] = 0.25
        model.opt.gravity[2] = -3.0
        model.geom_rgba[1, 0] = 0.125

    recording = record(spec, tmp_path / "t", 30, at(0.02, let_go))
    found = {(k, t): v for k, t, _, v, _ in entries(recording)}
    assert found[("constraint", "hold")][0] == 0.0
    assert found[("parameter", "still.geom_friction[still]")][:3] == pytest.approx((0.9, 0.1, 0.01))
    assert found[("parameter", "other.body_mass")][0] == 0.25
    assert found[("parameter", "opt.gravity")][:3] == pytest.approx((0, 0, -3))
    assert len(found) == 4  # a colour is no intervention, but the replay needs it
    np.testing.assert_allclose(recording.interventions.time, 0.02)
    edits = recording.edits
    assert ("geom_rgba", 4, 0.125) in list(zip(edits.array, edits.index, edits.value, strict=True))
    assert set(edits.row) == {20}


def test_an_edit_that_lasts_one_step_is_caught_twice(tmp_path):
    def control(model, data):
        model.dof_damping[0] = 5.0 if abs(data.time - 0.01) < 1e-6 else 0.0

    recording = record(two_balls(), tmp_path / "t", 30, control)
    assert [(t, round(float(time), 6), v[0]) for _, t, time, v, _ in entries(recording)] == [
        ("still.dof_damping[still]", 0.01, 5.0),
        ("still.dof_damping[still]", 0.011, 0.0),
    ]


@pytest.fixture
def callbacks():
    yield
    mujoco.set_mjcb_control(None)
    mujoco.set_mjcb_passive(None)


def test_engine_callbacks_are_told_and_so_is_what_they_do(tmp_path, callbacks):
    def hidden(model, data):
        data.xfrc_applied[1, 0] = 1.0

    recording = record(two_balls(), tmp_path / "t", 20, before=lambda model, data: mujoco.set_mjcb_control(hidden))
    kinds = {(k, t) for k, t, _, _, _ in entries(recording)}
    assert kinds == {("callback", "mjcb_control"), ("force", "still")}
    assert recording.interventions.work_j.sum() == pytest.approx(recording.energy[-1, 1], rel=1e-6)


def test_a_callback_installed_on_the_way_is_told(tmp_path, callbacks):
    def install(model, data):
        mujoco.set_mjcb_passive(lambda model, data: None)

    ((kind, target, time, _, _),) = entries(record(two_balls(), tmp_path / "t", 20, at(0.01, install)))
    assert (kind, target, time) == ("callback", "mjcb_passive", pytest.approx(0.01))


def test_stepping_the_engine_inside_control_does_not_go_unnoticed(tmp_path):
    def cheat(model, data):
        if data.time < 0.0095:
            mujoco.mj_step(model, data)

    spec = empty()
    ball(spec, "ball", (0, 0, 1))
    kinds = [k for k, *_ in entries(record(spec, tmp_path / "t", 30, cheat))]
    assert {"pose", "velocity", "parameter"} <= set(kinds)


def test_a_body_that_is_posed_every_step_is_told_every_step(tmp_path):
    def animate(model, data):
        data.qpos[0] = 1 + np.sin(data.time)

    spec = two_balls()
    floor(spec)
    recording = record(spec, tmp_path / "t", 50, animate)
    assert (recording.interventions.kind == "pose").sum() >= 49
    np.testing.assert_allclose(recording.pos[:50, 0, 0], 1 + np.sin(recording.time[:50]))


@pytest.mark.parametrize("slip", ["qfrc_passive", "qfrc_bias"])
def test_a_force_slipped_into_what_the_engine_derived_is_told(slip, tmp_path):
    def float_it(model, data):
        if slip == "qfrc_bias":
            data.qfrc_bias[2] = 0.0
        else:
            data.qfrc_passive[2] += 2.0 * 9.81

    recording = record(two_balls(-9.81), tmp_path / "t", 50, float_it)
    assert abs(recording.pos[-1, 0, 2] - 1.0) < 1e-9  # it hovers
    table = recording.interventions
    assert set(zip(table.kind, table.target, strict=True)) == {("force", "still")}
    assert len(table) == 50
    assert table.value[0, 2] == pytest.approx(2.0 * 9.81)


def test_a_passive_callback_is_told_with_its_torque(tmp_path, callbacks):
    def upright(model, data):
        data.qfrc_passive[5] += 0.02

    spec = two_balls(-9.81)
    door = spec.worldbody.add_body(name="door", pos=(0, 5, 0))
    door.add_joint(name="hinge", type=mujoco.mjtJoint.mjJNT_HINGE, stiffness=(3, 0, 0), damping=(1, 0, 0), springref=20)
    door.add_geom(size=(0.1, 0, 0), pos=(0.5, 0, 0), mass=1.0)
    door.gravcomp = 0.5
    recording = record(spec, tmp_path / "t", 40, before=lambda model, data: mujoco.set_mjcb_passive(upright))
    table = recording.interventions
    assert set(zip(table.kind, table.target, strict=True)) == {("callback", "mjcb_passive"), ("torque", "still")}
    torque = table.kind == "torque"
    assert table.value[torque][0] == pytest.approx((0, 0, 0, 0, 0, 0.02))
    assert table.work_j[torque].sum() == pytest.approx(
        0.5 * 2.0 * 0.4 * 0.1**2 * recording.angvel[-1, 0, 2] ** 2, rel=0.05
    )


def test_edited_contacts_are_told(tmp_path):
    def stick(model, data):
        if data.ncon:
            data.contact.friction[:] = 5.0

    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 0.0999))
    table = record(spec, tmp_path / "t", 200, stick).interventions
    assert set(zip(table.kind, table.target, strict=True)) == {("parameter", "data.contact.friction")}


def test_asking_the_engine_for_more_is_no_intervention(tmp_path):
    def curious(model, data):
        mujoco.mj_forward(model, data)
        mujoco.mj_rnePostConstraint(model, data)
        mujoco.mj_subtreeVel(model, data)
        mujoco.mj_energyPos(model, data)

    assert entries(record(heap(), tmp_path / "t", 200, curious)) == []


def test_an_edited_height_field_is_told(tmp_path):
    def dig(model, data):
        if data.time > 0.3:
            model.hfield_data[5] = 0.25

    spec = empty()
    spec.add_hfield(name="hills", nrow=4, ncol=4, size=(1, 1, 1, 1), userdata=[0.0, 1.0, *[0.5] * 14])
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_HFIELD, hfieldname="hills")
    ball(spec, "ball", (0, 0, 3))
    ((kind, target, _, value, _),) = entries(record(spec, tmp_path / "t", 400, dig))
    assert (kind, target, value[0]) == ("parameter", "hfield_data", 0.25)


def test_a_pose_written_and_derived_again_by_the_program_is_no_force(tmp_path):
    def pose(model, data):
        data.qpos[7:9] += 0.01
        data.qvel[6:12] += 1.0
        mujoco.mj_forward(model, data)

    table = record(two_balls(-9.81), tmp_path / "t", 40, pose).interventions
    assert set(table.kind) == {"pose", "velocity"} and set(table.target) == {"other"}


def test_a_force_slipped_in_beside_a_control_is_told(tmp_path):
    def both(model, data):
        data.ctrl[0] = 1.0
        data.qfrc_passive[0] += 3.0

    table = record(cart(), tmp_path / "t", 20, both).interventions
    assert set(table.kind) == {"control", "force"}
    assert (table.kind == "force").sum() == 20


@pytest.mark.parametrize("gone", [False, True])
def test_an_actuator_of_several_controls_is_told_by_its_own_name(gone, tmp_path):
    model = mujoco.MjModel.from_xml_string(
        """<mujoco><worldbody>
        <body name="head" pos="0 0 1"><joint name="neck" type="ball"/><geom size=".1" mass="1"/></body>
        <body name="arm" pos="1 0 1"><joint name="elbow"/><geom size=".1" pos=".1 0 0" mass="1"/></body></worldbody>
        <actuator><orientation name="gaze" joint="neck" kp="10"/><motor name="lift" joint="elbow"/></actuator></mujoco>"""
    )

    def control(model, data):
        data.ctrl[:] = 0.1

    if gone:
        control = variants.apply(model, variants.Variant.parse(None, ["gaze", "control:lift"], []), control)
    recording = record(model, tmp_path / "t", 20, control)
    told = {"head/gaze[0]", "head/gaze[1]", "head/gaze[2]", "arm/lift"}
    assert set(recording.interventions.target) == (told - {"arm/lift"} if gone else told)
    assert [row["name"] for row in recording.meta["actuators"]] == ["gaze[0]", "gaze[1]", "gaze[2]", "lift"]
    assert bool(np.any(recording.actuator_force)) != gone

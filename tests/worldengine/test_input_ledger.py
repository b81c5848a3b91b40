"""Whatever a program does to the state besides stepping is in the ledger; a passive program's ledger is empty."""

import mujoco
import numpy as np
import pytest

from small_worlds import INTEGRATORS, ball, empty, floor, heap, record, replay
from worldengine.inputs.ports import Ports
from worldengine.recording import stored
from worldengine.variants import altered
from worldkit.channel import PeerError


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


def test_a_body_that_is_posed_every_step_is_told_every_step(tmp_path):
    def animate(model, data):
        data.qpos[0] = 1 + np.sin(data.time)

    spec = two_balls()
    floor(spec)
    recording = record(spec, tmp_path / "t", 50, animate)
    assert (recording.interventions.kind == "pose").sum() >= 49
    np.testing.assert_allclose(recording.pos[:50, 0, 0], 1 + np.sin(recording.time[:50]))


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

    hold = altered.alter(model, altered.Variant.parse(None, ["gaze", "control:lift"], [])) if gone else None
    recording = record(model, tmp_path / "t", 20, control, hold=hold)
    told = {"head/gaze[0]", "head/gaze[1]", "head/gaze[2]", "arm/lift"}
    assert set(recording.interventions.target) == (told - {"arm/lift"} if gone else told)
    assert [row["name"] for row in recording.meta["actuators"]] == ["gaze[0]", "gaze[1]", "gaze[2]", "lift"]
    assert bool(np.any(recording.actuator_force)) != gone


def slip_a_force(model, data):
    data.qfrc_passive[2] += 2.0 * 9.81


def cancel_the_weight(model, data):
    data.qfrc_bias[:] = 0.0


def make_it_stick(model, data):
    if data.ncon:
        data.contact.friction[:] = 5.0


def step_ahead(model, data):
    mujoco.mj_step(model, data)


def stop_the_clock(model, data):
    data.time = 0.0


def change_the_rules(model, data):
    model.opt.gravity[:] = 0.0
    model.body_mass[1] = 1e-3


def push(model, data):
    data.xfrc_applied[1, 2] = 40.0
    data.qfrc_applied[2] = 40.0


@pytest.mark.parametrize(
    "cheat", [slip_a_force, cancel_the_weight, make_it_stick, step_ahead, stop_the_clock, change_the_rules, push]
)
def test_what_is_no_declared_input_has_no_effect(cheat, tmp_path):
    spec = two_balls(-9.81)
    floor(spec)
    declared = (("control", frozenset({"motor"})),)
    honest = record(spec, tmp_path / "a", 100)
    cheated = record(spec, tmp_path / "b", 100, cheat, rows=declared)
    assert cheated.sha256 == honest.sha256
    assert entries(cheated) == []


def test_only_what_a_row_names_is_open(tmp_path):
    def everything(model, data):
        data.xfrc_applied[1:, :3] = (1.0, 0, 0)
        data.xfrc_applied[1:, 3:] = (0, 0, 0.01)
        data.qvel[0] = 5.0

    rows = (("force", frozenset({"other"})),)
    table = record(two_balls(), tmp_path / "t", 20, everything, rows=rows).interventions
    assert set(zip(table.kind, table.target, strict=True)) == {("force", "other")}
    both = (*rows, ("solver", frozenset({"still"})))
    table = record(two_balls(), tmp_path / "u", 20, everything, rows=both).interventions
    assert set(zip(table.kind, table.target, strict=True)) == {
        ("force", "other")
    }  # a solver is no word of the author's


def test_a_number_that_is_none_is_refused_and_the_recording_kept(tmp_path):
    def spoil(model, data):
        data.xfrc_applied[1, 0] = np.nan if data.time > 0.0095 else 1.0

    with pytest.raises(PeerError, match="not finite"):
        record(two_balls(), tmp_path / "t", 30, spoil)
    assert len(stored.open(tmp_path / "t")) == 10


def test_a_lower_rate_holds_what_was_answered_and_asks_less(tmp_path):
    asked = []

    def push(model, data):
        asked.append(data.time)
        data.xfrc_applied[1, 0] = 1.0 + data.time

    recording = record(two_balls(), tmp_path / "t", 40, push, control_every=10)
    np.testing.assert_allclose(asked, [0.0, 0.01, 0.02, 0.03], atol=1e-12)
    force = recording.interventions.value[:, 0]
    assert len(force) == 40 and set(force[10:20]) == {force[10]} and force[10] > force[0]
    assert recording.interventions.work_j.sum() == pytest.approx(recording.energy[-1, 1], rel=1e-6)


def test_with_latency_an_answer_acts_one_question_later(tmp_path):
    def push(model, data):
        data.ctrl[0] = round(1000 * data.time) + 1.0

    now = record(cart(), tmp_path / "a", 20, push)
    later = record(cart(), tmp_path / "b", 20, push, latency=1)
    np.testing.assert_array_equal(later.ctrl[1:20, 0], now.ctrl[:19, 0])
    assert later.ctrl[0, 0] == 0.0


@pytest.mark.parametrize("every", [1, 7])
def test_a_recording_drives_its_world_again_without_the_author(every, tmp_path):
    def act(model, data):
        data.xfrc_applied[1, :3] = np.sin(100 * data.time), 0.0, 10.0
        data.ctrl[0] = data.qvel[0]
        if abs(data.time - 0.021) < 1e-6:
            data.qvel[5] = 3.0
            model.body_mass[1] = 3.0
            data.eq_active[0] = 0

    def build():
        spec = cart()
        ball(spec, "ball", (0, 0, 2))
        weld = spec.add_equality(name="hold", type=mujoco.mjtEq.mjEQ_WELD, name1="cart", name2="ball")
        weld.objtype = mujoco.mjtObj.mjOBJ_BODY
        return spec

    first = record(build(), tmp_path / "a", 60, act, control_every=every)
    again = replay(build(), tmp_path / "b", 60, first)
    assert again.sha256 == first.sha256
    for name in ("time", "kind", "target", "value", "work_j"):
        np.testing.assert_array_equal(again.interventions[name], first.interventions[name])
    assert {"force", "control", "velocity", "constraint", "parameter"} <= set(first.interventions.kind)


def test_a_body_alone_opens_its_looks_and_no_whole_number_that_the_engine_trusts():
    """The engine takes most whole numbers of a model for addresses: written by a program, they would be its own memory."""
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><body name='crate'><freejoint/><geom name='skin' size='.1'/></body></worldbody></mujoco>"
    )
    looks = dict(Ports(model, (("parameter", frozenset({"crate"})),)).parameters)
    assert "geom_rgba" in looks and not {"body_mass", "geom_friction", "body_parentid", "geom_matid"} & looks.keys()
    named = dict(
        Ports(model, (("parameter", frozenset({"crate.body_mass", "crate.geom_dataid", "crate.jnt_type"})),)).parameters
    )
    assert set(named) == {"body_mass"}
    everything = dict(Ports(model, None).parameters)
    assert not {"body_parentid", "geom_bodyid", "jnt_qposadr", "dof_Madr"} & everything.keys()


def test_pushed_joints_of_every_kind_are_told_with_the_energy_they_get(tmp_path):
    spec = empty(gravity=0.0, time_step=1e-4)
    ball(spec, "loose", (0, 0, 0), mass=2.0)
    ball(spec, "other", (1, 0, 0), mass=1.0)
    for n, kind in enumerate(("BALL", "HINGE", "SLIDE"), 2):
        body = spec.worldbody.add_body(name=kind.lower(), pos=(n, 0, 0))
        body.add_joint(type=getattr(mujoco.mjtJoint, f"mjJNT_{kind}"), axis=(0, 0, 1))
        body.add_geom(size=(0.1, 0, 0), pos=(0, 0.2, 0), mass=1.0)
    forces = np.array([1, 0, 0, 0, 0.02, 0, 0, 0.5, 0, 0, 0, 0, 0.01, 0.02, 0.03, 0.2, 0.7])

    def push(model, data):
        data.qfrc_applied[:] = forces * (1 + data.time)

    recording = record(spec, tmp_path / "t", 400, push)
    table = recording.interventions
    told = sorted(set(zip(table.kind, table.target, strict=True)))
    assert told == [
        ("force", "loose"), ("force", "other"), ("force", "slide"),
        ("torque", "ball"), ("torque", "hinge"), ("torque", "loose"),
    ]  # fmt: skip
    assert len(table) == 400 * len(told) and bool((np.diff(table.time) >= 0).all())
    assert table.work_j.sum() == pytest.approx(recording.energy[-1, 1], rel=1e-4)
    first = {
        (k, t): v for k, t, v in zip(table.kind, table.target, table.value, strict=True) if (k, t) == ("force", "slide")
    }
    assert first["force", "slide"][2] == pytest.approx(0.7 * (1 + recording.time[-2]))


def test_what_pushes_many_bodies_takes_little_room_and_is_driven_again(tmp_path):
    def crowd():
        spec = empty(gravity=0.0)
        for n in range(60):
            ball(spec, f"ball_{n}", (n, 0, 0), mass=1.0 + n)
        return spec

    def wind(model, data):
        force = data.qfrc_applied.reshape(-1, 6)
        force[:, :3] = 1.0 - 0.5 * data.qvel.reshape(-1, 6)[:, :3]

    steps = 100
    first = record(crowd(), tmp_path / "a", steps, wind)
    plain = 16 * 180 * steps  # a step, an entry and a value for each force
    assert len(first.inputs) > 100 * steps
    assert (tmp_path / "a/inputs.arrows").stat().st_size < 0.6 * plain
    assert (tmp_path / "a/pushes.arrows").stat().st_size < 0.6 * 80 * len(first.interventions)
    again = replay(crowd(), tmp_path / "b", steps, first)
    assert again.sha256 == first.sha256
    for name in ("kind", "target", "value", "work_j"):
        assert np.array_equal(getattr(again.interventions, name), getattr(first.interventions, name))

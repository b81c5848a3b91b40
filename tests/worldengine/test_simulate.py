"""Rows mean what they say: the state at a time, with what derives from that same state."""

import mujoco
import numpy as np
import pytest

from small_worlds import INTEGRATORS, ball, empty, floor, heap, record
from worldengine.clock.simulate import prepare
from worldkit.errors import DivergedError


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_recording_does_not_change_the_motion_by_a_single_bit(integrator, tmp_path):
    recording = record(heap(integrator=integrator), tmp_path / "t", 400)
    model = heap(integrator=integrator).compile()
    data = mujoco.MjData(model)
    for row in range(400):
        assert np.array_equal(recording.qpos[row], data.qpos), row
        mujoco.mj_step(model, data)
    assert np.array_equal(recording.qvel[400], data.qvel)
    assert recording.time[-1] == data.time


@pytest.mark.parametrize("cone", ["ELLIPTIC", "PYRAMIDAL"])
@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_derived_quantities_belong_to_the_recorded_state(integrator, cone, tmp_path):
    """Against a fresh `mj_forward` at each recorded state."""
    spec = heap(integrator=integrator)
    spec.option.cone = getattr(mujoco.mjtCone, f"mjCONE_{cone}")
    spec.geoms[3].condim, spec.geoms[4].condim, spec.geoms[5].condim = 6, 4, 1
    spec.option.tolerance = 1e-12
    spec.option.iterations = 200
    recording = record(spec, tmp_path / "t", 300)
    model = spec.compile()
    prepare(model)
    data = mujoco.MjData(model)
    velocity, force = np.zeros(6), np.zeros(6)
    checked = 0
    for row in (0, 60, 150, 230, 299, 300):
        data.qpos[:], data.qvel[:] = recording.qpos[row], recording.qvel[row]
        data.time = recording.time[row]
        mujoco.mj_forward(model, data)
        mujoco.mj_subtreeVel(model, data)
        assert recording.energy[row] == pytest.approx(data.energy, rel=1e-9, abs=1e-9)
        np.testing.assert_allclose(recording.pos[row], data.xpos[1:], atol=1e-12)
        np.testing.assert_allclose(recording.quat[row], data.xquat[1:], atol=1e-12)
        np.testing.assert_allclose(recording.com[row], data.xipos[1:], atol=1e-12)
        for b in range(model.nbody - 1):
            mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, b + 1, velocity, 0)
            np.testing.assert_allclose(recording.angvel[row, b], velocity[:3], atol=1e-10)
            np.testing.assert_allclose(recording.linvel[row, b], velocity[3:], atol=1e-10)
        contacts = recording.contacts
        mine = np.flatnonzero(contacts.row == row)
        assert len(mine) == data.ncon == recording.ncon[row]
        for i, k in enumerate(mine):
            contact = data.contact[i]
            mujoco.mj_contactForce(model, data, i, force)
            assert (contacts.geom1[k], contacts.geom2[k]) == tuple(contact.geom)
            assert contacts.depth_m[k] == pytest.approx(-contact.dist)
            np.testing.assert_allclose(contacts.position[k], contact.pos)
            np.testing.assert_allclose(contacts.normal[k], contact.frame[:3])
            # the solver starts from another guess here, so the forces agree only to its tolerance
            assert contacts.normal_force[k] == pytest.approx(force[0], rel=1e-3, abs=0.05)
            np.testing.assert_allclose(
                contacts.force[k], contact.frame.reshape(3, 3).T @ force[:3], rtol=1e-3, atol=0.1
            )
            checked += 1
    assert checked > 50


def test_contact_forces_push_the_second_body_along_the_normal(tmp_path):
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 0.0999), mass=2.0)
    recording = record(spec, tmp_path / "t", 800)
    contacts = recording.contacts
    last = contacts.row == 800
    assert contacts.geom1[last] == recording.geom("ground")
    assert contacts.force[last][0] == pytest.approx((0, 0, 2 * 9.81), rel=1e-6)
    assert contacts.normal_force[last] == pytest.approx(2 * 9.81)
    assert contacts.depth_m[last] > 0


def test_free_fall_is_the_textbook_parabola(tmp_path):
    """Semi-implicit Euler falls by g h t / 2 too far; RK4 exactly."""
    for integrator, error in (("IMPLICITFAST", 9.81 * 0.001 / 2), ("RK4", 0.0)):
        spec = empty(integrator=integrator)
        ball(spec, "ball", (0, 0, 10))
        recording = record(spec, tmp_path / integrator, 1000)
        t = recording.time
        np.testing.assert_allclose(recording.pos[:, 0, 2], 10 - 9.81 * t**2 / 2 - error * t, atol=1e-9)
        np.testing.assert_allclose(recording.comvel[:, 0, 2], -9.81 * t, atol=1e-9)
        np.testing.assert_allclose(recording.energy[:, 1], (9.81 * t) ** 2 / 2, atol=1e-9)


def pendulum(angle):
    spec = empty(integrator="RK4")
    arm = spec.worldbody.add_body(name="bob", pos=(0, 0, 2))
    arm.add_joint(name="pivot", type=mujoco.mjtJoint.mjJNT_HINGE, axis=(0, 1, 0), ref=0)
    arm.add_geom(size=(0.01, 0, 0), pos=(0, 0, -1), mass=1.0)
    spec.add_key(name="start", qpos=[angle])
    return spec


def test_a_pendulum_keeps_its_energy_and_its_analytic_period(tmp_path):
    recording = record(pendulum(0.1), tmp_path / "t", 4200)
    total = recording.energy.sum(axis=1)
    assert np.ptp(total) < 1e-9
    angle = recording.qpos[:, 0]
    crossings = np.flatnonzero(np.diff(np.sign(angle)))
    period = 2 * np.diff(recording.time[crossings]).mean()
    inertia = 1.0 + 2 / 5 * 0.01**2
    expected = 2 * np.pi * np.sqrt(inertia / 9.81) * (1 + 0.1**2 / 16)
    assert period == pytest.approx(expected, abs=0.001)


def test_a_collision_keeps_linear_and_angular_momentum(tmp_path):
    spec = empty(gravity=0.0)
    spec.worldbody.add_geom(size=(0.1, 0, 0), pos=(5, 5, 5), mass=100.0)  # scenery must not count
    ball(spec, "a", (-0.5, 0.05, 0), mass=1.5)
    ball(spec, "b", (0, 0, 0), mass=0.7)

    def throw(model, data):
        data.qvel[0] = 3.0

    recording = record(spec, tmp_path / "t", 400, before=throw)
    assert recording.ncon.max() > 0
    np.testing.assert_allclose(recording.linmom, np.tile((4.5, 0, 0), (401, 1)), atol=1e-9)
    np.testing.assert_allclose(recording.angmom, recording.angmom[:1].repeat(401, axis=0), atol=1e-9)
    centre = (1.5 * np.array((-0.5, 0.05, 0))) / 2.2
    assert recording.angmom[0, 2] == pytest.approx(-1.5 * 3.0 * (0.05 - centre[1]))


def test_control_sees_the_present_state_and_acts_in_this_very_step(tmp_path):
    spec = empty()
    ball(spec, "ball", (0, 0, 1))
    seen = []

    def control(model, data):
        seen.append((data.time, data.xpos[1, 2], data.qpos[2]))
        if data.time == 0:
            data.xfrc_applied[1, 0] = 1000.0
        else:
            data.xfrc_applied[1, 0] = 0.0

    for integrator in ("IMPLICITFAST", "RK4", "DISCRETE"):
        seen.clear()
        spec.option.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{integrator}")
        recording = record(spec, tmp_path / integrator, 20, control)
        assert len(seen) == 20
        assert all(drawn == state for _, drawn, state in seen)
        assert recording.linvel[1, 0, 0] == pytest.approx(1.0)
        assert recording.linvel[-1, 0, 0] == pytest.approx(1.0)


def test_sleeping_islands_record_and_wake(tmp_path):
    spec = heap(6)
    spec.option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SLEEP)
    for body in spec.bodies:
        if body.name.startswith("ball"):
            body.pos = (3.0 + body.pos[0] * 5, 0, 0.1)
    recording = record(spec, tmp_path / "t", 1500)
    model = spec.compile()
    data = mujoco.MjData(model)
    for _ in range(1500):
        mujoco.mj_step(model, data)
    assert np.array_equal(recording.qpos[-1], data.qpos)
    assert (data.tree_asleep >= 0).any()


def test_a_blow_up_stops_with_the_body_s_name_and_keeps_the_rows(tmp_path):
    spec = empty()
    ball(spec, "calm", (5, 0, 1))
    ball(spec, "wild", (0, 0, 1))

    def control(model, data):
        if data.time > 0.0995:
            data.xfrc_applied[2, 0] = 1e15

    with pytest.raises(DivergedError, match="wild") as caught:
        record(spec, tmp_path / "t", 1000, control)
    assert caught.value.code == "diverged"
    from worldengine.recording import stored

    recording = stored.open(tmp_path / "t")
    assert not recording.complete
    assert 100 <= len(recording) <= 102
    assert "badqacc" in set(recording.warnings.warning)
    assert np.isfinite(recording.pos[:100]).all()
    assert recording.qpos[50, 2] < 1.0


def test_speculative_contacts_are_recorded_with_their_true_distance(tmp_path):
    """The engine's own is a stand-in for its solver: 0.3 m of penetration at 2 mm of air."""
    spec = empty(time_step=0.002, gravity=0.0)
    spec.option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)
    spec.worldbody.add_geom(name="sheet", type=mujoco.mjtGeom.mjGEOM_BOX, size=(1, 1, 0.002), pos=(0, 0, 0.5))
    ball(spec, "shot", (0, 0, 1), radius=0.01, solref=(-(250**2), -20))

    def shoot(model, data):
        data.qvel[2] = -50.0

    recording = record(spec, tmp_path / "t", 30, before=shoot)
    contacts = recording.contacts
    assert len(contacts) > 0
    height = recording.pos[contacts.row, 0, 2]
    np.testing.assert_allclose(contacts.depth_m, -(height - 0.502 - 0.01), atol=1e-6)
    assert contacts.depth_m.max() < 0.01
    assert recording.pos[:, 0, 2].min() > 0.5  # it did not tunnel

"""The closed forms are true: against each other, and against the engine."""

import math

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from worldwright.model.recording import closed_forms as forms

sizes = st.floats(0.01, 100)


@given(sizes, st.floats(0.5, 30))
def test_energy_and_kinematics_agree(height, g):
    assert forms.fall_speed(height, g) == pytest.approx(g * forms.fall_time(height, g))
    assert forms.flight_time(0.0, 0.0, height, g) == pytest.approx(forms.fall_time(height, g))
    assert forms.flight_time(3.0, 90.0, 0.0, g) == pytest.approx(6.0 / g)
    assert forms.sliding_distance(3.0, 0.5, g) == pytest.approx(9.0 / g)


@given(sizes, st.floats(-5, 5), sizes, st.floats(-5, 5), st.floats(0, 1))
def test_a_collision_keeps_momentum_and_returns_its_share_of_the_speed(m1, v1, m2, v2, e):
    one, other = forms.collision_speed(m1, v1, m2, v2, e), forms.collision_speed(m2, v2, m1, v1, e)
    assert m1 * one + m2 * other == pytest.approx(m1 * v1 + m2 * v2, rel=1e-6, abs=1e-6 * (m1 + m2))
    assert other - one == pytest.approx(e * (v1 - v2), abs=1e-6)


@given(sizes, sizes)
def test_a_point_on_a_thread_is_a_body_on_a_pivot(mass, length):
    point = forms.body_pendulum_period(mass * length**2, mass, length, 40)
    assert point == pytest.approx(forms.pendulum_period(length, 40))


@pytest.mark.parametrize(
    ("call", "cause"),
    [
        (lambda: forms.fall_time(-1.0), "height"),
        (lambda: forms.fall_time(1.0, 0.0), "g must be positive"),
        (lambda: forms.spring_period(10.0, 0.0), "mass"),
        (lambda: forms.sliding_distance(1.0, 0.0), "friction"),
        (lambda: forms.flight_time(1.0, 45.0, -1.0), "rises"),
        (lambda: forms.terminal_speed(1.0, 0.0), "area"),
        (lambda: forms.cantilever_period(1e9, 1e-9, 1.0, -1.0), "mass"),
    ],
)
def test_what_no_world_can_have_is_refused_by_name(call, cause):
    with pytest.raises(ValueError, match=cause):
        call()


def simulated(xml: str, until, seconds: float = 20.0):
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    while data.time < seconds and not until(data):
        mujoco.mj_step(model, data)
    return data


def test_a_rolling_ball_stands_where_the_engine_says():
    ball = """<mujoco><option timestep="0.001" cone="elliptic" impratio="10"/><default><geom condim="6" friction="0.5 0.005 0.002" priority="1"/>
    </default><worldbody><geom type="plane" size="0 0 1"/><body pos="0 0 0.1"><freejoint/><geom size="0.1" mass="1"/></body>
    </worldbody><keyframe><key qvel="0.6 0 0 0 6 0"/></keyframe></mujoco>"""
    model = mujoco.MjModel.from_xml_string(ball)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    while data.time < 10:
        mujoco.mj_step(model, data)
    assert abs(data.qvel[0]) < 1e-3
    assert data.qpos[0] == pytest.approx(forms.rolling_distance(0.6, 0.002, 0.1), rel=0.005)


def test_a_rod_swings_with_the_period_of_the_engine():
    rod = """<mujoco><option timestep="0.0005" integrator="RK4"/><worldbody><body pos="0 0 2"><joint type="hinge" axis="0 1 0"/>
    <geom type="capsule" fromto="0 0 0 0 0 -0.8" size="0.001" mass="1"/></body></worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(rod)
    data = mujoco.MjData(model)
    data.qpos[0] = math.radians(50)
    crossings = []
    while len(crossings) < 3:
        before = data.qpos[0]
        mujoco.mj_step(model, data)
        if before > 0 >= data.qpos[0] or before < 0 <= data.qpos[0]:
            crossings.append(data.time - model.opt.timestep * abs(data.qpos[0]) / abs(data.qpos[0] - before))
    arm, inertia = 0.4, forms.inertia_rod(1.0, 0.8) + 0.4**2
    assert crossings[2] - crossings[0] == pytest.approx(forms.body_pendulum_period(inertia, 1.0, arm, 50), rel=2e-3)


def test_a_plate_falls_at_its_terminal_speed_in_the_engine():
    plate = """<mujoco><option timestep="0.002" density="1.2" integrator="implicitfast"/><worldbody><body><freejoint/>
    <geom type="box" size="0.04 0.03 0.0005" mass="0.001"/></body></worldbody></mujoco>"""
    speed = -simulated(plate, lambda data: False, 2.0).qvel[2]
    assert speed == pytest.approx(forms.terminal_speed(0.001, 0.08 * 0.06), rel=0.002)
    assert forms.wind_force(speed, 0.08 * 0.06) == pytest.approx(0.001 * 9.81, rel=0.004)


def test_a_chain_of_hinges_sways_and_bends_as_the_beam_does():
    length, thick, modulus, joints = 0.8, 0.012, 9e9, 10
    moment, mass, part = math.pi * thick**4 / 64, 0.06, length / joints
    bodies = ""
    for number in range(joints):  # the clamped one has half a part to bend
        stiffness = modulus * moment / part * (2 if number == 0 else 1)
        bodies += f"""<body pos="0 0 {part if number else 0}"><joint axis="0 1 0" stiffness="{stiffness}"/>
        <geom type="cylinder" size="{thick / 2}" fromto="0 0 0 0 0 {part}" mass="{mass / joints}"/>"""
    chain = f"<option gravity='0 0 0' timestep='0.0001'/><worldbody>{bodies}{'</body>' * joints}</worldbody>"
    model = mujoco.MjModel.from_xml_string(f"<mujoco>{chain}</mujoco>")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    inertia, to_tip = np.zeros((joints, joints)), np.zeros((3, joints))
    mujoco.mj_fullM(model, data, inertia)
    springs = model.jnt_stiffness.reshape(joints, -1)[:, 0]
    slowest = np.linalg.eigvals(springs[:, None] * np.linalg.inv(inertia)).real.min()
    assert 2 * math.pi / math.sqrt(slowest) == pytest.approx(
        forms.cantilever_period(modulus, moment, length, mass), rel=0.01
    )
    mujoco.mj_jac(model, data, to_tip, None, np.array([0, 0, length]), joints)
    per_newton = (to_tip[0] ** 2 / springs).sum()
    assert 1 / per_newton == pytest.approx(forms.cantilever_stiffness(modulus, moment, length), rel=0.01)


@pytest.mark.parametrize(("tilt", "tips"), [(-1.0, False), (1.0, True)])
def test_a_block_tips_beyond_its_angle_in_the_engine_too(tilt, tips):
    angle = math.radians(forms.tipping_angle(0.1, 0.4) + tilt)
    g = f"{9.81 * math.sin(angle)} 0 {-9.81 * math.cos(angle)}"
    block = f"""<mujoco><option timestep="0.001" gravity="{g}" cone="elliptic"/><worldbody><geom type="plane" size="0 0 1"
    friction="2"/><body pos="0 0 0.2"><freejoint/><geom type="box" size="0.05 0.05 0.2" friction="2"/></body></worldbody></mujoco>"""
    data = simulated(block, lambda data: data.xmat[1, 8] < 0.7, 4.0)
    assert (data.xmat[1, 8] < 0.7) == tips


def test_every_form_is_listed_with_its_arguments_and_says_its_unit():
    assert {"fall_time", "pendulum_period", "collision_speed", "inertia_box"} <= set(forms.FORMS)
    assert not any(name.startswith("_") for name in forms.FORMS)
    for name, form in forms.FORMS.items():
        assert form.__doc__, name
        assert forms.signature(name).startswith(f"{name}(")
    assert forms.signature("fall_time") == "fall_time(height, g=9.81)"
    assert np.isfinite(forms.GRAVITY)

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from small_worlds import ball, empty, floor
from worldkit import contacts


def rebound(restitution, time_step, speed=2.0, radius=0.1, mass=1.0, integrator="IMPLICITFAST", ground=None, **more):
    """Speed ratio of a ball thrown at a floor without gravity."""
    spec = empty(time_step, integrator, gravity=0.0)
    floor(spec, **(ground or {}))
    ball(spec, "ball", (0, 0, radius + 0.0101), radius, mass, **contacts.surface(restitution=restitution, **more))
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qvel[2] = -speed
    while data.time < 0.15:
        mujoco.mj_step(model, data)
    return data.qvel[2] / speed


@settings(max_examples=25, deadline=None)
@given(
    restitution=st.floats(0.2, 1.0),
    time_step=st.sampled_from((0.0005, 0.001, 0.002)),
    radius=st.floats(0.02, 0.5),
    mass=st.floats(0.01, 50.0),
    speed=st.floats(0.5, 5.0),
)
def test_a_ball_rebounds_as_stated_whatever_its_mass_size_and_time_step(restitution, time_step, radius, mass, speed):
    # the longer the step, the more it matters where within it the ball arrives
    allowed = {0.0005: 0.05, 0.001: 0.06, 0.002: 0.12}[time_step]
    assert rebound(restitution, time_step, speed, radius, mass) == pytest.approx(restitution, abs=allowed)


@pytest.mark.parametrize("restitution", [0.2, 0.4, 0.7])
@pytest.mark.parametrize("speed", [0.5, 2.0])
def test_a_quiet_onset_leaves_rebounds_as_stated(restitution, speed):
    quiet = {"onset": contacts.QUIET_ONSET}
    ground = contacts.surface(restitution=restitution, **quiet)
    assert rebound(restitution, 0.001, speed, ground=ground, **quiet) == pytest.approx(restitution, abs=0.06)


def on_a_slope(restitution, impratio=1.0, **more):
    """(largest speed along the normal, speed downhill), m/s, of a box that has lain a second on a slope of 20 degrees."""
    spec = empty(0.001)
    spec.option.impratio = impratio
    surface = contacts.surface(friction=0.8, restitution=restitution, **more)
    lean = np.radians(20)
    tilt = (np.cos(lean / 2), 0.0, np.sin(lean / 2), 0.0)
    normal, downhill = np.array([np.sin(lean), 0.0, np.cos(lean)]), np.array([np.cos(lean), 0.0, -np.sin(lean)])
    box = mujoco.mjtGeom.mjGEOM_BOX
    spec.worldbody.add_geom(type=box, size=(2, 1, 0.1), quat=tilt, **surface)
    body = spec.worldbody.add_body(pos=0.2 * normal, quat=tilt)
    body.add_freejoint()
    body.add_geom(type=box, size=(0.1, 0.1, 0.1), mass=1.0, **surface)
    model = spec.compile()
    data = mujoco.MjData(model)
    while data.time < 1:
        mujoco.mj_step(model, data)
    fastest, start, began = 0.0, data.qpos[:3].copy(), data.time
    while data.time < 2:
        mujoco.mj_step(model, data)
        fastest = max(fastest, abs(data.qvel[:3] @ normal))
    return fastest, (data.qpos[:3] - start) @ downhill / (data.time - began)


@pytest.mark.parametrize("restitution", [0.1, 0.3, 0.5, 0.7])
def test_a_box_lies_still_on_a_slope_whatever_its_rebound(restitution):
    assert on_a_slope(restitution, onset=contacts.QUIET_ONSET)[0] < 1e-6


@pytest.mark.parametrize(("restitution", "creep_m_s"), [(0.3, 1.6e-3), (0.6, 4.1e-3)])
def test_what_a_quiet_onset_costs_is_creep_and_impratio_takes_it_away(restitution, creep_m_s):
    """The numbers that `contacts.QUIET_ONSET` and the skill on time steps state."""
    quiet = {"onset": contacts.QUIET_ONSET}
    assert on_a_slope(restitution, **quiet)[1] == pytest.approx(creep_m_s, rel=0.05)
    assert on_a_slope(restitution, impratio=10, **quiet)[1] == pytest.approx(creep_m_s / 10, rel=0.05)


def test_without_the_onset_it_hops():
    """What the default does, as said in its docs: if this ends, the argument may go."""
    hops, creep = on_a_slope(0.3)
    assert hops > 1e-3
    assert on_a_slope(0.3, impratio=10)[1] == pytest.approx(creep, rel=0.1)  # which `impratio` does not take away


@pytest.mark.parametrize(("arguments", "said"), [
    ({"restitution": 0.3, "onset": 0.0}, "between 0.1 and 0.99"),
    ({"restitution": 0.3, "onset": float("nan")}, "between 0.1 and 0.99"),
    ({"onset": 0.7}, "goes with a stated restitution"),
])  # fmt: skip
def test_an_onset_out_of_place_is_refused(arguments, said):
    with pytest.raises(ValueError, match=said):
        contacts.surface(**arguments)


@pytest.mark.parametrize("restitution", [0.3, 0.8, 0.95])
def test_runge_kutta_rebounds_as_stated_too(restitution):
    assert rebound(restitution, 0.001, integrator="RK4") == pytest.approx(restitution, abs=0.04)


def test_zero_restitution_is_nearly_dead_and_stable():
    for time_step in (0.0005, 0.001, 0.002):
        assert 0 <= rebound(0.0, time_step) < 0.06


def test_the_naive_formula_would_not_do():
    naive = -np.log(0.5) / np.sqrt(np.pi**2 + np.log(0.5) ** 2)
    assert contacts.restitution_of(naive) == pytest.approx(0.56, abs=0.01)


def test_damping_ratio_inverts_the_restitution():
    for restitution in (0.05, 0.2, 0.2079, 0.5, 0.9, 1.0):
        assert contacts.restitution_of(contacts.damping_ratio(restitution)) == pytest.approx(restitution, abs=1e-6)


def collide(first, second, masses=(1.0, 1.0)):
    """Two balls head on without gravity: velocities before and after, along the line."""
    spec = empty(gravity=0.0)
    ball(spec, "a", (-0.3, 0, 0), 0.1, masses[0], **first)
    ball(spec, "b", (0.0, 0, 0), 0.06, masses[1], **second)
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qvel[0] = 2.0
    while data.time < 0.25:
        mujoco.mj_step(model, data)
    return data.qvel[0], data.qvel[6]


@pytest.mark.parametrize("masses", [(1.0, 1.0), (0.17, 3.0), (5.0, 0.2)])
def test_two_balls_of_any_masses_part_at_the_stated_ratio_and_keep_their_momentum(masses):
    same = contacts.surface(restitution=0.8)
    a, b = collide(same, same, masses)
    assert (b - a) / 2.0 == pytest.approx(0.8, abs=0.03)
    assert masses[0] * a + masses[1] * b == pytest.approx(2.0 * masses[0], rel=1e-6)


def test_the_less_bouncy_surface_counts_and_an_unstated_one_has_no_say():
    lively, dull, silent = (contacts.surface(restitution=e) for e in (0.9, 0.4, None))
    for first, second, expected in ((lively, dull, 0.4), (dull, lively, 0.4), (lively, silent, 0.9), (dull, {}, 0.4)):
        a, b = collide(first, second)
        assert (b - a) / 2.0 == pytest.approx(expected, abs=0.03)
    assert rebound(0.9, 0.001, ground=dull) == pytest.approx(0.4, abs=0.05)


def test_condim_is_the_least_that_says_it_all():
    assert contacts.surface()["condim"] == 6
    assert contacts.surface(rolling=0.0)["condim"] == 4
    assert contacts.surface(rolling=0.0, torsional=0.0)["condim"] == 3
    assert contacts.surface(friction=0.0, rolling=0.0, torsional=0.0)["condim"] == 1
    assert contacts.surface(density=700.0)["density"] == 700.0
    assert "solref" not in contacts.surface()
    assert contacts.surface(time_constant=0.05)["solref"] == (0.05, 1.0)


def test_a_sliding_ball_comes_to_roll_without_slipping():
    """A ball that starts sliding at v ends up rolling at 5/7 v, however large the friction (textbook)."""
    spec = empty()
    surface = contacts.surface(friction=0.3, rolling=1e-6, restitution=0.5, time_constant=0.002)
    floor(spec, **surface)
    ball(spec, "ball", (0, 0, 0.0999), 0.1, 0.5, **surface)
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qvel[0] = 2.0
    while data.time < 1.5:
        mujoco.mj_step(model, data)
    speed, spin = data.qvel[0], data.qvel[4]
    assert speed == pytest.approx(2.0 * 5 / 7, rel=0.01)
    assert speed - 0.1 * spin == pytest.approx(0.0, abs=0.005)


def test_rolling_resistance_stops_a_ball_and_without_it_the_ball_rolls_on():
    speeds = []
    for rolling in (0.0, 0.01):
        spec = empty()
        floor(spec)
        ball(spec, "ball", (0, 0, 0.0999), 0.1, 0.5, **contacts.surface(rolling=rolling))
        model = spec.compile()
        data = mujoco.MjData(model)
        data.qvel[0], data.qvel[4] = 1.0, 10.0
        while data.time < 2.0:
            mujoco.mj_step(model, data)
        speeds.append(data.qvel[0])
    # the floor's own coefficients (0.0001 m) count where the ball states less
    assert speeds[0] > 0.95
    assert speeds[1] < 0.01


@pytest.mark.parametrize(
    "wrong",
    [{"friction": -1}, {"restitution": 1.1}, {"restitution": -0.1}, {"time_constant": 0}, {"rolling": float("nan")}],
)
def test_numbers_outside_their_range_are_refused(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        contacts.surface(**wrong)

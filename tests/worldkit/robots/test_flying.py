"""A drone holds its place in gusts and flies through points, by four thrusts that only push."""

import mujoco
import numpy as np
import pytest

import packaged_machines
from worldkit import models, scene
from worldkit.robots import DRONES, Gusts, actuated
from worldkit.robots.flying import Flier

DRONE = DRONES["cf21b"]
STEP = 0.004


def _flown(through, seconds, weightless=False, **more):
    spec = scene.new("field", time_step=STEP)
    spec.option.gravity[2] *= not weightless
    models.attach(spec, actuated.model("cf21b", packaged_machines.DRONE), name="drone", pos=(0, 0, 1.0))
    model = spec.compile()
    data, flier, rows, thrusts = mujoco.MjData(model), Flier("drone", DRONE, through, **more), [], []
    mujoco.mj_forward(model, data)
    for _ in range(round(seconds / STEP)):
        flier(model, data)
        mujoco.mj_step(model, data)
        rows.append(data.body("drone").xpos.copy())
        thrusts.append(data.ctrl.copy())
    return np.array(rows), np.array(thrusts), flier


def test_it_stays_within_02_m_of_its_place_in_gusts_of_2_m_s_on_a_wind_of_1():
    rows, thrusts, flier = _flown([(0, 0, 1)], 5.0, gusts=Gusts((1.0, 0.0, 0.0), 2.0))
    assert np.linalg.norm(rows - (0, 0, 1), axis=1).max() < 0.2
    assert thrusts.min() >= 0 and thrusts.max() <= DRONE.most_n
    assert np.abs(rows[:, :2]).max() > 0.005  # they did push it
    weight = flier._mass * 9.81
    assert thrusts[-500:].sum(axis=1).mean() == pytest.approx(
        weight, rel=0.2
    )  # it also leans, and is blown up and down


def test_it_flies_through_points_and_hovers_at_the_last():
    points = [(0, 0, 1.5), (1, 0, 1.5), (1, 1, 1.2)]
    rows, _, flier = _flown(points, 8.0, speed=1.5, hover_s=0.3)
    ends = np.cumsum([lasts + 0.3 for _, _, lasts in flier._legs])
    assert ends[-1] < 8
    for point, end in zip(points, ends, strict=True):
        assert np.linalg.norm(rows[int(end / STEP) - 1] - point) < 0.06
    assert np.linalg.norm(rows[-1] - points[-1]) < 0.02


def test_it_rests_where_nothing_weighs():
    rows, thrusts, _ = _flown([(0, 0, 1)], 0.1, weightless=True)
    assert np.isfinite(thrusts).all() and rows[-1] == pytest.approx((0, 0, 1), abs=1e-6)


def test_the_point_ahead_starts_and_stops_gently():
    flier = Flier("drone", DRONE, [(1, 0, 0)], speed=0.5, hover_s=0.0)
    flier._since, flier._legs = 2.0, [(np.zeros(3), np.array((1.0, 0, 0)), 3.75)]
    times = 2.0 + np.linspace(0, 3.75, 400)
    places, speeds, gains = (np.array(rows)[:, 0] for rows in zip(*map(flier.way, times), strict=True))
    assert speeds.max() == pytest.approx(0.5, rel=1e-3) and np.gradient(places, times)[1:-1] == pytest.approx(
        speeds[1:-1], abs=1e-3
    )
    assert (places[0], speeds[0], gains[0], places[-1], speeds[-1]) == pytest.approx((0, 0, 0, 1, 0), abs=1e-9)
    assert np.gradient(speeds, times)[2:-2] == pytest.approx(gains[2:-2], abs=5e-3)


def test_gusts_have_their_mean_and_strength_and_repeat():
    gusts = Gusts((1.0, 0.0, -0.5), 2.0, seed=3)
    winds = np.array([gusts.wind(time) for time in np.linspace(0, 400, 4000)])
    assert winds.mean(axis=0) == pytest.approx((1.0, 0.0, -0.5), abs=0.1) and winds.std(axis=0) == pytest.approx(
        [2.0] * 3, rel=0.05
    )
    assert (Gusts((1.0, 0.0, -0.5), 2.0, seed=3).wind(7.0) == gusts.wind(7.0)).all()
    assert not np.allclose(Gusts((1.0, 0.0, -0.5), 2.0, seed=4).wind(7.0), gusts.wind(7.0))


def test_without_points_it_hovers_where_it_starts():
    rows, _, _ = _flown([], 1.0)
    assert np.linalg.norm(rows - (0, 0, 1), axis=1).max() < 0.02

"""A driver keeps to a course, slower where it bends, and stops where it ends."""

import mujoco
import numpy as np
import pytest

from worldkit import contacts, motion, scene, vehicles

CAR = vehicles.Car()
ROAD = ((0, 0), (30, 0), (55, 10), (65, 35), (80, 55), (110, 60), (150, 60))


def test_curvature_is_that_of_a_circle():
    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    ring = vehicles.Course(20 * np.stack([np.cos(angles), np.sin(angles)], axis=1), closed=True)
    assert ring.curvature == pytest.approx(1 / 20, rel=0.02)
    assert ring.speeds(50, 3.0, 2.0, 3.0) == pytest.approx(np.sqrt(60), rel=0.02)


def test_speeds_can_be_driven():
    course = vehicles.Course(ROAD)
    speeds = course.speeds(14.0, 3.0, 2.0, 4.0)
    assert speeds.max() == pytest.approx(14.0) and speeds[-1] == 0
    assert (speeds**2 * np.abs(course.curvature) <= 3.0 + 1e-6).all()
    change = np.diff(speeds**2) / (2 * course.spacing_m)
    assert change.max() <= 2.0 + 1e-6 and change.min() >= -4.0 - 1e-6


def test_a_course_that_crosses_itself_is_followed_on_its_own_branch():
    t = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    eight = vehicles.Course(np.stack([30 * np.sin(t), 15 * np.sin(2 * t)], axis=1), closed=True)
    half = len(eight.line) // 2
    assert np.linalg.norm(eight.line[0] - eight.line[half]) < 0.5
    assert abs(eight.nearest(eight.line[half], near=half - 3)[0] - half) <= 1
    assert eight.nearest(eight.line[0], near=2)[0] in (0, 1, len(eight.line) - 1)


def test_off_to_the_left_is_positive():
    straight = vehicles.Course(((0, 0), (100, 0)))
    here, off = straight.nearest(np.array([40.0, 1.5]))
    assert straight.line[here, 0] == pytest.approx(40, abs=0.3) and off == pytest.approx(1.5)


def test_a_driver_whose_course_lies_behind_turns_round():
    spec = scene.new("road", time_step=0.002, floor_surface=contacts.surface(friction=0.9))
    vehicles.add(spec, CAR, name="car", look=None)
    data = mujoco.MjData(model := spec.compile())
    mujoco.mj_forward(model, data)
    driver = vehicles.Driver(CAR, vehicles.Course(((-20, 0), (-90, 0))))
    assert abs(driver.commands(data, "car").steering_deg) == CAR.steering_deg


def test_a_car_is_driven_along_a_winding_road_and_stops_at_its_end():
    spec = scene.new("road", time_step=0.002, floor_surface=contacts.surface(friction=0.9))
    vehicles.add(spec, CAR, name="car", pos=(CAR.wheelbase_m / 2, 0, 0), look=None)
    motion.launch(spec, {"car": motion.Launch()})
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    driver = vehicles.Driver(CAR, vehicles.Course(ROAD))
    off, fastest, across = [], 0.0, []
    while data.time < 30 and not (data.time > 5 and np.hypot(*data.qvel[:2]) < 0.02):
        commands = driver.commands(data, "car")
        vehicles.pedals(CAR, model, data, "car", **vars(commands))
        mujoco.mj_step(model, data, nstep=10)  # a driver decides fifty times a second
        off.append(abs(driver.off_m))
        fastest = max(fastest, float(np.hypot(*data.qvel[:2])))
        across.append(abs(np.hypot(*data.qvel[:2]) * data.qvel[5]))
    assert max(off) < 0.6 and 11 < fastest < 14.6
    assert np.quantile(across, 0.99) < 4.0
    assert np.linalg.norm(data.qpos[:2] - ROAD[-1]) < 6.0 and data.time < 29


def test_a_driver_who_begins_anew_looks_for_his_place_on_the_whole_course():
    spec = scene.new("road", time_step=0.002)
    vehicles.add(spec, CAR, name="car", pos=(CAR.wheelbase_m / 2, 0, 0), look=None)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    driver = vehicles.Driver(CAR, vehicles.Course(ROAD))
    driver.point = 250  # where it stood at the end of a run
    driver.commands(data, "car")
    assert driver.point == 0


def test_what_is_no_course_is_refused():
    for points in (((0, 0),), ((0, 0), (0, 0)), ((0, 0, 0), (1, 1, 1)), ((0, 0), (np.nan, 1))):
        with pytest.raises(ValueError, match="course"):
            vehicles.Course(points)

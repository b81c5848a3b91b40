"""A car against closed forms: braking, drawing off, a slope, a steady circle, and where it tips over."""

import mujoco
import numpy as np
import pytest

from worldkit import contacts, motion, portable, scene, vehicles
from worldkit.vehicles.car_numbers import CORNERS
from worldkit.vehicles.wheeled import ackermann

G = 9.81
CAR = vehicles.Car()


def world(car=CAR, friction=0.9, speed=0.0, gravity=(0.0, 0.0, -G)):
    """A bare car on a level road, its wheels rolling at `speed`, m/s."""
    spec = scene.new("road", time_step=0.002, gravity=gravity, floor_surface=contacts.surface(friction=friction))
    vehicles.add(spec, car, name="car", look=None)
    if speed:
        axles = {f"car_{c}_axle": motion.Launch(velocity=speed / car.wheel_radius_m) for c in CORNERS}
        motion.launch(spec, {"car": motion.Launch(linear=(speed, 0, 0)), **axles})
    model = spec.compile()
    data = mujoco.MjData(model)
    if speed:
        mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    mujoco.mj_forward(model, data)
    return model, data


def drive(model, data, seconds, car=CAR, until=lambda data: False, **commands):
    end = data.time + seconds
    while data.time < end and not until(data):
        vehicles.pedals(car, model, data, "car", **commands)
        mujoco.mj_step(model, data)


def slippery(car, friction):
    """The same car on tyres of this friction: of two surfaces the larger one counts."""
    from dataclasses import replace

    return replace(car, tyre_friction=friction)


def test_it_stands_where_it_was_put_and_weighs_what_it_should():
    model, data = world()
    assert model.body_subtreemass[model.body("car").id] == pytest.approx(CAR.mass_kg)
    centre = data.subtree_com[model.body("car").id]
    assert centre == pytest.approx((CAR.ahead_m, 0, CAR.height_of_mass_m), abs=1e-9)
    drive(model, data, 2.0, brake=1.0)
    assert np.abs(data.qpos[:3] - (0, 0, CAR.wheel_radius_m)).max() < 0.004
    assert np.abs(data.qvel).max() < 1e-3


@pytest.mark.parametrize("friction", [0.3, 0.8])
def test_it_stops_in_the_distance_that_its_tyres_allow(friction):
    car, speed = slippery(CAR, friction), 15.0
    model, data = world(car, friction, speed)
    drive(model, data, 8.0, car, until=lambda data: data.qvel[0] < 0.01, brake=1.0)
    assert data.qpos[0] == pytest.approx(speed**2 / (2 * friction * G), rel=0.03)
    assert abs(data.qpos[1]) < 0.05


def test_half_a_brake_is_half_the_force_at_any_speed():
    model, data = world(speed=20.0)
    effective = CAR.mass_kg + 4 * CAR.spin_inertia() / CAR.wheel_radius_m**2
    resisted = CAR.rolling_resistance * CAR.mass_kg * G
    expected = (4 * 0.25 * CAR.brake_n_m / CAR.wheel_radius_m + resisted) / effective
    for _ in range(3):
        drive(model, data, 0.3, brake=0.25)
        before = data.qvel[0]
        drive(model, data, 0.5, brake=0.25)
        assert (before - data.qvel[0]) / 0.5 == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("driven", ["front", "rear", "all"])
def test_it_draws_off_with_the_moment_at_its_wheels(driven):
    car = vehicles.Car(driven=driven)
    model, data = world(car)
    drive(model, data, 0.5, car, throttle=0.6)
    before = data.qvel[0]
    drive(model, data, 1.0, car, throttle=0.6)
    mass = car.mass_kg + 4 * car.spin_inertia() / car.wheel_radius_m**2
    force = 0.6 * car.drive_n_m / car.wheel_radius_m - car.rolling_resistance * car.mass_kg * G
    assert data.qvel[0] - before == pytest.approx(force / mass, rel=0.03)


def test_on_a_slope_its_brakes_hold_and_then_it_starts_as_the_slope_lets_it():
    slope = np.radians(12)
    model, data = world(gravity=(-G * np.sin(slope), 0, -G * np.cos(slope)))
    drive(model, data, 1.0, brake=1.0)
    held = data.qpos[0]
    drive(model, data, 2.0, brake=1.0)
    assert abs(data.qpos[0] - held) < 0.005
    drive(model, data, 0.5, throttle=0.9)
    before = data.qvel[0]
    drive(model, data, 0.5, throttle=0.9)
    mass = CAR.mass_kg + 4 * CAR.spin_inertia() / CAR.wheel_radius_m**2
    force = 0.9 * CAR.drive_n_m / CAR.wheel_radius_m - CAR.mass_kg * G * (np.sin(slope) + CAR.rolling_resistance)
    assert (data.qvel[0] - before) / 0.5 == pytest.approx(force / mass, rel=0.04)
    assert before > 0


def test_a_slope_steeper_than_its_driven_wheels_can_hold_lets_it_down():
    """Front drive on ice: mu times the load on the front axle is less than what the slope pulls with."""
    slope, car = np.radians(12), slippery(CAR, 0.25)
    gravity = (-G * np.sin(slope), 0, -G * np.cos(slope))
    share = car.front_share - np.tan(slope) * car.height_of_mass_m / car.wheelbase_m
    assert 0.25 * share * np.cos(slope) < np.sin(slope)
    model, data = world(car, 0.25, gravity=gravity)
    drive(model, data, 2.0, car, throttle=1.0)
    assert data.qvel[0] < -0.5


@pytest.mark.parametrize("steering_deg", [8.0, -20.0])
def test_it_goes_round_on_ackermanns_circle(steering_deg):
    speed = 4.0
    model, data = world(speed=speed)
    drive(model, data, 2.5, steering_deg=steering_deg, throttle=0.05)
    rear = data.body("car").xmat.reshape(3, 3) @ (-CAR.wheelbase_m / 2, 0, 0)
    velocity = data.qvel[:3] + np.cross((0, 0, data.qvel[5]), rear)  # of the middle of the rear axle
    radius = np.hypot(*velocity[:2]) / data.qvel[5]
    assert radius == pytest.approx(CAR.wheelbase_m / np.tan(np.radians(steering_deg)), rel=0.03)
    across = np.hypot(*velocity[:2]) ** 2 / abs(radius)
    assert across < 0.9 * G


def test_the_inner_wheel_turns_further():
    left, right = ackermann(CAR, np.radians(20))
    centre = CAR.wheelbase_m / np.tan(np.radians(20))
    assert left > np.radians(20) > right > 0
    assert CAR.wheelbase_m / np.tan(left) + CAR.track_m / 2 == pytest.approx(centre)
    assert CAR.wheelbase_m / np.tan(right) - CAR.track_m / 2 == pytest.approx(centre)


@pytest.mark.parametrize(("share", "tips"), [(0.9, False), (1.06, True)])
def test_it_tips_over_where_the_track_and_the_height_of_its_mass_say(share, tips):
    """On a table tilted to a share of atan(track / 2 h); stiff struts, since a body that leans tips earlier."""
    car = vehicles.Car(
        height_of_mass_m=0.95, height_m=1.9, stiffness_n_m=400_000.0, damping_n_s_m=10_000.0, tyre_friction=2.0
    )
    across = share * G * car.track_m / (2 * car.height_of_mass_m)
    model, data = world(car, 2.0, gravity=(0.0, -across, -G))
    drive(model, data, 3.0, car, brake=1.0)
    lean = np.degrees(np.arccos(np.clip(data.body("car").xmat.reshape(3, 3)[2, 2], -1, 1)))
    assert (lean > 30) == tips and (tips or lean < 8)


def test_what_cannot_stand_is_refused():
    for words in ({"mass_kg": 50}, {"front_share": 0.95}, {"wheelbase_m": 5.0}, {"tyre_friction": float("nan")}):
        with pytest.raises(ValueError, match="car"):
            vehicles.Car(**words)
    for words, number in (
        ({"driven": "4wd"}, "'4wd': front, rear, all"),
        ({"mass_kg": 200, "front_share": 0.78}, "rl -78 N, rr -78 N"),
        ({"wheelbase_m": 0.75}, "-0.03 m along"),
        ({"tyre_width_m": 1.6, "width_m": 3.2}, "-0.08 m across"),
        ({"wheelbase_m": 0.8, "steering_deg": 50}, "50 degrees turns about a point 0.67 m"),
    ):
        with pytest.raises(ValueError, match=number):
            vehicles.Car(**words)
    spec = scene.new("road", time_step=0.002)
    vehicles.add(spec, CAR, name="car", look=None)
    with pytest.raises(ValueError, match="already"):
        vehicles.add(spec, CAR, name="car", look=None)


def test_it_survives_being_written_as_one_file(tmp_path):
    spec = scene.new("road", time_step=0.002)
    vehicles.add(spec, CAR, name="car", yaw_deg=30, look=None)
    assert portable.write(spec, tmp_path / "world.mjz")["rounded"] == {}
    model = portable.read(tmp_path / "world.mjz")
    assert model.body_subtreemass[model.body("car").id] == pytest.approx(CAR.mass_kg)
    assert model.opt.impratio == 10

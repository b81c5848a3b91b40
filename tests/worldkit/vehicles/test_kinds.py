"""Trucks, buses, trailers, tracked vehicles and bicycles against closed forms, and a car's struts and grip."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from worldkit import contacts, joints, motion, portable, scene, vehicles
from worldkit.vehicles.found_cars import find_cars

G = 9.81
ODD = ("al", "bl", "cl", "dl")
ALL = (vehicles.Car(), vehicles.Truck(), vehicles.Bus(), vehicles.Tracked(), vehicles.Bicycle())


def world(vehicle, friction=0.9, speed=0.0, gravity=(0.0, 0.0, -G), trailer=None):
    """A bare vehicle on a level road, its wheels rolling at `speed`, m/s, and a trailer behind it."""
    spec = scene.new("road", time_step=0.002, gravity=gravity, floor_surface=contacts.surface(friction=friction))
    vehicles.add(spec, vehicle, name="it", look=None)
    axles = vehicle.axle_joints("it")
    if trailer is not None:
        hitch = (-BEHIND_M - vehicle.wheelbase_m / 2, 0.0, trailer.ball_m)
        at = (hitch[0] - trailer.wheelbase_m / 2, 0.0, 0.0)
        ball = joints.Ball("hitch", anchor=hitch)
        vehicles.add(spec, trailer, name="van", pos=at, look=None, parent="it", joint=ball)
        axles |= trailer.axle_joints("van")
    launched = {joint: motion.Launch(velocity=speed / radius) for joint, radius in axles.items()}
    motion.launch(spec, {"it": motion.Launch(linear=(speed, 0, 0)), **launched})
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    mujoco.mj_forward(model, data)
    return model, data


BEHIND_M = 0.8
"""From a car's rear axle to its hitch."""


def drive(vehicle, model, data, seconds, until=lambda data: False, **commands):
    end = data.time + seconds
    while data.time < end and not until(data):
        vehicles.pedals(vehicle, model, data, "it", **commands)
        mujoco.mj_step(model, data)


def leaned(data):
    """Degrees to the left."""
    return -np.degrees(np.arcsin(data.body("it").xmat.reshape(3, 3)[2, 1]))


@pytest.mark.parametrize(
    ("kind", "numbers"),
    [
        (vehicles.Truck, {"height_m": 1.5}),
        (vehicles.Trailer, {"wheel_radius_m": 0.19}),
        (vehicles.Tracked, {"wheel_radius_m": 0.15}),
        (vehicles.Tracked, {"track_m": 0.55}),
        (vehicles.Tracked, {"height_m": 1.0}),
        (vehicles.Bus, {"height_m": 1.0}),
        (vehicles.Bus, {"wheel_radius_m": 0.13}),
        (vehicles.Bicycle, {"height_m": 0.8}),
        (vehicles.Bicycle, {"steering_deg": 89.0}),
    ],
)
def test_numbers_of_which_no_body_can_be_made_are_refused(kind, numbers):
    with pytest.raises(ValueError, match=r"do not go together|no rider|cannot turn"):
        kind(**numbers)


OTHERS = (
    vehicles.Truck(wheelbase_m=5.0, driven="all", steering_deg=30.0),
    vehicles.Tracked(road_wheels=4, track_m=2.0, drive_n_m=30_000.0),
    vehicles.Bicycle(
        wheelbase_m=1.1, length_m=1.8, trail_m=0.06, head_deg=20.0, mass_kg=80.0, front_share=0.42, height_of_mass_m=0.9
    ),
)


@pytest.mark.parametrize("vehicle", [*ALL, *OTHERS], ids=lambda v: v.word)
def test_a_vehicle_of_any_kind_is_found_in_its_world_and_driven_as_by_its_own_numbers(vehicle):
    model, data = world(vehicle, speed=3.0)
    found = find_cars(model)
    assert list(found) == ["it"] and set(found["it"].actuators("it")) == set(vehicle.actuators("it"))
    assert found["it"].power_w == vehicle.power_w
    for steering, throttle, brake in ((0.0, 0.1, 0.0), (6.0, 0.2, 0.0), (-3.0, -0.3, 0.0), (4.0, 0.0, 0.5)):
        drive(vehicle, model, data, 0.1, steering_deg=steering, throttle=throttle, brake=brake)
        asked = {"steering_deg": steering, "throttle": throttle, "brake": brake}
        vehicles.pedals(vehicle, model, data, "it", **asked)
        mine = data.ctrl.copy()
        data.ctrl[:] = np.nan
        vehicles.pedals(found["it"], model, data, "it", **asked)
        assert data.ctrl == pytest.approx(mine, rel=1e-6, abs=1e-9)


def test_an_odd_world_that_calls_its_brakes_so_holds_no_vehicle():
    """Before, it ended a live drive."""
    hubs = "".join(
        f'<body name="it_{c}_hub" pos="{x} 0 0"><joint name="{c}"/><geom size=".1"/></body>' for x, c in enumerate(ODD)
    )
    brakes = "".join(f'<motor name="it_brake_{c}" joint="{c}"/>' for c in ODD)
    text = f'<mujoco><worldbody><body name="it">{hubs}</body></worldbody><actuator>{brakes}</actuator></mujoco>'
    assert find_cars(mujoco.MjModel.from_xml_string(text)) == {}


def test_a_trailer_does_not_drive_by_itself():
    model, _ = world(vehicles.Car(), trailer=vehicles.Trailer())
    assert list(find_cars(model)) == ["it"]


@pytest.mark.parametrize("vehicle", ALL[1:4], ids=lambda v: v.word)
def test_it_weighs_what_it_should_and_stands_still(vehicle):
    model, data = world(vehicle)
    assert model.body_subtreemass[model.body("it").id] == pytest.approx(vehicle.mass_kg)
    centre = (vehicle.ahead_m, 0, vehicle.height_of_mass_m)
    assert data.subtree_com[model.body("it").id] == pytest.approx(centre, abs=1e-9)
    drive(vehicle, model, data, 1.0, brake=1.0)
    assert np.abs(data.qpos[:3] - (0, 0, vehicle.wheel_radius_m)).max() < 0.005
    assert np.abs(data.qvel).max() < 2e-3


@pytest.mark.parametrize("kind", [vehicles.Truck, vehicles.Bus, vehicles.Tracked])
def test_it_stops_in_the_distance_that_its_tyres_allow(kind):
    vehicle, speed = kind(tyre_friction=0.4), 10.0
    model, data = world(vehicle, 0.4, speed)
    drive(vehicle, model, data, 6.0, until=lambda data: data.qvel[0] < 0.01, brake=1.0)
    wanted = speed**2 / (2 * 0.4 * G)
    assert data.qpos[0] == pytest.approx(wanted, rel=0.08 if kind is vehicles.Tracked else 0.04)  # belts hop


@pytest.mark.parametrize("vehicle", ALL[1:], ids=lambda v: v.word)
def test_it_draws_off_with_the_moment_at_its_wheels(vehicle):
    speed = 2.0 if vehicle.word == "bicycle" else 0.0
    model, data = world(vehicle, speed=speed)
    drive(vehicle, model, data, 0.5, throttle=0.5, power_w=1e9)
    before = data.qvel[0]
    drive(vehicle, model, data, 0.5, throttle=0.5, power_w=1e9)
    force = 0.5 * vehicle.drive_n_m / vehicle.wheel_radius_m - vehicle.rolling_resistance * vehicle.mass_kg * G
    assert (data.qvel[0] - before) / 0.5 == pytest.approx(force / vehicle.rolling_kg, rel=0.04)


@pytest.mark.parametrize(("share", "tips"), [(0.88, False), (1.08, True)])
def test_a_bus_tips_over_where_track_and_height_say(share, tips):
    """On a table tilted to a share of track / 2 h; stiff struts, since a body that leans tips earlier."""
    bus = vehicles.Bus(stiffness_n_m=4e6, damping_n_s_m=1e5, tyre_friction=2.0, height_of_mass_m=1.4)
    across = share * G * bus.track_m / (2 * bus.height_of_mass_m)
    model, data = world(bus, 2.0, gravity=(0.0, -across, -G))
    drive(bus, model, data, 3.0, until=lambda data: abs(leaned(data)) > 30, brake=1.0)
    assert (abs(leaned(data)) > 30) == tips


def test_a_car_on_its_struts_bounces_with_their_frequency():
    car = vehicles.Car(front_share=0.5, damping_n_s_m=150.0)
    model, data = world(car)
    data.qvel[2] = 0.2
    heights = []
    while data.time < 3.0:
        mujoco.mj_step(model, data)
        heights.append(data.qpos[2])
    away = np.array(heights) - np.mean(heights)
    crossings = np.flatnonzero((away[:-1] < 0) & (away[1:] >= 0)) * 0.002
    wanted = np.sqrt(4 * car.stiffness_n_m / car.sprung_kg) / (2 * np.pi)
    assert 1 / np.diff(crossings).mean() == pytest.approx(wanted, rel=0.03)


@pytest.mark.parametrize(("share", "holds"), [(0.85, True), (1.25, False)])
def test_a_car_keeps_to_its_circle_up_to_the_grip_of_its_tyres(share, holds):
    """v² / R against mu g."""
    car = vehicles.Car(tyre_friction=0.5)
    radius = car.wheelbase_m / np.tan(np.radians(6.0))
    speed = np.sqrt(share * 0.5 * G * radius)
    model, data = world(car, 0.5, speed)
    drive(car, model, data, 0.6, steering_deg=6.0, throttle=0.1)
    turned, begun = 0.0, data.time
    while data.time < begun + 1.0:
        drive(car, model, data, 0.002, steering_deg=6.0, throttle=0.1)
        turned += data.qvel[5] * 0.002
    ridden = np.hypot(*data.qvel[:2]) / turned
    assert (abs(ridden / radius - 1) < 0.07) == holds


def test_a_trailer_rides_inside_of_the_circle_of_its_car():
    car, trailer = vehicles.Car(), vehicles.Trailer()
    model, data = world(car, speed=4.0, trailer=trailer)
    assert data.joint("hitch").qpos == pytest.approx((1, 0, 0, 0))
    drive(car, model, data, 9.0, steering_deg=18.0, throttle=0.12)
    rate = data.qvel[5]
    behind = data.body("van").xpos + data.body("van").xmat.reshape(3, 3) @ (-trailer.wheelbase_m / 2, 0, 0)
    van = model.body("van").id
    moves, along = np.zeros((3, model.nv)), np.zeros((3, model.nv))
    mujoco.mj_jac(model, data, moves, along, behind, van)
    radius = np.hypot(*(moves @ data.qvel)[:2]) / rate
    axle = car.wheelbase_m / np.tan(np.radians(18.0))
    assert radius == pytest.approx(np.sqrt(axle**2 + BEHIND_M**2 - trailer.wheelbase_m**2), rel=0.04)
    assert (along @ data.qvel)[2] == pytest.approx(rate, rel=0.02)  # it has stopped folding
    pressed = -model.body_subtreemass[van] * G + sum(_load(model, data, f"van_{c}_wheel") for c in ("rl", "rr"))
    assert -pressed == pytest.approx(trailer.front_share * trailer.mass_kg * G, rel=0.2)


def _load(model, data, wheel):
    force, found = np.zeros(6), 0.0
    for i in range(data.ncon):
        pair = [model.geom(int(g)).bodyid[0] for g in data.contact[i].geom]
        if model.body(wheel).id in pair:
            mujoco.mj_contactForce(model, data, i, force)
            found += force[0]
    return found


def test_a_tracked_vehicle_turns_on_the_spot_as_its_skidding_wheels_allow():
    """The yaw rate at which the sum of Coulomb frictions, each against its wheel's slip, has no moment about the middle.

    The engine's contact law lifts what skids: a wheel's load comes and goes (a quarter of the time it is off the ground), and the
    vehicle turns 6 % slower than with even loads, at a quarter of the time step as well, by 3 % with contacts five times softer.
    """
    tracked, turned = vehicles.Tracked(), []
    model, data = world(tracked)
    corners = [belt[0] for belt in tracked.belts]
    while data.time < 2.0:
        for side, drive_name in ((-1, "it_drive_l"), (1, "it_drive_r")):
            spin = data.joint(f"it_{corners[side > 0]}_axle").qvel[0]
            data.actuator(drive_name).ctrl[0] = 40_000 * (side * 0.6 / tracked.wheel_radius_m - spin)
        mujoco.mj_step(model, data)
        if data.time > 1.0:
            spins = [data.joint(f"it_{corner}_axle").qvel[0] for corner in corners]
            turned.append(((spins[1] - spins[0]) / 2 * tracked.wheel_radius_m, data.qvel[5]))
    belt, rate = np.mean(turned, axis=0)
    half = tracked.track_m / 2
    places = np.array([axle.x_m for axle in tracked.axles])

    def moment(rate):
        along, across = rate * half - belt, rate * places
        return float(((across * places + along * half) / np.hypot(along, across)).sum())

    low, high = 1e-6, belt / half
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if moment(middle) > 0 else (middle, high)
    assert low < 0.95 * belt / half  # it skids: slower than belts on rails would turn it
    assert rate == pytest.approx(low, rel=0.09)
    assert np.hypot(*data.qpos[:2]) < 0.1


def test_belts_hold_their_wheels_at_one_speed_and_its_driver_keeps_to_a_course():
    tracked = vehicles.Tracked()
    model, data = world(tracked)
    course = vehicles.Course([(-1.2, 0), (3, 0), (8, 3), (10, 8)])
    driver = vehicles.Driver(tracked, course, top_m_s=4.0, across_m_s2=1.5)
    off = []
    while data.time < 5 and driver.point != len(course.line) - 1:
        drive(tracked, model, data, 0.02, **vars(driver.commands(data, "it")))
        off.append(abs(driver.off_m))
    spins = [data.joint(f"it_{corner}_axle").qvel[0] for corner in tracked.belts[0]]
    assert np.ptp(spins) < 0.03 * np.mean(np.abs(spins)) + 0.1 and max(off) < 1.1 and data.qpos[1] > 3


@pytest.mark.parametrize("speed", [3.0, 6.0])
def test_a_rider_leans_into_a_bend_as_its_speed_asks_and_stays_up(speed):
    bicycle = vehicles.Bicycle()
    model, data = world(bicycle, speed=speed)
    bend = 4.0 if speed > 4 else 7.0
    lowest = 0.0
    while data.time < 6.0:
        hold = 0.5 * (speed - np.hypot(*data.qvel[:2])) + 0.05
        drive(bicycle, model, data, 0.002, steering_deg=bend, throttle=hold)
        lowest = min(lowest, leaned(data))
    rate, now = data.joint("it").qvel[5], np.hypot(*data.qvel[:2])
    assert lowest < -1e-4 or data.qpos[1] > 1  # first he steers away from the bend, then falls into it
    lean = np.radians(leaned(data))
    yaw = rate / np.cos(lean)
    # Trail puts the front wheel beside the frame, and with it, by its share of the load, the line that he balances on.
    beside = bicycle.front_share * bicycle.trail_m * np.radians(bend) / bicycle.height_of_mass_m
    assert np.tan(lean) == pytest.approx(now * yaw / G - beside, rel=0.02)
    assert now / yaw == pytest.approx(bicycle.wheelbase_m / np.tan(np.radians(bend)), rel=0.03)


def test_a_bicycle_falls_without_its_rider():
    bicycle = vehicles.Bicycle()
    model, data = world(bicycle, speed=3.0)
    data.qvel[3] = 0.02  # a breath of wind
    while data.time < 3.0:
        mujoco.mj_step(model, data)
    assert abs(leaned(data)) > 60
    model, data = world(bicycle, speed=3.0)
    data.qvel[3] = 0.02
    drive(bicycle, model, data, 3.0, throttle=0.05)
    assert abs(leaned(data)) < 1


def test_what_cannot_stand_is_refused():
    for make, said in (
        (lambda: vehicles.Truck(tandem_m=0.8), "inside each other: 0.80 m"),
        (lambda: vehicles.Tracked(road_wheels=1), "2 to 12 road_wheels"),
        (lambda: vehicles.Tracked(road_wheels=9), "inside each other"),
        (lambda: vehicles.Trailer(front_share=0.6), "of a trailer's weight on its ball"),
        (lambda: vehicles.Trailer(drawbar_m=2.9), "shorter drawbar_m"),
        (lambda: vehicles.Bicycle(mass_kg=5), "no frame"),
        (lambda: vehicles.Bicycle(trail_m=float("nan")), "trail_m"),
        (lambda: vehicles.Bus(mass_kg=500), "a bus of 500"),
        (lambda: vehicles.Timed(((1.0, vehicles.Commands()), (0.5, vehicles.Commands()))), "times that grow"),
    ):
        with pytest.raises(ValueError, match=said):
            make()


def test_a_driver_with_a_list_goes_from_the_one_to_the_other_in_a_line():
    listed = vehicles.Timed(((0.0, vehicles.Commands()), (1.0, vehicles.Commands(steering_deg=10, brake=1.0))))
    _, data = world(ALL[0])
    for t, wanted in ((0.0, 0.0), (0.25, 2.5), (1.0, 10.0), (7.0, 10.0)):
        data.time = t
        assert listed.commands(data, "it").steering_deg == pytest.approx(wanted)


@pytest.mark.parametrize("vehicle", [ALL[3], replace(ALL[4], head_deg=0.0)], ids=lambda v: v.word)
def test_it_survives_being_written_as_one_file(tmp_path, vehicle):
    spec = scene.new("road", time_step=0.002)
    vehicles.add(spec, vehicle, name="it", look=None)
    portable.write(spec, tmp_path / "world.mjz")
    model = portable.read(tmp_path / "world.mjz")
    assert model.body_subtreemass[model.body("it").id] == pytest.approx(vehicle.mass_kg)
    assert set(vehicle.actuators("it")) == {model.actuator(a).name for a in range(model.nu)}

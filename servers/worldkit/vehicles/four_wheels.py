"""A car on four sprung wheels: chassis, hubs on struts, steered front wheels, driven axles, brakes on all wheels.

Frame of the body `NAME`: the middle of the wheelbase at the height of the axles; x forward, y to the left. Its parts are
`NAME_fl_hub` and `NAME_fl_wheel` (fl, fr, rl, rr), its joints `NAME_fl_strut` (m, up is compressed), `NAME_fl_steer` (rad),
`NAME_fl_axle` (rad), its actuators `NAME_steer_fl`, `NAME_steer_fr` (rad), `NAME_drive` (N·m on all driven axles together, shared
alike, as by an open differential) and `NAME_brake_fl` … (0 to 1, a damper). `driving_inputs.pedals` turns a driver's steering,
throttle and brake into their controls.

A wheel touches the ground as an ellipsoid with Coulomb friction: the car follows Ackermann's geometry up to the friction's
limit, without slip angles and without understeer. The tyre that is seen touches nothing.
"""

from typing import TYPE_CHECKING

from .car_body import dress_car
from .car_numbers import CORNERS, Car

if TYPE_CHECKING:
    import mujoco

Vec3 = tuple[float, float, float]
STRUT_TRAVEL_M = 0.12
LOOK_COLOUR = "#a31621"


def add(
    spec: "mujoco.MjSpec",
    car: Car,
    *,
    name: str,
    pos: Vec3 = (0.0, 0.0, 0.0),
    yaw_deg: float = 0.0,
    look: str | None = LOOK_COLOUR,
) -> "mujoco.MjsBody":
    """Add a car that stands with its wheels on the level through `pos`, m, the point below the middle of its wheelbase.

    The world gets elliptic friction cones with `impratio` 10, without which a car weaves in corners. Use a time step of at
    most 2 ms. `look` is the paint, `#rrggbb`; None leaves the bare boxes, for tests.

    Raises ValueError for a name that is taken.
    """
    import mujoco
    import numpy as np

    if spec.body(name) is not None:
        raise ValueError(f"there is a body {name!r} already: name this car otherwise")
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = max(spec.option.impratio, 10.0)
    half = np.radians(yaw_deg) / 2
    body = spec.worldbody.add_body(
        name=name, pos=(pos[0], pos[1], pos[2] + car.wheel_radius_m), quat=(np.cos(half), 0, 0, np.sin(half))
    )
    body.add_freejoint(name=name)
    _weigh(body, car)
    _chassis(body, car, name)
    for corner in CORNERS:
        _corner(spec, body, car, name, corner)
    _actuators(spec, car, name)
    if look is not None:
        dress_car(spec, car, name, look)
    return body


def _weigh(body: "mujoco.MjsBody", car: Car) -> None:
    """Give the chassis its mass, so that the whole car has its centre of mass where `car` says."""
    unsprung = car.mass_kg - car.sprung_kg
    height = (car.height_of_mass_m * car.mass_kg - car.wheel_radius_m * unsprung) / car.sprung_kg
    x, y, z = 0.85 * car.length_m, 0.9 * car.width_m, 0.65 * car.height_m  # of a box whose mass is spread alike
    body.mass, body.explicitinertial = car.sprung_kg, True
    body.ipos = (car.ahead_m * car.mass_kg / car.sprung_kg, 0, height - car.wheel_radius_m)
    body.inertia = tuple(car.sprung_kg / 12 * (a * a + b * b) for a, b in ((y, z), (x, z), (x, y)))


def _chassis(body: "mujoco.MjsBody", car: Car, name: str) -> None:
    """What collides: a low box between the axles, one above the wheels as long as the car, and the cabin."""
    import mujoco

    box = mujoco.mjtGeom.mjGEOM_BOX
    length, width, height, radius = car.length_m, car.width_m, car.height_m, car.wheel_radius_m
    inner = car.wheelbase_m - 2.5 * radius
    over, top = 2.3 * radius, 0.63 * height
    for part, size, at in (
        ("floor", (inner, width, top - 0.6 * radius), (0, 0, (top + 0.6 * radius) / 2)),
        ("nose", (length, 0.98 * width, max(top - over, 0.1)), (0, 0, (top + over) / 2)),
        ("cabin", (0.38 * length, 0.78 * width, height - top), (-0.08 * length, 0, (height + top) / 2)),
    ):
        body.add_geom(
            name=f"{name}_{part}", type=box, size=[s / 2 for s in size], pos=(at[0], at[1], at[2] - radius), mass=0
        )


def _corner(spec: "mujoco.MjSpec", body: "mujoco.MjsBody", car: Car, name: str, corner: str) -> None:
    """A hub on its strut, steered in front, and a wheel on it."""
    import mujoco
    import numpy as np

    from .. import contacts

    hinge, slide = mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE
    radius, of = car.wheel_radius_m, f"{name}_{corner}"
    hub = body.add_body(name=f"{of}_hub", pos=(*car.place(corner), 0))
    hub.mass, hub.inertia, hub.ipos, hub.explicitinertial = car.hub_kg, [0.02 * car.hub_kg] * 3, (0, 0, 0), True
    strut = hub.add_joint(name=f"{of}_strut", type=slide, axis=(0, 0, 1), range=(-STRUT_TRAVEL_M, STRUT_TRAVEL_M))
    strut.stiffness[0], strut.damping[0] = car.stiffness_n_m, car.damping_n_s_m
    strut.springref = -car.strut_n(corner) / car.stiffness_n_m
    if corner[0] == "f":
        # The inner wheel turns further than the wheel in the middle.
        most = np.degrees(max(abs(a) for a in ackermann(car, np.radians(car.steering_deg))))
        hub.add_joint(name=f"{of}_steer", type=hinge, axis=(0, 0, 1), range=(-most - 1, most + 1), armature=0.5)
    wheel = hub.add_body(name=f"{of}_wheel")
    axle = wheel.add_joint(name=f"{of}_axle", type=hinge, axis=(0, 1, 0))
    load = car.mass_kg * 9.81 * (car.front_share if corner[0] == "f" else 1 - car.front_share) / 2
    axle.frictionloss = car.rolling_resistance * load * radius
    wheel.add_geom(
        name=f"{of}_wheel", type=mujoco.mjtGeom.mjGEOM_ELLIPSOID, size=(radius, car.tyre_width_m / 2, radius),
        mass=car.wheel_kg, **{**contacts.surface(friction=car.tyre_friction), "condim": 3},
    )  # fmt: skip
    wheel.mass, wheel.ipos, wheel.explicitinertial = car.wheel_kg, (0, 0, 0), True
    wheel.inertia = (0.35 * car.wheel_kg * radius**2, spin_inertia(car), 0.35 * car.wheel_kg * radius**2)
    spec.add_exclude(bodyname1=name, bodyname2=f"{of}_wheel")  # it stands in its arch


def spin_inertia(car: Car) -> float:
    """Of a wheel about its axle, kg·m²: most of it lies in the tyre."""
    return 0.6 * car.wheel_kg * car.wheel_radius_m**2


def ackermann(car: Car, middle_rad: float) -> tuple[float, float]:
    """Angles of the left and the right front wheel, rad, so that all wheels turn about one point; `middle_rad` is to the left.

    Source: R. N. Jazar, Vehicle Dynamics, 7.1 "Kinematic Steering".
    """
    from math import atan, tan

    if abs(middle_rad) < 1e-9:
        return middle_rad, middle_rad
    radius = car.wheelbase_m / tan(middle_rad)
    left, right = (atan(car.wheelbase_m / (radius - side * car.track_m / 2)) for side in (1, -1))
    return left, right


def _actuators(spec: "mujoco.MjSpec", car: Car, name: str) -> None:
    import mujoco

    joint, tendon = mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_TENDON
    for corner in CORNERS[:2]:
        servo = spec.add_actuator(name=f"{name}_steer_{corner}", target=f"{name}_{corner}_steer", trntype=joint)
        servo.set_to_position(kp=20_000, kv=600)
    shafts = spec.add_tendon(name=f"{name}_shafts")
    for corner in car.driven_wheels:
        shafts.wrap_joint(f"{name}_{corner}_axle", 1 / len(car.driven_wheels))
    motor = spec.add_actuator(name=f"{name}_drive", target=f"{name}_shafts", trntype=tendon)
    motor.set_to_motor()
    motor.ctrllimited, motor.ctrlrange = mujoco.mjtLimited.mjLIMITED_TRUE, (-car.drive_n_m, car.drive_n_m)
    for corner in CORNERS:
        brake = spec.add_actuator(name=f"{name}_brake_{corner}", target=f"{name}_{corner}_axle", trntype=joint)
        brake.set_to_damper(kv=BRAKE_GAIN * car.brake_n_m)
        brake.ctrllimited, brake.ctrlrange = mujoco.mjtLimited.mjLIMITED_TRUE, (0, 1)
        brake.forcelimited, brake.forcerange = mujoco.mjtLimited.mjLIMITED_TRUE, (-car.brake_n_m, car.brake_n_m)


BRAKE_GAIN = 100.0
"""s/rad: a held wheel creeps so little that its brake's whole moment belongs to a hundredth of a radian a second."""

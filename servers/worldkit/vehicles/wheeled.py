"""A vehicle on sprung wheels: chassis, hubs on struts, steered wheels, driven axles, brakes on all wheels.

Frame of the body `NAME`: the middle of the wheelbase at the height of the axles; x forward, y to the left. Its parts are
`NAME_fl_hub` and `NAME_fl_wheel` (fl, fr, rl, rr; ml and mr between), its joints `NAME_fl_strut` (m, up is compressed),
`NAME_fl_steer` (rad), `NAME_fl_axle` (rad), its actuators `NAME_steer_fl`, `NAME_steer_fr` (rad), `NAME_drive` (N·m on all driven
axles together, shared alike, as by open differentials) and `NAME_brake_fl` … (0 to 1, a damper). `driving_inputs.pedals` turns a
driver's steering, throttle and brake into their controls.

A wheel touches the ground as an ellipsoid with Coulomb friction: the vehicle follows Ackermann's geometry up to the friction's
limit, without slip angles and without understeer. The tyre that is seen touches nothing.
"""

from typing import TYPE_CHECKING

from .axles import Axle, G, OnAxles

if TYPE_CHECKING:
    import mujoco

    from ..joints import Joint
    from .found_cars import FoundCar

Vec3 = tuple[float, float, float]
STRUT_TRAVEL_M = 0.12


def add_on_axles(
    spec: "mujoco.MjSpec",
    vehicle: OnAxles,
    name: str,
    pos: Vec3,
    yaw_deg: float,
    parent: str | None = None,
    joint: "Joint | None" = None,
) -> "mujoco.MjsBody":
    """Add a vehicle on axles that stands with its wheels on the level through `pos`, m, the point below the middle of its wheelbase.

    A trailer hangs by `joint`, a ball at its hitch, on the vehicle `parent`.
    """
    import mujoco

    from ..bodies import pose_below
    from ..joints import attach

    x, y, z = pos
    owner, place, quat = pose_below(spec, name, (x, y, z + vehicle.wheel_radius_m), yaw_deg, parent)
    body = owner.add_body(name=name, pos=place, quat=quat)
    if joint is not None:
        attach(body, joint)
    else:
        body.add_freejoint(name=name)
    _weigh(body, vehicle)
    for part, size, at in vehicle.solids:
        body.add_geom(
            name=f"{name}_{part}", type=mujoco.mjtGeom.mjGEOM_BOX, size=[s / 2 for s in size],
            pos=(at[0], at[1], at[2] - vehicle.wheel_radius_m), mass=0,
        )  # fmt: skip
    for axle in vehicle.axles:
        for corner in axle.corners:
            _corner(spec, body, vehicle, name, axle, corner)
    _actuators(spec, vehicle, name)
    return body


def _weigh(body: "mujoco.MjsBody", vehicle: OnAxles) -> None:
    """Give the chassis its mass, so that the whole vehicle has its centre of mass where its numbers say."""
    sprung, radius = vehicle.sprung_kg, vehicle.wheel_radius_m
    height = (vehicle.height_of_mass_m * vehicle.mass_kg - radius * (vehicle.mass_kg - sprung)) / sprung
    moment = vehicle.ahead_m * vehicle.mass_kg - sum(2 * vehicle.unsprung_kg(a) * a.x_m for a in vehicle.axles)
    # Of a box whose mass is spread alike.
    x, y, z = 0.85 * vehicle.length_m, 0.9 * vehicle.width_m, 0.65 * vehicle.height_m
    body.mass, body.explicitinertial = sprung, True
    body.ipos = (moment / sprung, 0, height - radius)
    body.inertia = tuple(sprung / 12 * (a * a + b * b) for a, b in ((y, z), (x, z), (x, y)))


def _corner(
    spec: "mujoco.MjSpec", body: "mujoco.MjsBody", vehicle: OnAxles, name: str, axle: Axle, corner: str
) -> None:
    """A hub on its strut, steered where its axle is, and a wheel on it."""
    import mujoco
    import numpy as np

    from .. import contacts

    hinge, slide = mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE
    radius, of, mass = vehicle.wheel_radius_m, f"{name}_{corner}", vehicle.wheel_mass(axle)
    hub = body.add_body(name=f"{of}_hub", pos=(*vehicle.place(corner), 0))
    hub.mass, hub.inertia, hub.ipos = vehicle.hub_kg, [0.02 * vehicle.hub_kg] * 3, (0, 0, 0)
    hub.explicitinertial = True
    strut = hub.add_joint(name=f"{of}_strut", type=slide, axis=(0, 0, 1), range=(-STRUT_TRAVEL_M, STRUT_TRAVEL_M))
    strut.stiffness[0], strut.damping[0] = vehicle.stiffness_n_m, vehicle.damping_n_s_m
    strut.springref = -vehicle.strut_n(corner) / vehicle.stiffness_n_m
    if axle.steered:
        # The inner wheel turns further than the wheel in the middle.
        most = np.degrees(max(abs(a) for a in ackermann(vehicle, np.radians(vehicle.steering_deg))))
        armature = 0.5 * _heavier(vehicle)
        hub.add_joint(name=f"{of}_steer", type=hinge, axis=(0, 0, 1), range=(-most - 1, most + 1), armature=armature)
    wheel = hub.add_body(name=f"{of}_wheel")
    turning = wheel.add_joint(name=f"{of}_axle", type=hinge, axis=(0, 1, 0))
    turning.frictionloss = vehicle.rolling_resistance * vehicle.mass_kg * G * axle.share / 2 * radius
    wheel.add_geom(
        name=f"{of}_wheel", type=mujoco.mjtGeom.mjGEOM_ELLIPSOID, size=(radius, vehicle.wheel_width(axle) / 2, radius),
        mass=mass, **{**contacts.surface(friction=vehicle.tyre_friction), "condim": 3},
    )  # fmt: skip
    wheel.mass, wheel.ipos, wheel.explicitinertial = mass, (0, 0, 0), True
    wheel.inertia = (0.35 * mass * radius**2, vehicle.spin_inertia(axle), 0.35 * mass * radius**2)
    spec.add_exclude(bodyname1=name, bodyname2=f"{of}_wheel")  # it stands in its arch


def _heavier(vehicle: OnAxles) -> float:
    """How much heavier to steer its wheels are than those of a car, whose servo's gains stand below."""
    return vehicle.wheel_kg * vehicle.wheel_radius_m**2 / (18 * 0.31**2)


def ackermann(vehicle: "OnAxles | FoundCar", middle_rad: float) -> tuple[float, float]:
    """Angles of the left and the right front wheel, rad, so that all wheels turn about one point; `middle_rad` is to the left.

    Source: R. N. Jazar, Vehicle Dynamics, 7.1 "Kinematic Steering".
    """
    from math import atan, tan

    if abs(middle_rad) < 1e-9:
        return middle_rad, middle_rad
    radius = vehicle.wheelbase_m / tan(middle_rad)
    left, right = (atan(vehicle.wheelbase_m / (radius - side * vehicle.track_m / 2)) for side in (1, -1))
    return left, right


def _actuators(spec: "mujoco.MjSpec", vehicle: OnAxles, name: str) -> None:
    import mujoco

    joint, tendon = mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_TENDON
    for corner in vehicle.steered_wheels:
        servo = spec.add_actuator(name=f"{name}_steer_{corner}", target=f"{name}_{corner}_steer", trntype=joint)
        servo.set_to_position(kp=20_000 * _heavier(vehicle), kv=600 * _heavier(vehicle))
    for drive, corners in vehicle.drives.items():
        shafts = spec.add_tendon(name=f"{name}_{drive}_shafts")
        for corner in corners:
            shafts.wrap_joint(f"{name}_{corner}_axle", 1 / len(corners))
        motor = spec.add_actuator(name=f"{name}_{drive}", target=f"{name}_{drive}_shafts", trntype=tendon)
        motor.set_to_motor()
        most = vehicle.drive_n_m / len(vehicle.drives)
        motor.ctrllimited, motor.ctrlrange = mujoco.mjtLimited.mjLIMITED_TRUE, (-most, most)
    for first, *others in vehicle.belts:
        for corner in others:
            belt = spec.add_equality(
                name=f"{name}_{corner}_belt", type=mujoco.mjtEq.mjEQ_JOINT,
                name1=f"{name}_{corner}_axle", name2=f"{name}_{first}_axle",
            )  # fmt: skip
            belt.data[:2] = (0, 1)
            belt.solref, belt.solimp = (0.004, 1), (0.99, 0.999, 0.001, 0.5, 2)  # it hardly gives
    for corner in vehicle.corners:
        brake = spec.add_actuator(name=f"{name}_brake_{corner}", target=f"{name}_{corner}_axle", trntype=joint)
        brake.set_to_damper(kv=BRAKE_GAIN * vehicle.brake_n_m)
        brake.ctrllimited, brake.ctrlrange = mujoco.mjtLimited.mjLIMITED_TRUE, (0, 1)
        brake.forcelimited = mujoco.mjtLimited.mjLIMITED_TRUE
        brake.forcerange = (-vehicle.brake_n_m, vehicle.brake_n_m)


BRAKE_GAIN = 100.0
"""s/rad: a held wheel creeps so little that its brake's whole moment belongs to a hundredth of a radian a second."""

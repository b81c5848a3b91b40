"""A bicycle with its rider: frame and rider as one body, a fork on a leaning axis with trail, two wheels; and the rider's balance.

Its parts are `NAME`, `NAME_fork`, `NAME_f_wheel` and `NAME_r_wheel`; its joints `NAME_steer` (rad), `NAME_f_axle`, `NAME_r_axle`; its
actuators `NAME_steer_f` (rad), `NAME_drive` (N·m at the rear wheel), `NAME_brake_f`, `NAME_brake_r` (0 to 1).

The rider's law: with the lean p (rad, to the left), the height h of the centre of mass, the wheelbase L and the angle d between the
tracks of the wheels, a point mass on a wheeled line falls by h p" = g p - v² d / L. For the circle of d he wants the lean q with
g tan q = v² d / L - g s t d / h: the fork's trail t puts the front wheel beside the frame, and with it the line that he balances on,
by its share s of the load. He steers d' = L / v² (v² d / L + (g + h w²)(p - q) + 2 h w p'), so that p - q dies out as a critically
damped oscillation of quickness w; the fork, whose axis leans, turns as far as its wheel's track then needs at this lean. Where he is
too slow for that (below `SLOWEST_M_S`) he steers as if he rode so fast, and falls. Source: K. J. Åström, R. E. Klein and A. Lennartsson, Bicycle
Dynamics and Control, IEEE Control Systems Magazine 25 (2005), "simple models".
"""

from typing import TYPE_CHECKING

from .axles import G
from .bicycle_numbers import Bicycle
from .wheeled import BRAKE_GAIN

if TYPE_CHECKING:
    import mujoco

SLOWEST_M_S = 1.5


def add_bicycle(
    spec: "mujoco.MjSpec", bicycle: Bicycle, name: str, pos: tuple[float, float, float], yaw_deg: float
) -> "mujoco.MjsBody":
    """Add a bicycle that stands upright, its wheels on the level through `pos`, m, the point below the middle of its wheelbase."""
    import mujoco
    import numpy as np

    hinge, joint = mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtTrn.mjTRN_JOINT
    half, radius = bicycle.wheelbase_m / 2, bicycle.wheel_radius_m
    turn = np.radians(yaw_deg) / 2
    body = spec.worldbody.add_body(
        name=name, pos=(pos[0], pos[1], pos[2] + radius), quat=(np.cos(turn), 0, 0, np.sin(turn))
    )
    body.add_freejoint(name=name)
    # Wheels and fork have their masses at the hubs: the rest balances them.
    rest = bicycle.frame_kg
    ahead = (bicycle.ahead_m * bicycle.mass_kg - half * bicycle.fork_kg) / rest
    height = (bicycle.height_of_mass_m * bicycle.mass_kg - radius * (bicycle.mass_kg - rest)) / rest - radius
    body.mass, body.ipos, body.explicitinertial = rest, (ahead, 0, height), True
    body.inertia = (rest * 0.30**2, rest * 0.34**2, rest * 0.22**2)  # radii of gyration of a rider who sits, m
    for part, size, at in _solids(bicycle):
        middle = (at[0], at[1], at[2] - radius)
        body.add_geom(
            name=f"{name}_{part}", type=mujoco.mjtGeom.mjGEOM_BOX, size=[s / 2 for s in size], pos=middle, mass=0
        )
    fork = body.add_body(name=f"{name}_fork", pos=(half, 0, 0))
    fork.mass, fork.inertia, fork.ipos, fork.explicitinertial = bicycle.fork_kg, (0.06, 0.06, 0.02), (0, 0, 0), True
    most = bicycle.steering_deg + 1
    fork.add_joint(
        name=f"{name}_steer", type=hinge, axis=bicycle.steering_axis, pos=(-bicycle.axes_ahead_m, 0, 0),
        range=(-most, most), armature=0.02,
    )  # fmt: skip
    for corner, owner, at in (("f", fork, (0.0, 0.0, 0.0)), ("r", body, (-half, 0.0, 0.0))):
        _wheel(spec, owner, bicycle, name, corner, at)
    servo = spec.add_actuator(name=f"{name}_steer_f", target=f"{name}_steer", trntype=joint)
    servo.set_to_position(kp=4_000, kv=40)
    motor = spec.add_actuator(name=f"{name}_drive", target=f"{name}_r_axle", trntype=joint)
    motor.set_to_motor()
    motor.ctrllimited = mujoco.mjtLimited.mjLIMITED_TRUE
    motor.ctrlrange = (-bicycle.drive_n_m, bicycle.drive_n_m)
    for corner in bicycle.corners:
        brake = spec.add_actuator(name=f"{name}_brake_{corner}", target=f"{name}_{corner}_axle", trntype=joint)
        brake.set_to_damper(kv=BRAKE_GAIN * bicycle.brake_n_m)
        brake.ctrllimited, brake.ctrlrange = mujoco.mjtLimited.mjLIMITED_TRUE, (0, 1)
        brake.forcelimited = mujoco.mjtLimited.mjLIMITED_TRUE
        brake.forcerange = (-bicycle.brake_n_m, bicycle.brake_n_m)
    return body


def _solids(
    bicycle: Bicycle,
) -> tuple[tuple[str, tuple[float, float, float], tuple[float, float, float]], ...]:
    """What collides of frame and rider, boxes: (name, full extents, centre from the ground), m."""
    long, wide, high = bicycle.length_m, bicycle.width_m, bicycle.height_m
    seat = bicycle.seat_m
    return (
        ("frame", (long, 0.05, 0.06), (0, 0, 2.15 * bicycle.wheel_radius_m)),
        ("bars", (0.1, wide, 0.04), (0.34 * bicycle.wheelbase_m, 0, 1.0)),
        ("rider", (0.35, 0.42, high - seat), (-0.1, 0, (high + seat) / 2)),
    )


def _wheel(
    spec: "mujoco.MjSpec",
    owner: "mujoco.MjsBody",
    bicycle: Bicycle,
    name: str,
    corner: str,
    at: tuple[float, float, float],
) -> None:
    import mujoco

    from .. import contacts

    radius, mass, load = bicycle.wheel_radius_m, bicycle.wheel_kg, bicycle.mass_kg * G
    wheel = owner.add_body(name=f"{name}_{corner}_wheel", pos=at)
    axle = wheel.add_joint(name=f"{name}_{corner}_axle", type=mujoco.mjtJoint.mjJNT_HINGE, axis=(0, 1, 0))
    share = bicycle.front_share if corner == "f" else 1 - bicycle.front_share
    axle.frictionloss = bicycle.rolling_resistance * load * share * radius
    wheel.add_geom(
        name=f"{name}_{corner}_wheel", type=mujoco.mjtGeom.mjGEOM_ELLIPSOID, size=(radius, bicycle.tyre_width_m / 2, radius),
        mass=mass, **{**contacts.surface(friction=bicycle.tyre_friction), "condim": 3},
    )  # fmt: skip
    wheel.mass, wheel.ipos, wheel.explicitinertial = mass, (0, 0, 0), True
    wheel.inertia = (0.4 * mass * radius**2, bicycle.spin_inertia(), 0.4 * mass * radius**2)
    for part in {name, f"{name}_fork"} - {owner.name}:
        spec.add_exclude(bodyname1=part, bodyname2=f"{name}_{corner}_wheel")


def balanced(bicycle: Bicycle, data: "mujoco.MjData", name: str, steering_deg: float) -> float:
    """The angle that the rider steers in this state, rad, who wants to ride the circle of `steering_deg`."""
    from math import atan, cos, radians, sin, tan

    import numpy as np

    turned = data.body(name).xmat.reshape(3, 3)
    forward = turned[:, 0]
    lean = -float(np.arcsin(np.clip(turned[2, 1], -1, 1)))
    motion = data.joint(name).qvel
    speed = max(abs(float(motion[:3] @ forward)), SLOWEST_M_S)
    lean_rate = -float(motion[3])
    bend = tan(radians(steering_deg)) / bicycle.wheelbase_m
    quick, high = bicycle.quickness_rad_s, bicycle.height_of_mass_m
    # The steered wheel touches the ground to the outside of the frame, so that he leans a little less.
    beside = bicycle.front_share * bicycle.trail_m * bend * bicycle.wheelbase_m
    wanted = atan(speed**2 * bend / G - beside / high)
    asked = speed**2 * bend + (G + high * quick**2) * (lean - wanted) + 2 * high * quick * lean_rate
    ground, tilt = bicycle.wheelbase_m / speed**2 * asked, radians(bicycle.head_deg)
    angle = atan(ground * cos(lean) / max(cos(tilt) + ground * sin(tilt) * sin(lean), 0.1))
    most = radians(bicycle.steering_deg)
    return min(max(angle, -most), most)

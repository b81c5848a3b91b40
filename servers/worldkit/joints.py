"""Joints, described in world coordinates at the initial pose.

MuJoCo wants anchors and axes in the child body's own frame; plans and people think in the world's. A joint here is a
small description that `worldkit.bodies` attaches to the body it creates:

>>> hinge = Hinge("pivot", anchor=(0, 0, 2), axis=(0, 1, 0), damping=0.01)
>>> hinge.anchor
(0, 0, 2)
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco

Vec3 = tuple[float, float, float]


@dataclass(frozen=True)
class Hinge:
    """Rotation about `axis` through `anchor`; range in degrees, stiffness N·m/rad, damping N·m·s/rad, loss N·m.

    How its range stops it: `stop_s`, the time constant in s (longer is softer; None: MuJoCo's 0.02), and `stop_restitution`, the
    ratio of the speeds after and before (None: it hardly rebounds).
    """

    name: str
    anchor: Vec3 | None = None
    axis: Vec3 = (0.0, 0.0, 1.0)
    range_deg: tuple[float, float] | None = None
    stiffness: float = 0.0
    damping: float = 0.0
    frictionloss: float = 0.0
    rest_deg: float = 0.0
    stop_s: float | None = None
    stop_restitution: float | None = None


@dataclass(frozen=True)
class Slide:
    """Translation along `axis`; range in metres, stiffness N/m, damping N·s/m, loss N; its stop as of a `Hinge`."""

    name: str
    anchor: Vec3 | None = None
    axis: Vec3 = (0.0, 0.0, 1.0)
    range_m: tuple[float, float] | None = None
    stiffness: float = 0.0
    damping: float = 0.0
    frictionloss: float = 0.0
    rest_m: float = 0.0
    stop_s: float | None = None
    stop_restitution: float | None = None


@dataclass(frozen=True)
class Ball:
    """Free rotation about `anchor`; damping in N·m·s/rad."""

    name: str
    anchor: Vec3 | None = None
    damping: float = 0.0


Joint = Hinge | Slide | Ball


def attach(body: "mujoco.MjsBody", joint: Joint) -> "mujoco.MjsJoint":
    """Add `joint` to `body`, turning its world-frame anchor and axis into the body's frame.

    Source: MuJoCo manual, XML reference, `body/joint` (`pos` and `axis` are local to the body that owns the joint;
    `stiffness` and `damping` are polynomials since 4.0, of which these set the linear term).
    """
    import math

    import mujoco
    import numpy as np

    from .poses import world_pose

    origin, rotation = world_pose(body)
    anchor = origin if joint.anchor is None else np.asarray(joint.anchor, dtype=float)
    local = rotation.T @ (anchor - origin)
    if isinstance(joint, Ball):
        made = body.add_joint(name=joint.name, type=mujoco.mjtJoint.mjJNT_BALL, pos=local)
        made.damping[0] = joint.damping
        return made
    axis = rotation.T @ np.asarray(joint.axis, dtype=float)
    kind = mujoco.mjtJoint.mjJNT_HINGE if isinstance(joint, Hinge) else mujoco.mjtJoint.mjJNT_SLIDE
    made = body.add_joint(name=joint.name, type=kind, pos=local, axis=axis, frictionloss=joint.frictionloss)
    made.stiffness[0] = joint.stiffness
    made.damping[0] = joint.damping
    # Angles in an MjSpec are read in the compiler's unit, degrees by default.
    degrees = bool(body.compiler.degree)
    limits = joint.range_deg if isinstance(joint, Hinge) else joint.range_m
    rest = joint.rest_deg if isinstance(joint, Hinge) else joint.rest_m
    if isinstance(joint, Hinge) and not degrees:
        limits = None if limits is None else (math.radians(limits[0]), math.radians(limits[1]))
        rest = math.radians(rest)
    if limits is not None:
        made.limited = mujoco.mjtLimited.mjLIMITED_TRUE
        made.range = limits
        _stop(made, joint)
    made.springref = rest
    return made


def _stop(made: "mujoco.MjsJoint", joint: Hinge | Slide) -> None:
    """How the range of a joint stops it: a contact's spring and damper, which see a joint as a contact's normal."""
    from . import contacts

    surface = contacts.surface(restitution=joint.stop_restitution, time_constant=joint.stop_s)
    if "solref" in surface:
        made.solref_limit = surface["solref"]
    if "solimp" in surface:
        made.solimp_limit = surface["solimp"]

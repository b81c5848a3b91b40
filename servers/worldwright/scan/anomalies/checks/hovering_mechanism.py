"""A robot or a vehicle hangs in the air: none of its parts touches anything, and its centre of mass does not fall.

What it means: its ground was taken away, wheels turn that touch nothing, or its root is held or moved by a force that the
model does not have. Motors within a body cannot move its centre of mass.

Formula: a kinematic tree on a free joint, whose actuators all act between its own parts, with no tie, fluid or gravity
compensation: while none of its bodies is in contact, the acceleration of its common centre of mass against gravity.
Threshold: off by a fifth of g for 0.25 s (and all the time, if it is shorter). A warning.
Source: Newton's second law for a system of bodies: internal forces do not move its centre of mass.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import modelled
from ...predicting.joint_coordinates import FREE, fitted
from ..sign import Case, Context, Sign, spans

CODE = "WS144"
NEEDS = ("model", "contact_force_sum")
HELD_S, SHARE = 0.25, 0.2


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the root of each mechanism that hovers."""
    model, force = trajectory.model, trajectory.contact_force_sum
    g = float(np.sqrt((trajectory.gravity**2).sum()))
    if force is None or g == 0 or len(trajectory.t) < 4 or model.nflex or model.ntendon:
        return
    if model.opt.density or model.opt.viscosity or model.body_gravcomp.any() or _outside(model):
        return
    columns = fitted(trajectory).columns
    tied = {int(b) for e in range(model.neq) for b in (model.eq_obj1id[e], model.eq_obj2id[e])}
    for root in range(1, model.nbody):
        first = int(model.body_jntadr[root])
        if model.body_parentid[root] or first < 0 or model.jnt_type[first] != FREE:
            continue
        members = [b for b in range(1, model.nbody) if model.body_rootid[b] == root]
        if len(members) < 2 or tied & set(members) or min(columns[members]) < 0:
            continue
        yield from _hangs(trajectory, columns[members], model.body_mass[members], int(columns[root]), g)


def _outside(model: "modelled.Any") -> bool:
    """Whether an actuator acts on anything but a joint: a thruster at a site, adhesion, a body."""
    joint = 0
    return any(int(model.actuator_trntype[a]) != joint for a in range(model.nu)) or any(
        int(model.actuator_trntype[a]) == joint and int(model.jnt_type[model.actuator_trnid[a, 0]]) == FREE
        for a in range(model.nu)
    )


def _hangs(trajectory: Trajectory, members: np.ndarray, mass: np.ndarray, root: int, g: float) -> Iterator[Sign]:
    assert trajectory.contact_force_sum is not None
    apart = ~(trajectory.contact_force_sum[:, members] > 0).any(axis=1)
    velocity = np.einsum("b,tbi->ti", mass, trajectory.com_velocity[:, members]) / mass.sum()
    rate = np.diff(velocity, axis=0) / np.diff(trajectory.t)[:, None]
    off = np.sqrt(((rate - trajectory.gravity) ** 2).sum(axis=1)) > SHARE * g
    off &= apart[1:] & apart[:-1]
    for start, stop in spans(off, bridge=1):
        seconds = trajectory.t[stop] - trajectory.t[start]
        if seconds < min(HELD_S, 0.9 * trajectory.duration_s):
            continue
        name = trajectory.names[root]
        message = f"{name} with all its parts touches nothing for {seconds:.2g} s, and does not fall"
        yield Sign(name, (trajectory.t[start], trajectory.t[stop]), seconds, HELD_S, "s", "warn", message)
        return


@cache
def _cart() -> Trajectory:
    cart = (
        '<body name="cart" pos="0 0 0.5"><freejoint/><geom type="box" size="0.2 0.1 0.05" mass="1"/>'
        '<body name="wheel" pos="0 0 -0.05"><joint axis="0 1 0"/>'
        '<geom type="cylinder" size="0.1 0.02" euler="90 0 0" mass="0.1"/></body></body>'
    )
    return modelled.run(modelled.scene(cart), 0.8)


def _held() -> Case:
    made = _cart()
    still = np.broadcast_to(made.pos[:1], made.pos.shape).copy()
    nothing = np.zeros_like(made.linvel)
    quat = np.broadcast_to(made.quat[:1], made.quat.shape).copy()
    free = np.zeros_like(made.contact_force_sum)
    hung = replace(made, pos=still, quat=quat, linvel=nothing, angvel=nothing, contact_force_sum=free)
    return Case("a cart that hangs in the air", hung, severity="warn")


GOOD = (lambda: Case("a cart that falls and lands", _cart()),)
BAD = (_held,)

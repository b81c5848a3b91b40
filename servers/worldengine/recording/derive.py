"""Derive quantities from a whole batch of raw engine rows: no loop over steps, bodies or contacts.

N rows, B bodies (without the world), C contacts. Everything is in the world frame.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco
    import numpy as np

PYRAMID_EDGES = 10
"""A pyramid has two edges for each direction but the normal, at most so many."""


def velocity_at(point: "np.ndarray", cvel: "np.ndarray", centre: "np.ndarray") -> "np.ndarray":
    """Linear velocity (…, 3) of body-fixed points, m/s.

    Args:
        point: (…, 3) the points, m.
        cvel: (…, 6) MuJoCo's com-based body velocity: angular, then linear at `centre`.
        centre: (…, 3) centre of mass of the body's whole kinematic tree (`subtree_com` of its root).
    """
    from worldkit.turning import cross

    return cvel[..., 3:] + cross(cvel[..., :3], point - centre)


def contact_forces(
    efc_force: "np.ndarray",
    address: "np.ndarray",
    dim: "np.ndarray",
    friction: "np.ndarray | None",
    frame: "np.ndarray",
) -> tuple["np.ndarray", "np.ndarray"]:
    """Normal force (C,) and world-frame force (C, 3) that each contact puts on its second geom's body, newtons.

    Args:
        efc_force: (K,) constraint forces, the last of which must be zero.
        address: (C,) first row of each contact in `efc_force`, -1 for a contact without force.
        dim: (C,) 1, 3, 4 or 6.
        friction: (C, 5) coefficients when the friction cones are pyramids; None when they are elliptic.
        frame: (C, 9) rows are the normal (from the first geom to the second) and the two tangents.

    Source: MuJoCo manual, "Friction cones"; the same numbers as `mj_contactForce`.
    """
    import numpy as np

    local = np.empty((len(address), 3))
    nothing = len(efc_force) - 1  # the index of the zero
    sliding = (address >= 0) & (dim > 1)
    along = np.where(sliding, address, nothing)
    if friction is None:
        local[:, 0] = efc_force[address]  # -1 finds the zero, too
        for direction in (1, 2):
            local[:, direction] = efc_force[np.where(sliding, along + direction, nothing)]
    else:
        # A pyramid has one force along each of its edges, normal + mu tangent and normal - mu tangent in turn.
        edge = np.stack(
            [efc_force[np.where(sliding & (2 * (dim - 1) > k), along + k, nothing)] for k in range(PYRAMID_EDGES)]
        )
        edge = np.where(sliding, edge, 0.0)
        local[:, 0] = np.where(sliding, edge.sum(axis=0), efc_force[address])
        local[:, 1] = (edge[0] - edge[1]) * friction[:, 0]
        local[:, 2] = (edge[2] - edge[3]) * friction[:, 1]
    return local[:, 0], np.einsum("ci,cij->cj", local, frame.reshape(-1, 3, 3))


def angular_momentum(
    about_reference: "np.ndarray", reference: "np.ndarray", centre: "np.ndarray", momentum: "np.ndarray"
) -> "np.ndarray":
    """Angular momentum (N, 3) about `centre`, from that about `reference` and the linear momentum, kg m^2/s."""
    from worldkit.turning import cross

    return about_reference - cross(centre - reference, momentum)


def tension(model: "mujoco.MjModel", length: "np.ndarray", velocity: "np.ndarray", limit: "np.ndarray") -> "np.ndarray":
    """Tension (N rows, tendons), in newtons, of each tendon by its spring, damper and limit; positive when it pulls.

    Args:
        model: gives stiffness, damping and rest lengths.
        length, velocity: (N, tendons) of the tendons, m and m/s.
        limit: (N, tendons) force of the limit, N.

    Source: MuJoCo manual, "Polynomial forces": a spring's force is a x + b x^2 + c x^3 of its stretch x, which is 0
    within the range of its rest lengths.
    """
    import numpy as np

    if not model.ntendon:
        return np.zeros((len(length), 0))
    low, high = model.tendon_lengthspring.reshape(-1, 2).T
    stretch = length - np.clip(length, low, high)

    def polynomial(first: "np.ndarray", others: "np.ndarray", x: "np.ndarray") -> "np.ndarray":
        total = first * x
        for power, coefficient in enumerate(others.reshape(len(first), -1).T, start=2):
            total = total + coefficient * x**power
        return np.asarray(total)

    spring = polynomial(model.tendon_stiffness, model.tendon_stiffnesspoly, stretch)
    damper = polynomial(model.tendon_damping, model.tendon_dampingpoly, velocity)
    too_long = length > model.tendon_range.reshape(-1, 2).mean(axis=1)
    return spring + damper + np.where(too_long, limit, -limit)

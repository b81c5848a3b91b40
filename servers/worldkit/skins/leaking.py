"""A hole in a skin: what leaves by it as through an orifice, and how its jet pushes back.

Q = C A sqrt(2 p / rho), of the outside's density (Bernoulli; C of a sharp edge 0.6, ISO 5167); the jet carries the momentum
rho Q^2 / (C A) = 2 C A p away. The hole is no hole of the mesh: it weighs what it did, and nothing shuts it.
"""

import numpy as np

from ..errors import ProgramError
from .gas_and_wall import GAS, Gas

Array = np.ndarray
AIR = 0.0289647
"""kg/mol."""


def held(gas: Gas, triangles: Array, name: str) -> None:
    """Hold what is told of the hole against the skin called `name`.

    Raises:
        ProgramError: no hole can be so, or it is at no point of the skin.
    """
    corners = np.unique(triangles)
    if not 0 <= gas.hole < np.inf:
        cause, move = f"a hole of {gas.hole} m", "`hole` is its diameter, m; 0: none"
    elif not 0 < gas.discharge <= 1:
        cause, move = f"a `discharge` of {gas.discharge}", "give it from 0 to 1: 0.6 of a sharp edge"
    elif gas.hole and not (float(gas.hole_at).is_integer() and int(gas.hole_at) in corners):
        cause, move = (
            f"a hole at the point {gas.hole_at}, where no triangle is",
            f"`hole_at` is one of its {len(corners)} points",
        )
    else:
        return
    raise ProgramError(f"the skin {name} has {cause}", name, move)


def opening(gas: Gas) -> float:
    """m^2 that the jet is wide."""
    return float(np.pi / 4 * gas.hole**2 * gas.discharge)


def lost(gas: Gas, over: tuple[float, float], dry: float, moles: float, time: float, h: float) -> float:
    """mol that leave in a step of `h` s, at `over` Pa above the outside at its begin and, had nothing left, at its end.

    By the mean, less half of what leaving takes of the pressure: the root of lost = h k sqrt(mean - dry lost / (2 moles)), as a wide
    hole's speed is known only together with it. Never more than lets the gas down to the outside's pressure. `dry` Pa is the gas's own.
    """
    warmth = GAS * gas.temperature(time)
    most = moles * max(over[1], 0.0) / dry
    widest = (h * opening(gas) * gas.outside / warmth) ** 2 * 2.0 * warmth / (gas.outside * AIR)  # mol^2/Pa
    half, whole = widest * dry / (2 * moles), widest * max(sum(over) / 2, 0.0)
    return min((float(np.sqrt(half**2 + 4 * whole)) - half) / 2, most)


def jet(gas: Gas, points: Array, triangles: Array, over: float) -> Array:
    """(n, 3) N on the points (n, 3), m: 2 C A times the pressure, on the triangles around the hole, inwards."""
    found = np.zeros_like(points)
    if gas.hole and over > 0:
        around = triangles[(triangles == gas.hole_at).any(axis=1)]
        a, b, c = points[around].transpose(1, 0, 2)
        out = np.cross(b - a, c - a).sum(axis=0)
        at, share = np.unique(around, return_counts=True)
        push = -2.0 * opening(gas) * over * out / max(float(np.linalg.norm(out)), 1e-12)
        found[at] = share[:, None] / share.sum() * push
    return found

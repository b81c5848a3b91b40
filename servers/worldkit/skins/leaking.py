"""A hole in a skin: what leaves by it as through an orifice, and how its jet pushes back.

Q = C A sqrt(2 p / rho), of the outside's density (Bernoulli; C of a sharp edge 0.6, ISO 5167); the jet carries the momentum
rho Q^2 / (C A) = 2 C A p away. The hole is no hole of the mesh: it weighs what it did, and nothing shuts it.
"""

import numpy as np

from .gas_and_wall import GAS, Gas

Array = np.ndarray
AIR = 0.0289647
"""kg/mol."""


def opening(gas: Gas) -> float:
    """m^2 that the jet is wide."""
    return float(np.pi / 4 * gas.hole**2 * gas.discharge)


def leaves(gas: Gas, over: float, time: float) -> float:
    """mol/s that leave at `over` Pa above the outside."""
    warmth = GAS * gas.temperature(time)
    density = gas.outside * AIR / warmth
    return opening(gas) * float(np.sqrt(2.0 * max(over, 0.0) / density)) * gas.outside / warmth


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

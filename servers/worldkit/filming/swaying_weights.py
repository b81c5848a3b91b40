"""How far a breeze carries what a film draws: for each corner a weight, m, in a fresh breeze of 8 m/s, and a phase, radians."""

import numpy as np

BLADE = np.array([0.0, 0.0, 0.28, 0.28, 1.0])
"""The corners of a blade of grass: its foot, its middle and its tip."""
BENDS = 0.4
"""So far goes the tip of a blade, as a share of its height."""
CROWN = 0.022
"""So far goes the top of a tree, as a share of its height."""


def of_grass(points: np.ndarray) -> np.ndarray:
    """(V, 2) of blades of grass, five corners each."""
    blades = points.reshape(-1, 5, 3)
    tall = blades[:, 4, 2] - blades[:, 0, 2]
    return _joined(BENDS * tall[:, None] * BLADE, _scattered(blades[:, 0])[:, None] * np.ones(5))


def of_wood(points: np.ndarray, height: float) -> np.ndarray:
    """(V, 2) of a tree's wood, its foot at the origin: it bends the more, the higher."""
    return _joined(_bend(points, height), np.zeros(len(points)))


def of_leaves(points: np.ndarray, height: float) -> np.ndarray:
    """(V, 2) of a tree's leaves, four corners each: they go with their twig, and each a little for itself."""
    feet = points.reshape(-1, 4, 3)[:, 0]
    weight = np.repeat(_bend(feet, height) + 0.004 * height, 4)
    return _joined(weight, np.repeat(0.7 * (_scattered(feet * 7.0) - np.pi), 4))


def _bend(points: np.ndarray, height: float) -> np.ndarray:
    return CROWN * height * np.clip(points[:, 2] / height, 0.0, 1.2) ** 1.6


def _scattered(places: np.ndarray) -> np.ndarray:
    """An angle, radians, for each of some places (N, 3)."""
    return 2 * np.pi * (np.sin(places @ np.array([12.9898, 78.233, 37.719])) * 43758.5453 % 1.0)


def _joined(weight: np.ndarray, phase: np.ndarray) -> np.ndarray:
    return np.stack([weight.ravel(), phase.ravel()], axis=1)

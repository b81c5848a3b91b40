"""How grass is lit: a sward scatters light among its blades, so a blade is about as bright as level ground, and a little as it stands."""

import numpy as np

UPRIGHT = 0.62
"""So much of a blade's normal is that of level ground."""


def of(points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Unit normals (V, 3) of the corners (V, 3), m, of blades with triangles (F, 3); all of them face upwards."""
    own = np.zeros((len(points), 3))
    corners = points[faces]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    for corner in range(3):
        np.add.at(own, faces[:, corner], flat)
    own /= np.maximum(np.linalg.norm(own, axis=1, keepdims=True), 1e-12)
    own *= np.where(own[:, 2:] < 0, -1.0, 1.0)
    found = (1 - UPRIGHT) * own + np.array([0.0, 0.0, UPRIGHT])
    return np.asarray(found / np.linalg.norm(found, axis=1, keepdims=True))

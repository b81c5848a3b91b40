"""Crowns of trees and rocks as they are: their relief is no painted shade but stands out of the surface."""

from __future__ import annotations

import numpy as np

from worldkit.materials.look import Look
from worldkit.materials.paint import noise

from .rounded import Mesh, outward, sphere

LEAST_M = 0.012
"""Relief that is at least so deep is made."""
LUMPS = 0.10
"""The size of the large lumps, as a share of the radius."""


def displaced(radii: np.ndarray, look: Look, seed: int, coarse: bool) -> Mesh | None:
    """An ellipsoid with the relief of its look; None where that is too shallow to be made."""
    if look.relief_m < LEAST_M or look.around or look.clear > 0 or radii.min() < 3 * look.relief_m or coarse:
        return None
    mesh = sphere(radii, 160)
    field = noise.unit(noise.spectral(256, 1.6, "relief", low=2.0)).astype(float)
    fine = noise.unit(noise.spectral(256, 0.8, "fine relief", low=6.0)).astype(float)
    weights = np.abs(mesh.normals) ** 4
    weights /= weights.sum(axis=1, keepdims=True)
    shift = np.random.default_rng(seed).random(3) * 7.0

    def solid(picture: np.ndarray, per_metre: float) -> np.ndarray:
        q = mesh.points * per_metre + shift
        total = np.zeros(len(q))
        for axis, (u, v) in enumerate(((1, 2), (0, 2), (0, 1))):
            at = (q[:, [u, v]] % 1.0 * len(picture)).astype(int) % len(picture)
            total += weights[:, axis] * picture[at[:, 1], at[:, 0]]
        return total - 0.5

    radius = float(radii.min())
    high = LUMPS * radius * 2 * solid(field, 0.6 / radius) + 1.6 * look.relief_m * solid(fine, 0.45 / look.tile_m)
    points = mesh.points + mesh.normals * high[:, None]
    mesh = Mesh(points, mesh.normals, mesh.faces, mesh.uv)
    faces = outward(mesh)
    # The seam and the poles have corners of their own at the same places, which must agree.
    _, same = np.unique(np.round(points / radius, 6), axis=0, return_inverse=True)
    across = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    total = np.zeros((same.max() + 1, 3))
    for k in range(3):
        np.add.at(total, same.reshape(-1)[faces[:, k]], across)
    normals = total[same.reshape(-1)]
    return Mesh(points, normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12), faces, None)

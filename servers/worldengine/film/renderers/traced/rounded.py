"""Primitives as meshes whose edges are rounded, as those of all real things are."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from worldkit.forms.lattice import lattice

SHARE, LEAST_M, MOST_M = 0.035, 0.0004, 0.008
"""The radius of an edge, as a share of the smallest half size, lies between these."""
ENDS = np.radians([0.0, 22.5, 45.0])


class Mesh(NamedTuple):
    """`points` (V, 3) m, unit `normals` (V, 3), `faces` (F, 3) counter-clockwise from outside, `uv` (V, 2) if it brings any."""

    points: np.ndarray
    normals: np.ndarray
    faces: np.ndarray
    uv: np.ndarray | None = None


def edge(smallest: float) -> float:
    """The radius of the edges of a thing of this smallest half size, m."""
    return float(min(np.clip(SHARE * smallest, LEAST_M, MOST_M), 0.45 * smallest))


def box(half: np.ndarray, line_m: float = 0.0) -> Mesh:
    """A box of half sizes (3,), with a line of corners so far from each edge, m, if it is not 0."""
    half = np.maximum(np.asarray(half, dtype=float), 1e-6)
    radius = edge(float(half.min()))
    points, normals, faces, used = [], [], [], 0
    away = radius * np.tan(ENDS)
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        lines = []
        for other in (u, v):
            outer = half[other] - radius + away
            inner_line = [half[other] - line_m] if line_m > radius else []
            outer = np.concatenate([inner_line, outer])
            lines.append(np.concatenate([-outer[::-1], outer]))
        a, b = np.meshgrid(*lines, indexing="ij")
        for sign in (1.0, -1.0):
            face = np.empty((a.size, 3))
            face[:, axis], face[:, u], face[:, v] = sign * half[axis], a.ravel(), b.ravel()
            inner = np.clip(face, -(half - radius), half - radius)
            normal = face - inner
            normal /= np.linalg.norm(normal, axis=1, keepdims=True)
            points.append(inner + radius * normal)
            normals.append(normal)
            faces.append(used + lattice(len(lines[0]), len(lines[1])))
            used += len(face)
    found = Mesh(np.concatenate(points), np.concatenate(normals), np.concatenate(faces))
    return found._replace(faces=outward(found))


def outward(mesh: Mesh) -> np.ndarray:
    """The faces of a mesh, each turned to the side that its normals point to."""
    corners = mesh.points[mesh.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    wrong = np.einsum("fk,fk->f", across, mesh.normals[mesh.faces].sum(axis=1)) < 0
    return np.where(wrong[:, None], mesh.faces[:, ::-1], mesh.faces)


def turned(profile: np.ndarray, slopes: np.ndarray, sectors: int) -> Mesh:
    """A profile (N, 2) of radius and height, with its normals (N, 2), turned around z; uv are turn and place along it."""
    phi = np.linspace(0.0, 2.0 * np.pi, sectors + 1)
    c, s = np.cos(phi), np.sin(phi)

    def around(rows: np.ndarray) -> np.ndarray:
        x, y = rows[:, :1] * c, rows[:, :1] * s
        return np.stack([x, y, np.broadcast_to(rows[:, 1:], x.shape)], -1).reshape(-1, 3)

    uv = np.stack(
        np.broadcast_arrays(phi[None] / (2 * np.pi), np.linspace(1.0, 0.0, len(profile))[:, None]), -1
    ).reshape(-1, 2)
    mesh = Mesh(around(profile), around(slopes), lattice(len(profile), sectors + 1), uv)
    return mesh._replace(faces=outward(mesh))


def sphere(radii: np.ndarray, sectors: int = 48) -> Mesh:
    """An ellipsoid of semi-axes (3,); uv are longitude and colatitude over their whole range."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, sectors // 2 + 1)
    profile = np.stack([np.cos(angle), np.sin(angle)], -1)
    unit = turned(profile, profile, sectors)
    radii = np.maximum(np.asarray(radii, dtype=float), 1e-9)
    normals = unit.points / radii
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return unit._replace(points=unit.points * radii, normals=normals)


def cylinder(radius: float, half: float, sectors: int = 56, line_m: float = 0.0) -> Mesh:
    """A cylinder around z, with a line of corners so far from each edge, m, if it is not 0."""
    r = edge(min(radius, half))
    turn = np.radians([0.0, 30.0, 60.0, 90.0])
    rim = np.stack([radius - r + r * np.sin(turn), half - r + r * np.cos(turn)], -1)
    slope = np.stack([np.sin(turn), np.cos(turn)], -1)
    top, slopes = np.concatenate([[[0.0, half]], rim]), np.concatenate([[[0.0, 1.0]], slope])
    if line_m > r:
        top = np.concatenate([top[:1], [[radius - line_m, half]], top[1:], [[radius, half - line_m]]])
        slopes = np.concatenate([slopes[:1], [[0.0, 1.0]], slopes[1:], [[1.0, 0.0]]])
    down = np.array([1.0, -1.0])
    return turned(np.concatenate([top * down, top[::-1]]), np.concatenate([slopes * down, slopes[::-1]]), sectors)


def capsule(radius: float, half: float, sectors: int = 32) -> Mesh:
    """A capsule around z whose straight part has this half length."""
    turn = np.linspace(0.0, np.pi / 2, sectors // 4 + 1)
    slope = np.stack([np.sin(turn), np.cos(turn)], -1)
    top = slope * radius + np.array([0.0, half])
    down = np.array([1.0, -1.0])
    return turned(np.concatenate([top * down, top[::-1]]), np.concatenate([slope * down, slope[::-1]]), sectors)


def sheet(half_x: float, half_y: float) -> Mesh:
    """A rectangle in the plane z = 0 that faces up."""
    x, y = np.array([-half_x, half_x]), np.array([-half_y, half_y])
    a, b = np.meshgrid(x, y, indexing="xy")
    points = np.stack([a.ravel(), b.ravel(), np.zeros(4)], -1)
    normals = np.tile([0.0, 0.0, 1.0], (4, 1))
    mesh = Mesh(points, normals, lattice(2, 2), np.array([[0, 1], [1, 1], [0, 0], [1, 0]], dtype=float))
    return mesh._replace(faces=outward(mesh))

"""Triangle surfaces with texture coordinates, and the OBJ text they become.

Positions, texture coordinates and normals are indexed separately, as OBJ does, so a surface stays watertight across
texture seams and sharp edges. Frame: z up, +X front, metres.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Surface:
    """Triangles wound counter-clockwise seen from outside.

    vertices: (V, 3) metres. faces: (F, 3) into vertices. uv: (T, 2), v up. uv_faces: (F, 3) into uv.
    """

    vertices: np.ndarray
    faces: np.ndarray
    uv: np.ndarray
    uv_faces: np.ndarray

    @staticmethod
    def bare(vertices: np.ndarray, faces: np.ndarray) -> "Surface":
        """A surface whose texture coordinates are all (0, 0); give it real ones with `box_uv` or `with_uv`."""
        faces = np.asarray(faces, int)
        return Surface(np.asarray(vertices, float), faces, np.zeros((1, 2)), np.zeros_like(faces))

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> "Surface":
        """Translated, metres."""
        return self.mapped(self.vertices + (x, y, z))

    def turned(self, axis: str, deg: float) -> "Surface":
        """Rotated about a world axis through the origin, degrees counter-clockwise."""
        return self.mapped(self.vertices @ rotation(axis, deg).T)

    def mirrored(self, axis: str) -> "Surface":
        """Reflected across the plane normal to `axis` through the origin."""
        sign = np.ones(3)
        sign["xyz".index(axis)] = -1
        return Surface(self.vertices * sign, self.faces[:, ::-1], self.uv, self.uv_faces[:, ::-1])

    def mapped(self, vertices: np.ndarray) -> "Surface":
        """The same triangles through other positions (V, 3)."""
        return Surface(np.asarray(vertices, float), self.faces, self.uv, self.uv_faces)

    def box_uv(self, tile_m: float, grain: str = "x", offset: tuple[float, float] = (0.0, 0.0)) -> "Surface":
        """Texture coordinates by projection along each face's main axis; one texture spans `tile_m` metres.

        `grain` is the world axis that the texture's u runs along (where a face is normal to it, u runs along the next axis).
        """
        corners = self.vertices[self.faces]
        main = np.abs(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])).argmax(axis=1)
        g = "xyz".index(grain)
        u_axis = np.where(main == g, (g + 1) % 3, g)
        v_axis = 3 - main - u_axis
        take = np.arange(len(corners))[:, None], np.arange(3)[None, :]
        uv = np.stack([corners[(*take, u_axis[:, None])], corners[(*take, v_axis[:, None])]], axis=-1)
        return self.with_uv(uv.reshape(-1, 2) / tile_m + offset)

    def with_uv(self, per_corner: np.ndarray) -> "Surface":
        """With texture coordinates given per face corner, (3 F, 2)."""
        uv, index = np.unique(np.round(per_corner, 5), axis=0, return_inverse=True)
        return Surface(self.vertices, self.faces, uv, index.reshape(-1, 3))

    def corners(self) -> np.ndarray:
        """Positions per face corner, (3 F, 3)."""
        return self.vertices[self.faces].reshape(-1, 3)


def join(surfaces: list[Surface]) -> Surface:
    """Several surfaces as one (nothing is welded)."""
    at_v = np.cumsum([0] + [len(s.vertices) for s in surfaces])
    at_t = np.cumsum([0] + [len(s.uv) for s in surfaces])
    return Surface(
        np.concatenate([s.vertices for s in surfaces]),
        np.concatenate([s.faces + o for s, o in zip(surfaces, at_v, strict=False)]),
        np.concatenate([s.uv for s in surfaces]),
        np.concatenate([s.uv_faces + o for s, o in zip(surfaces, at_t, strict=False)]),
    )


def rotation(axis: str, deg: float) -> np.ndarray:
    """The (3, 3) rotation about a world axis, degrees counter-clockwise."""
    c, s = np.cos(np.radians(deg)), np.sin(np.radians(deg))
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix = np.eye(3)
    matrix[i, i] = matrix[j, j] = c
    matrix[i, j], matrix[j, i] = -s, s
    return matrix


def corner_normals(surface: Surface, crease_deg: float) -> np.ndarray:
    """Unit normals per face corner (F, 3, 3): the area-weighted mean of the faces around within the crease angle."""
    corners = surface.vertices[surface.faces]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    unit = area / np.maximum(np.linalg.norm(area, axis=1, keepdims=True), 1e-30)
    _, welded = np.unique(np.round(surface.vertices, 7), axis=0, return_inverse=True)
    at = welded[surface.faces].ravel()
    order = np.argsort(at, kind="stable")
    starts = np.flatnonzero(np.r_[True, np.diff(at[order]) > 0])
    normals = np.empty((len(at), 3))
    limit = np.cos(np.radians(crease_deg))
    for corner in np.split(order, starts[1:]):
        face = corner // 3
        near = unit[face] @ unit[face].T >= limit
        normals[corner] = near @ area[face]
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    return normals.reshape(-1, 3, 3)


def obj_text(surface: Surface, crease_deg: float = 40.0) -> str:
    """The surface as OBJ with texture coordinates and normals."""
    normals = corner_normals(surface, crease_deg)
    vn, vn_index = np.unique(np.round(normals.reshape(-1, 3), 3) + 0.0, axis=0, return_inverse=True)
    vn_faces = vn_index.reshape(-1, 3) + 1
    lines = [f"v {_number(x, 5)} {_number(y, 5)} {_number(z, 5)}" for x, y, z in surface.vertices]
    lines += [f"vt {_number(u, 4)} {_number(v, 4)}" for u, v in surface.uv]
    lines += [f"vn {_number(x, 3)} {_number(y, 3)} {_number(z, 3)}" for x, y, z in vn]
    for f, t, n in zip(surface.faces + 1, surface.uv_faces + 1, vn_faces, strict=True):
        lines.append("f " + " ".join(f"{a}/{b}/{c}" for a, b, c in zip(f, t, n, strict=True)))
    return "\n".join(lines) + "\n"


def hull_text(vertices: np.ndarray, faces: np.ndarray) -> str:
    """A bare convex piece as OBJ."""
    lines = [f"v {_number(x, 5)} {_number(y, 5)} {_number(z, 5)}" for x, y, z in vertices]
    lines += [f"f {a} {b} {c}" for a, b, c in np.asarray(faces) + 1]
    return "\n".join(lines) + "\n"


def _number(value: float, digits: int) -> str:
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text

"""What a film draws that sways, in the way of a ray: tested where the breeze carries it, as both renderers draw it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from . import swaying

if TYPE_CHECKING:
    import mujoco

ASIDE_GROUP = 5
"""The group that a ray does not meet."""


SOME = 2000
"""So many corners of a mesh, taken by chance, tell how far all of it goes in the picture."""
BEYOND = 1.3
"""Gusts and flutter carry a corner so many times as far as its weight says, at most."""


class Swaying:
    """The meshes of a dressed model that sway, with their corners' weights and phases.

    Moving all blades of a meadow takes longer than anything else that is asked of a frame, so a mesh is moved only when a ray
    meets the box that the breeze cannot carry it out of.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self.model = model
        self.geoms = np.array(sorted(swaying.geoms(model)), dtype=int)
        self._group = np.array(model.geom_group[self.geoms])
        self._parts: dict[int, tuple[np.ndarray, np.ndarray, np.ndarray]] = {}
        self._placed: dict[int, np.ndarray] = {}
        self._blown: tuple[mujoco.MjData, tuple[float, float, float]] | None = None

    def __enter__(self) -> Swaying:
        """Let MuJoCo's rays, which know the meshes only in calm air, pass them."""
        self.model.geom_group[self.geoms] = ASIDE_GROUP
        return self

    def __exit__(self, *_: object) -> None:
        self.model.geom_group[self.geoms] = self._group

    def blow(self, data: mujoco.MjData, breeze: tuple[float, float, float]) -> None:
        """Let them be where they are in `data`, in a wind towards x and y, m/s, at a time, s."""
        self._placed, self._blown = {}, (data, breeze)

    def some(self, data: mujoco.MjData, breeze: tuple[float, float, float] | None) -> np.ndarray:
        """Corners (P, 3), m, of what sways where a wind, as in `blow`, has carried them: as many of each mesh as tell how it goes."""
        found = [np.zeros((0, 3))]
        for geom in self.geoms:
            if breeze is None:
                break
            mesh = int(self.model.geom_dataid[geom])
            first, count = self.model.mesh_faceadr[mesh], self.model.mesh_facenum[mesh]
            face, corner = np.random.default_rng(0).integers((count, 3), size=(SOME, 2)).T
            vertex = self.model.mesh_vertadr[mesh] + self.model.mesh_face[first + face, corner]
            told = self.model.mesh_texcoord[
                self.model.mesh_texcoordadr[mesh] + self.model.mesh_facetexcoord[first + face, corner]
            ]
            there = self.model.mesh_vert[vertex] @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]
            found.append(there + swaying.swayed(there, told[:, 0], told[:, 1], breeze))
        return np.concatenate(found)

    def _there(self, geom: int, eye: np.ndarray, way: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
        """A mesh's corners (C, 3), m, where the breeze has carried them, and its faces; None where a ray does not come near it."""
        assert self._blown is not None
        data, breeze = self._blown
        if geom not in self._parts:
            self._parts[geom] = _corners(self.model, geom)
        points, told, faces = self._parts[geom]
        turn = data.geom_xmat[geom].reshape(3, 3)
        start, along = (eye - data.geom_xpos[geom]) @ turn, way @ turn
        reach = BEYOND * swaying.MOST * float(np.abs(told[:, 0]).max(initial=0.0))
        middle, half = self.model.geom_aabb[geom, :3], self.model.geom_aabb[geom, 3:] + reach
        with np.errstate(divide="ignore", invalid="ignore"):
            ends = np.stack([(middle - half - start) / along, (middle + half - start) / along])
        enters, leaves = np.nanmax(ends.min(axis=0)), np.nanmin(ends.max(axis=0))
        if enters > leaves or leaves < 0:
            return None
        if geom not in self._placed:
            there = points @ turn.T + data.geom_xpos[geom]
            self._placed[geom] = there + swaying.swayed(there, told[:, 0], told[:, 1], breeze)
        return self._placed[geom], faces

    def nearest(self, eye: np.ndarray, way: np.ndarray, away: float) -> tuple[float, int]:
        """How far from `eye` (3,) along `way` (3,), of length 1, the nearest stands, m, and its geom; (`away`, -1) if none does."""
        one = np.cross(way, (1.0, 0.0, 0.0) if abs(way[0]) < 0.9 else (0.0, 1.0, 0.0))
        one /= np.linalg.norm(one)
        basis = np.stack([one, np.cross(way, one), way])
        found, owner = away, -1
        for geom in self.geoms if self._blown is not None else ():
            met_there = self._there(int(geom), eye, way)
            if met_there is None:
                continue
            points, faces = met_there
            flat = (points - eye) @ basis.T  # as the ray sees them: it runs along the third axis
            a, b, c = (flat[faces[:, k]] for k in range(3))
            shares = np.stack([_cross(b, c), _cross(c, a), _cross(a, b)], axis=1)
            met = (shares >= 0).all(axis=1) | (shares <= 0).all(axis=1)
            total = shares.sum(axis=1)
            met &= np.abs(total) > 1e-18
            if not met.any():
                continue
            depth = (shares[met] * np.stack([a[met, 2], b[met, 2], c[met, 2]], axis=1)).sum(axis=1) / total[met]
            depth = depth[depth > 0]
            if len(depth) and depth.min() < found:
                found, owner = float(depth.min()), int(geom)
        return found, owner


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    product: np.ndarray = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return product


def _corners(model: mujoco.MjModel, geom: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A mesh's corners (C, 3), m, in the geom's frame, their weights, m, and phases (C, 2), and its faces (F, 3)."""
    mesh = int(model.geom_dataid[geom])
    chosen = slice(model.mesh_faceadr[mesh], model.mesh_faceadr[mesh] + model.mesh_facenum[mesh])
    faces, coords = model.mesh_face[chosen].astype(int), model.mesh_facetexcoord[chosen].astype(int)
    pairs, back = np.unique(np.stack([faces.ravel(), coords.ravel()], axis=1), axis=0, return_inverse=True)
    points = model.mesh_vert[model.mesh_vertadr[mesh] + pairs[:, 0]].astype(float)
    told = model.mesh_texcoord[model.mesh_texcoordadr[mesh] + pairs[:, 1]].astype(float)
    return points, told, back.reshape(-1, 3)

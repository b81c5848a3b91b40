"""Meshes without normals have hard edges where faces meet steeply; those that bring normals keep them."""

import mujoco
import numpy as np
import pytest

from worldengine.film.renderers.preview import hard_edges, unit_shapes

BLOCK = np.array([(x, y, z) for x in (-1, 1) for y in (-0.6, 0.6) for z in (0, 0.3)], float)


def compiled(**mesh):
    spec = mujoco.MjSpec()
    spec.add_mesh(name="m", **mesh)
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="m")
    return spec.compile()


def ball():
    points = np.random.default_rng(4).normal(size=(900, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def flatness(model):
    """For each face of what is drawn, how far its corners' normals are from its own, degrees at most."""
    corner, faces = unit_shapes.mesh(model, 0)
    p, n = corner[faces][:, :, :3].astype(float), corner[faces][:, :, 4:7]
    flat = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    return np.degrees(np.arccos(np.clip(np.einsum("fkj,fj->fk", n, flat), -1, 1))).max(axis=1)


@pytest.mark.parametrize("smooth", [False, True])
def test_a_block_without_normals_has_flat_sides(smooth):
    model = compiled(uservert=BLOCK.ravel(), smoothnormal=smooth)
    assert hard_edges.brings_none(model, 0)
    assert flatness(model).max() < 0.1


def test_a_fine_ball_without_normals_stays_smooth():
    model = compiled(uservert=ball().ravel())
    assert hard_edges.brings_none(model, 0)
    corner, _ = unit_shapes.mesh(model, 0)
    assert len(corner) == model.mesh_vertnum[0]  # one normal for each vertex
    radial = corner[:, :3] / np.linalg.norm(corner[:, :3], axis=1, keepdims=True)
    assert (np.einsum("ij,ij->i", radial, corner[:, 4:7]) > 0.97).all()


def test_normals_that_a_mesh_brings_are_kept():
    round_normals = (BLOCK - BLOCK.mean(axis=0)) / np.linalg.norm(BLOCK - BLOCK.mean(axis=0), axis=1, keepdims=True)
    faces = np.array([(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)])  # fmt: skip
    model = compiled(uservert=BLOCK.ravel(), userface=faces.ravel(), usernormal=round_normals.ravel())
    assert not hard_edges.brings_none(model, 0)
    assert flatness(model).max() > 30

"""Sheets in traced pictures: both of their sides take light, whichever way they are wound."""

import mujoco
import numpy as np
import pytest

from worldengine.film.drawn_frames import Frames
from worldengine.film.renderers.traced import rounded, two_sides
from worldengine.film.renderers.traced.rounded import Mesh
from worldkit import scene
from worldkit.forms.lattice import lattice

SIDE = 9


def waving() -> tuple[np.ndarray, np.ndarray]:
    """A flag 1 m wide and high, in the plane y = 0 but for its waves."""
    x, z = np.meshgrid(np.linspace(-0.5, 0.5, SIDE), np.linspace(0.0, 1.0, SIDE))
    return np.stack([x, 0.04 * np.sin(7 * x), z], -1).reshape(-1, 3), lattice(SIDE, SIDE)


def flag(both: bool) -> Mesh:
    points, faces = waving()
    normals = np.stack([0.28 * np.cos(7 * points[:, 0]), -np.ones(len(points)), np.zeros(len(points))], -1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return Mesh(points, normals, np.concatenate([faces, faces[:, ::-1]]) if both else faces, points[:, [0, 2]])


@pytest.mark.parametrize("both", [False, True], ids=["wound once", "wound both ways"])
def test_a_sheet_has_a_front_and_a_back_that_face_away_from_each_other(both) -> None:
    sheet = flag(both)
    mesh, origin = two_sides.two_sided(sheet)
    assert len(mesh.faces) == 2 * (SIDE - 1) ** 2 * 2 and len(mesh.points) == 2 * SIDE**2
    corners = mesh.points[mesh.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (np.einsum("fk,fck->fc", across, mesh.normals[mesh.faces]) > 0).all()
    off = np.einsum("vk,vk->v", mesh.points - sheet.points[origin], mesh.normals)
    assert off.min() == pytest.approx(off.max()) and 0 < off.max() < 0.001
    assert mesh.uv is not None and sheet.uv is not None and np.array_equal(mesh.uv, sheet.uv[origin])


def test_what_is_closed_stays_as_it_is_and_a_sheet_beside_it_does_not() -> None:
    ball, sheet = rounded.sphere(np.array([0.2, 0.1, 0.3])), flag(False)
    assert two_sides.two_sided(ball).mesh is ball
    points = np.concatenate([ball.points + np.array([2, 0, 0]), sheet.points])
    both = Mesh(
        points,
        np.concatenate([ball.normals, sheet.normals]),
        np.concatenate([ball.faces, sheet.faces + len(ball.points)]),
    )
    mesh, origin = two_sides.two_sided(both)
    assert len(mesh.faces) == len(ball.faces) + 2 * len(sheet.faces)
    of_ball = origin < len(ball.points)
    assert np.array_equal(mesh.points[of_ball], points[origin[of_ball]])


@pytest.mark.gl
def test_a_flag_is_evenly_lit_from_both_sides_however_it_is_wound() -> None:
    spec = scene.new("flags", time_step=0.002, setting="studio")
    points, faces = waving()
    windings = (np.concatenate([faces, faces[:, ::-1]]), faces[:, ::-1])  # one seen from behind
    for number, wound in enumerate(windings):
        mesh = spec.add_mesh(
            name=f"flag{number}",
            uservert=points.ravel(),
            userface=wound.ravel(),
            inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
        )
        body = spec.worldbody.add_body(pos=(1.2 * number - 0.6, 0, 0.1))
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_MESH, meshname=mesh.name, rgba=(0.8, 0.8, 0.8, 1), contype=0, conaffinity=0
        )
    spec.worldbody.add_camera(name="eye", pos=(0, -3, 0.6), xyaxes=(1, 0, 0, 0, 0, 1), fovy=24)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with Frames(model, 96, 54, "traced") as frames:
        image = frames.image(data, "eye", 4).mean(axis=2)
        assert frames.renderer == "traced", frames.reason
    for columns in (slice(6, 40), slice(56, 90)):
        light = image[10:44, columns]
        assert light.min() > 0.72 * np.median(light) > 60

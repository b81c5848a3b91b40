"""Closed surfaces that are wound inside out are turned; the hollow of a vessel is not, nor a sheet."""

import mujoco
import numpy as np
import pytest

from worldengine.film.drawn_frames import Frames
from worldengine.film.renderers.traced import rounded
from worldengine.film.renderers.traced.inside_out import outward
from worldengine.film.renderers.traced.rounded import Mesh
from worldkit import scene

BALL = rounded.sphere(np.array([0.2, 0.1, 0.3]))


def turned(mesh: Mesh) -> Mesh:
    return mesh._replace(normals=-mesh.normals, faces=mesh.faces[:, ::-1])


def moved(mesh: Mesh, by: float, size: float = 1.0) -> Mesh:
    return mesh._replace(points=size * mesh.points + (by, 0.0, 0.0))


def together(*meshes: Mesh) -> Mesh:
    first = np.cumsum([0, *(len(mesh.points) for mesh in meshes)])
    faces = [mesh.faces + at for mesh, at in zip(meshes, first[:-1], strict=True)]
    parts = ([getattr(mesh, name) for mesh in meshes] for name in ("points", "normals"))
    return Mesh(*(np.concatenate(part) for part in parts), np.concatenate(faces))


VESSEL = together(BALL, turned(moved(BALL, 0.0, 0.8)))


@pytest.mark.parametrize(
    ("given", "wanted"),
    [
        (turned(BALL), BALL),
        (turned(VESSEL), VESSEL),
        (together(BALL, turned(moved(BALL, 1.0))), together(BALL, moved(BALL, 1.0))),
        (
            together(turned(BALL), turned(moved(BALL, 1.0)), moved(BALL, 2.0)),
            together(BALL, moved(BALL, 1.0), moved(BALL, 2.0)),
        ),
    ],
    ids=["a ball", "a vessel", "one of two", "two of three"],
)
def test_what_is_inside_out_is_turned(given: Mesh, wanted: Mesh) -> None:
    found = outward(given)
    assert np.array_equal(np.sort(found.faces, axis=1), np.sort(wanted.faces, axis=1))
    corners = found.points[found.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    thick = np.linalg.norm(across, axis=1) > 1e-12
    assert (np.einsum("fk,fck->fc", across, found.normals[found.faces])[thick] > 0).all()
    assert np.allclose(found.normals, wanted.normals)


@pytest.mark.parametrize("given", [BALL, VESSEL, rounded.sheet(1.0, 1.0), turned(rounded.sheet(1.0, 1.0))])
def test_what_is_as_it_should_be_or_encloses_nothing_stays(given: Mesh) -> None:
    assert outward(given) is given


@pytest.mark.gl
@pytest.mark.parametrize("look", [(0.8, 0.2, 0.2, 1.0), (0.7, 0.9, 0.8, 0.2)], ids=["painted", "glass"])
def test_a_thing_lathed_from_the_wrong_end_looks_as_the_other(look: tuple[float, ...]) -> None:
    spec = scene.new("turned", time_step=0.002, setting="studio")
    for number, mesh in enumerate((BALL, turned(BALL))):
        made = spec.add_mesh(
            name=f"ball{number}",
            uservert=mesh.points.ravel(),
            userface=mesh.faces.ravel(),
            inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
        )
        body = spec.worldbody.add_body(pos=(0.8 * number - 0.4, 0, 0.31))
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=made.name, rgba=look, contype=0, conaffinity=0)
    spec.worldbody.add_camera(name="eye", pos=(0, -3, 0.4), xyaxes=(1, 0, 0, 0, 0, 1), fovy=20)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with Frames(model, 96, 54, "traced") as frames:
        image = frames.image(data, "eye", 4).mean(axis=2)
        assert frames.renderer == "traced", frames.reason
    one, other = image[12:42, 22:36], image[12:42, 60:74]
    assert one.mean() > 25 and other.mean() == pytest.approx(one.mean(), rel=0.15)

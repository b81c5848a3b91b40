"""Shapes by distance functions: what they measure is what they enclose, whatever is done to them."""

import math

import numpy as np
import pytest
import trimesh

from worldkit import sculpt
from worldkit.sculpt import marching, minting
from worldkit.sculpt.signed import Shape

BALL = math.pi / 6 * 0.2**3


def solid(shape, cells=64):
    skin = marching.surface(shape, cells)
    return trimesh.Trimesh(skin.vertices, skin.faces, process=False), skin


KNOWN = {
    "sphere": (sculpt.sphere(0.2), BALL),
    "ellipsoid": (sculpt.ellipsoid((0.1, 0.2, 0.3)), math.pi / 6 * 0.006),
    "box": (sculpt.box((0.1, 0.2, 0.3)), 0.006),
    "cylinder": (sculpt.cylinder(0.1, 0.2), math.pi * 0.0025 * 0.2),
    "torus": (sculpt.torus(0.2, 0.05), 2 * math.pi**2 * 0.075 * 0.025**2),
    "capsule": (sculpt.capsule((0, 0, 0), (0, 0.1, 0), 0.1), math.pi * 0.0025 * 0.1 + math.pi / 6 * 0.001),
    "revolved": (sculpt.revolved([(0.1, 0), (0.1, 0.3)]), math.pi * 0.01 * 0.3),
    "extruded": (sculpt.extruded([(0, 0), (0.2, 0), (0, 0.2)], 0.1), 0.002),
    "tube": (sculpt.tube([(0, 0, 0), (0.3, 0, 0)], 0.05), math.pi * 0.025**2 * 0.3 + math.pi / 6 * 0.05**3),
    "bend": (sculpt.bend(sculpt.box((0.04, 0.05, 0.3)), 90), 0.0006),
    "twist": (sculpt.twist(sculpt.box((0.05, 0.05, 0.3)), 90), 0.00075),
    "linear": (sculpt.linear(sculpt.sphere(0.1), 3, (0.15, 0, 0)), 3 * BALL / 8),
    "radial": (sculpt.radial(sculpt.sphere(0.1).translate(0.15), 6), 6 * BALL / 8),
    "repeat": (sculpt.repeat(sculpt.sphere(0.1), (0.15, 0.15, 0.15), (2, 2, 1)), 4 * BALL / 8),
    "mirror": (sculpt.sphere(0.1).translate(0.1).mirror("x"), BALL / 4),
    "shell": (sculpt.sphere(0.2).shell(0.02), BALL * (1 - 0.8**3)),
    "difference": (sculpt.sphere(0.2) - sculpt.half_space((0, 0, 1)), BALL / 2),
    "scale": (sculpt.sphere(0.1).scale((2, 1, 1)), BALL / 4),
    "rotate": (sculpt.box((0.1, 0.1, 0.3)).rotate(30, (1, 1, 0)), 0.003),
}


@pytest.mark.parametrize("name", KNOWN)
def test_a_shape_encloses_its_volume_and_lies_in_its_box(name):
    shape, volume = KNOWN[name]
    mesh, skin = solid(shape)
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(volume, rel=0.02)
    cell = shape.size.max() / 64
    assert (mesh.bounds[0] > shape.low - 0.1 * cell).all() and (mesh.bounds[1] < shape.high + 0.1 * cell).all()
    assert np.abs(shape(skin.vertices)).max() < 0.6 * cell
    assert np.einsum("ij,ij->i", skin.normals, mesh.vertex_normals).mean() > 0.96


def test_a_smooth_union_flows_and_a_sharp_one_does_not():
    a, b = sculpt.sphere(0.2), sculpt.sphere(0.2).translate(0.12)
    sharp, smooth = solid(a | b)[0], solid(a.blend(b, radius=0.08))[0]
    assert smooth.volume > 1.01 * sharp.volume
    waist = np.array([[0.06, 0.0, math.sqrt(0.01 - 0.0036)]])
    assert (a | b)(waist)[0] == pytest.approx(0.0, abs=1e-9)
    assert a.blend(b, radius=0.08)(waist)[0] == pytest.approx(-0.02, abs=1e-9)  # a quarter of the radius


def test_only_cells_near_the_surface_are_looked_at():
    asked = []
    ball = sculpt.sphere(0.2)
    watched = Shape(lambda p: asked.append(len(p)) or ball.measure(p), ball.low, ball.high, "watched")
    marching.surface(watched, 128)
    assert sum(asked) < 0.45 * 129**3


def test_thin_walls_far_from_the_middle_of_a_block_are_not_lost():
    mesh, _ = solid(sculpt.box((0.3, 0.3, 0.012)), 100)
    assert mesh.is_watertight and mesh.volume == pytest.approx(0.3 * 0.3 * 0.012, rel=0.03)


def test_a_budget_of_triangles_is_kept_and_the_shape_with_it():
    shape = sculpt.ellipsoid((0.3, 0.2, 0.2)).blend(sculpt.sphere(0.1).translate(0.15, 0, 0.1), radius=0.05)
    mesh, skin = solid(shape)
    thin = marching.decimated(shape, skin, 2000, shape.size.max() / 64)
    assert len(thin.faces) <= 2000 < len(skin.faces)
    small = trimesh.Trimesh(thin.vertices, thin.faces, process=False)
    assert small.is_watertight and small.volume == pytest.approx(mesh.volume, rel=0.02)
    assert np.abs(shape(thin.vertices)).max() < 5e-4


def test_noise_has_one_shape_for_one_seed():
    points = np.random.default_rng(0).uniform(-1, 1, (500, 3))
    assert np.array_equal(sculpt.noise(points, 0.2, 3), sculpt.noise(points, 0.2, 3))
    assert not np.allclose(sculpt.noise(points, 0.2, 3), sculpt.noise(points, 0.2, 4))
    assert sculpt.noise(points, 0.2, 3).std() > 0.1 and np.abs(sculpt.noise(points, 0.2, 3)).max() <= 1.0
    near = sculpt.noise(points + 1e-4, 0.2, 3)
    assert np.abs(near - sculpt.noise(points, 0.2, 3)).max() < 0.02  # it is smooth


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: sculpt.sphere(0.0),
        lambda: sculpt.box((0.1, 0.1, 0.1), rounded=0.06),
        lambda: sculpt.sphere(0.1) & sculpt.sphere(0.1).translate(1.0),
        lambda: sculpt.revolved([(-0.1, 0), (0.1, 0.3)]),
        lambda: sculpt.tube([(0, 0, 0)], 0.1),
        lambda: sculpt.bend(sculpt.box((0.3, 0.05, 0.1)), 90),
        lambda: sculpt.repeat(sculpt.sphere(0.1), (0.05, 1, 1), (2, 1, 1)),
        lambda: marching.surface(sculpt.sphere(0.1), 1000),
        lambda: marching.surface(sculpt.sphere(0.1) - sculpt.sphere(0.2)),
        lambda: marching.surface(Shape(lambda p: np.full(len(p), np.nan), -np.ones(3), np.ones(3), "nan")),
    ],
)
def test_what_cannot_be_made_is_refused_with_words(wrong):
    with pytest.raises(ValueError, match=r".{15}"):
        wrong()


def test_what_is_drawn_behind_a_shape_does_not_depend_on_whether_it_was_kept(monkeypatch, tmp_path):
    """Nor does what its paint draws depend on what was drawn before."""
    monkeypatch.setenv("WORLDKIT_SCULPT_CACHE", str(tmp_path))

    def after(seed):
        monkeypatch.setattr(minting, "_memory", {})
        np.random.seed(seed)  # noqa: NPY002 - the global generator is meant
        draws = np.random.rand
        made = minting.made(sculpt.sphere(0.1), cells=16, texels=64, paint=lambda points, _: draws(*points.shape))
        return np.random.rand(), made.picture  # noqa: NPY002

    new, painted = after(1)
    assert list(tmp_path.glob("*.npz"))
    assert after(1)[0] == new
    for path in tmp_path.glob("*.npz"):
        path.unlink()
    other, again = after(2)
    assert other != new and (again == painted).all()

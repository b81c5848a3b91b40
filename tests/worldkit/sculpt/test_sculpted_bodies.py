"""Sculpted bodies: they weigh what they are, collide as they look, are drawn as painted, and are made once."""

import dataclasses
import math

import mujoco
import numpy as np
import pytest

from worldkit import bodies, contacts, joints, portable, scene, sculpt
from worldkit.sculpt import brushes, crisp, figure, minting

pytestmark = pytest.mark.usefixtures("kept")

BALL = sculpt.sphere(0.1)
SMALL = {"cells": 24, "texels": 64}


def world():
    return scene.new("bench", time_step=0.002)


def test_mass_and_inertia_are_those_of_the_solid():
    spec = world()
    sculpt.add(spec, sculpt.sphere(0.2), name="ball", pos=(0, 0, 0.1), density=500.0)
    model = spec.compile()
    mass = 500 * math.pi / 6 * 0.008
    assert model.body("ball").mass[0] == pytest.approx(mass, rel=2e-3)
    assert model.body("ball").inertia == pytest.approx([0.4 * mass * 0.01] * 3, rel=5e-3)
    assert model.geom("ball/look").contype[0] == 0 and model.geom("ball").contype[0] == 1


def test_a_bowl_holds_what_falls_into_it_and_a_ball_rolls_off_a_dome():
    bowl = sculpt.sphere(0.3).shell(0.02) - sculpt.half_space((0, 0, -1), 0.0)
    for turned in (False, True):
        spec = world()
        shape = bowl.rotate(180, "x") if turned else bowl
        sculpt.add(spec, shape, name="bowl", pos=(0, 0, 0.0751), fixed=True, cells=40)
        spec.worldbody.add_body(name="pea", pos=(0.02, 0, 0.2)).add_freejoint()
        spec.body("pea").add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.015, 0, 0))
        model = spec.compile()
        data = mujoco.MjData(model)
        for _ in range(1000):
            mujoco.mj_step(model, data)
        away = np.hypot(*data.body("pea").xpos[:2])
        assert (away > 0.12) if turned else (away < 0.1 and data.body("pea").xpos[2] < 0.09)


def test_a_convex_shape_is_one_piece_and_given_pieces_are_taken():
    assert len(sculpt.made(sculpt.ellipsoid((0.1, 0.2, 0.3))).hulls) == 1
    dumbbell = sculpt.sphere(0.1).translate(0.1).mirror("x") | sculpt.capsule((-0.1, 0, 0), (0.1, 0, 0), 0.03)
    assert 1 < len(sculpt.made(dumbbell, cells=32).hulls) <= 16
    assert (
        len(sculpt.made(dumbbell, cells=32, hulls=(sculpt.sphere(0.1), sculpt.sphere(0.1).translate(0.1))).hulls) == 2
    )
    assert sculpt.made(sculpt.sphere(0.1).translate(0.1).mirror("x")).bits == 2
    assert sculpt.made(sculpt.sphere(0.1).shell(0.02)).bits == 1


def test_the_picture_shows_the_paint_where_the_skin_is():
    shape = sculpt.tube([(math.cos(a) * 0.1, math.sin(a) * 0.1, a * 0.01) for a in np.arange(0, 12, 0.4)], 0.03)
    made = sculpt.made(
        shape, paint=lambda p, n: (p - shape.low) / shape.size, triangles=3000, cells=40, texels=256, hulls="convex"
    )
    for share in ((1, 0, 0), (0.4, 0.3, 0.3), (0.2, 0.6, 0.2)):
        corners = np.einsum("k,fki->fi", np.array(share, float), made.vertices[made.faces])
        uv = np.einsum("k,fki->fi", np.array(share, float), made.uv[made.faces])
        texel = np.clip((uv * 256).astype(int), 0, 255)
        seen = made.picture[texel[:, 1], texel[:, 0]] / 255.0
        off = np.abs(seen - (corners - shape.low) / shape.size).max(axis=1)
        assert np.quantile(off, 0.99) < 0.03 and (off > 0.2).mean() < 0.002


def test_the_world_survives_as_one_file_and_shows_the_picture(tmp_path):
    spec = world()

    def halves(p, n):
        rgb = brushes.over(brushes.plain(p, "#ff0000"), "#0000ff", p[:, 2] > 0)
        return rgb, np.where(p[:, 2] > 0, 0.2, 0.9)

    sculpt.add(spec, sculpt.sphere(0.2), name="ball", pos=(0, 0, 0.1), paint=halves, **SMALL)
    portable.write(spec, tmp_path / "w.mjz")
    model = portable.read(tmp_path / "w.mjz")
    above, below = model.geom("ball/look"), model.geom("ball/look2")
    rough = model.mat_roughness[[above.matid[0], below.matid[0]]]
    assert sorted(rough) == pytest.approx([0.2, 0.9])
    with mujoco.Renderer(model, 120, 160) as drawing:
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        camera = mujoco.MjvCamera()
        camera.lookat[:], camera.distance, camera.elevation = (0, 0, 0.1), 0.6, 0.0
        drawing.update_scene(data, camera)
        picture = drawing.render().astype(int)
    top, bottom = picture[45, 80], picture[75, 80]
    assert top[2] > top[0] + 40 and bottom[0] > bottom[2] + 40


def test_an_assembly_bends_at_its_joints_wherever_it_is_put():
    upper = sculpt.capsule((0, 0, 0.2), (0, 0, 0.4), 0.06)
    lower = sculpt.capsule((0, 0, 0.0), (0, 0, 0.2), 0.05)
    parts = (
        sculpt.Part("upper", upper, density=1000.0, look="plastic_red"),
        sculpt.Part("lower", lower, parent="upper", joint=joints.Hinge("knee", anchor=(0, 0, 0.2), axis=(0, 1, 0))),
    )
    spec = world()
    sculpt.assemble(spec, parts, pos=(1, 2, 1.0), yaw_deg=90, origin=(0, 0, 0.4), fixed=True)
    model = spec.compile()
    data = mujoco.MjData(model)
    data.joint("knee").qpos[0] = math.pi / 2
    mujoco.mj_forward(model, data)
    # Swung about y of the figure, which is -x of the world after a quarter turn.
    assert np.abs(data.joint("knee").xanchor - (1, 2, 0.8)).max() < 1e-3
    assert np.abs(data.joint("knee").xaxis - (-1, 0, 0)).max() < 1e-9
    assert np.abs(data.body("lower").xpos - (1, 1.9, 0.8)).max() < 1e-2
    with pytest.raises(ValueError, match="must stand before it"):
        sculpt.assemble(world(), parts[::-1], pos=(0, 0, 1))


def test_it_is_made_once_and_anew_when_anything_differs(kept):
    dark = 0.2

    def paint(points, normals):
        return np.full(points.shape, dark)

    first = sculpt.made(BALL, paint=paint, **SMALL)
    assert sculpt.made(BALL, paint=paint, **SMALL) is first
    minting._memory.clear()
    again = sculpt.made(BALL, paint=paint, **SMALL)
    assert again is not first and again.signature == first.signature
    assert np.array_equal(again.picture, first.picture) and again.volume == first.volume
    assert len(list(kept.glob("*.npz"))) == 1
    dark = 0.8
    assert sculpt.made(BALL, paint=paint, **SMALL).picture.max() > first.picture.max()
    others = [
        sculpt.made(sculpt.sphere(0.1 + 1e-9), paint=paint, **SMALL),
        sculpt.made(BALL, paint=paint, texels=64, cells=32),
        sculpt.made(sculpt.sphere(0.1), paint=lambda p, n: np.full(p.shape, 0.2) + 0.0 * n, **SMALL),
        sculpt.made(BALL, **SMALL),
    ]
    assert len({made.signature for made in (first, *others)}) == 5


def test_a_damaged_file_is_made_again(kept):
    first = sculpt.made(BALL, **SMALL)
    next(kept.glob("*.npz")).write_bytes(b"nothing")
    minting._memory.clear()
    assert np.array_equal(sculpt.made(BALL, **SMALL).vertices, first.vertices)


def test_two_makings_agree_to_the_byte():
    shape = sculpt.sphere(0.1).translate(0.1).mirror("x") | sculpt.capsule((-0.1, 0, 0), (0.1, 0, 0), 0.03)
    one, two = (minting._made("x", shape, 40, 2000, None, 256, "auto") for _ in range(2))
    assert one.vertices.tobytes() == two.vertices.tobytes()
    assert [h.tobytes() for h in one.hulls] == [h.tobytes() for h in two.hulls]


@pytest.mark.parametrize(
    "wrong",
    [
        {"paint": lambda p, n: p[:, 0]},
        {"paint": lambda p, n: p * np.nan},
        {"texels": 10},
        {"triangles": 5},
        {"hulls": "many"},
        {"mass": -1.0},
        {"parent": "nobody"},
    ],
)
def test_what_cannot_be_is_refused_with_words(wrong):
    with pytest.raises(ValueError, match=r".{15}"):
        sculpt.add(world(), sculpt.sphere(0.1), name="ball", pos=(0, 0, 1), **wrong)


def test_a_surface_is_the_contact_of_all_pieces():
    spec = world()
    ice = contacts.surface(friction=0.05, density=900.0)
    sculpt.add(spec, sculpt.torus(0.2, 0.04), name="ring", pos=(0, 0, 0.02), surface=ice)
    model = spec.compile()
    pieces = [g for g in range(model.ngeom) if model.geom(g).name.startswith("ring/") and model.geom_contype[g]]
    assert len(pieces) > 3 and np.allclose(model.geom_friction[pieces, 0], 0.05)
    assert model.body("ring").mass[0] == pytest.approx(900 * 2 * math.pi**2 * 0.08 * 0.02**2, rel=0.01)


def test_a_dressed_body_acts_as_before_and_looks_sculpted():
    bare, dressed = world(), world()
    for spec in (bare, dressed):
        bodies.box(spec, "crate", size=(0.2, 0.1, 0.1), pos=(0, 0, 0.05), mass=2.0)
    sculpt.dress(dressed, "crate", sculpt.box((0.2, 0.1, 0.1), rounded=0.02).translate(1.0), look="wood_oak", cells=24)
    before, after = bare.compile(), dressed.compile()
    assert np.allclose(after.body_inertia, before.body_inertia) and after.body("crate").mass[0] == 2.0
    assert after.geom("crate").group[0] == 3 and after.geom("crate/look").contype[0] == 0
    data = mujoco.MjData(after)
    mujoco.mj_forward(after, data)
    assert np.abs(data.geom("crate/look").xpos - (0, 0, 0.05)).max() < 1e-3
    with pytest.raises(ValueError, match="no body 'box' to dress; known: crate"):
        sculpt.dress(dressed, "box", BALL)


def test_one_box_holds_what_is_drawn_and_what_collides():
    made = sculpt.made(sculpt.torus(0.2, 0.04), cells=32, triangles=1000)
    corners = np.concatenate(made.hulls)
    assert np.allclose(corners.min(axis=0), made.low) and np.allclose(corners.max(axis=0), made.high)


def test_a_ball_falls_through_the_neck_of_a_turned_vase():
    """The hulls of an exact solid leave a neck open that is twice as wide as what falls in."""
    outside = [(0, 0), (0.055, 0), (0.1, 0.13), (0.062, 0.25), (0.08, 0.30)]
    inside = [(0.072, 0.301), (0.054, 0.25), (0.092, 0.13), (0.047, 0.012), (0, 0.012)]
    spec = world()
    sculpt.add(spec, crisp.lathe(outside + inside), name="vase", pos=(0, 0, 0.1505), fixed=True, hulls=40)
    spec.worldbody.add_body(name="pea", pos=(0.003, 0, 0.34)).add_freejoint()
    spec.body("pea").add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.02, 0, 0))
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 1000)
    assert data.body("pea").xpos[2] < 0.06 and abs(data.body("pea").xpos[0]) < 0.05


def test_a_triangle_that_shines_alone_shines_as_what_is_around_it():
    def paint(points, normals):
        return np.tile((0.5, 0.4, 0.3), (len(points), 1)), np.full(len(points), 0.6)

    solid = sculpt.made(sculpt.sphere(0.1), paint=paint, cells=16, triangles=400, texels=64)
    rough = np.array(solid.roughness)
    rough[0], rough[1:90] = 0.1, 0.3
    odd = dataclasses.replace(solid, roughness=rough)
    shines = figure._shines(odd)
    assert shines[0] == 0.3 and np.array_equal(shines[1:], rough[1:])
    spec = mujoco.MjSpec()
    body = spec.worldbody.add_body(name="ball")
    figure._draw(spec, body, "ball", odd, np.zeros(3), None, 0.6, 0.0)
    assert spec.compile().nmesh == 2

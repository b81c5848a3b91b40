"""Things of one look are pieces of one material, not copies, with edges that are worked."""

import mujoco
import numpy as np
import pytest

from worldengine.film import renderers
from worldengine.film.renderers.preview.things import Things, pieces
from worldengine.film.renderers.traced.unwrapped import SHIFT
from worldkit import bodies, materials, scene

APART_M = 20.0


def blocks(looks, **more):
    """Boxes of one size, far from each other, each with a camera before it."""
    spec = scene.new("blocks", time_step=0.002, setting="outdoor")
    for number, look in enumerate(looks):
        x = APART_M * number
        bodies.box(spec, f"block{number}", size=(0.2, 0.2, 0.2), pos=(x, 0, 0.1), look=look, **more)
        spec.worldbody.add_camera(name=f"eye{number}", pos=(x, -0.45, 0.1), xyaxes=(1, 0, 0, 0, 0, 1), fovy=20)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def test_of_a_pile_no_two_pieces_are_painted_alike():
    spec = scene.new("pile", time_step=0.002)
    for number in range(240):
        bodies.box(spec, f"brick{number}", size=(0.2, 0.1, 0.06), pos=(0.3 * number, 0, 0.03), look="brick")
    things = Things(spec.compile())
    bricks = things.rows[things.rows[:, 39] == 2.0]
    assert len(bricks) == 240
    places = bricks[:, 27:28].astype(float) * SHIFT % 1.0
    away = np.abs(places[:, None] - places[None])
    nearest = np.linalg.norm(np.minimum(away, 1 - away), axis=-1) + np.eye(240)
    assert nearest.min() > 0.015, "of a tile"
    tones = bricks[:, 16]
    entry = materials.look("brick")
    assert 5 <= len(np.unique(tones.round(5))) <= 9, "few, as each is a material of its own"
    assert np.ptp(tones) / tones.mean() == pytest.approx(2 * entry.apart, rel=0.2)


def test_bodies_that_hold_together_at_the_start_are_one_piece_of_one_tone():
    spec = scene.new("planks", time_step=0.002)
    for number in range(8):
        body = bodies.box(spec, f"part{number}", size=(0.2, 0.1, 0.06), pos=(0.2 * number, 0, 0.03), look="wood_oak")
        body.add_site(name=f"site{number}")
    tie = {"type": mujoco.mjtEq.mjEQ_WELD, "objtype": mujoco.mjtObj.mjOBJ_BODY}
    spec.add_equality(name1="part1", name2="part2", **tie)
    spec.add_equality(name1="part2", name2="part3", active=False, **tie)
    by_site = {"type": mujoco.mjtEq.mjEQ_CONNECT, "objtype": mujoco.mjtObj.mjOBJ_SITE}
    spec.add_equality(name1="site0", name2="site1", **by_site)
    spec.add_equality(name1="part4", name2="world", **tie)
    spec.add_equality(name1="part5", name2="world", **tie)
    knob = spec.body("part6").add_body(name="knob")  # no joint: rigid
    knob.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.02, 0.02, 0.02), pos=(0, 0, 0.1), mass=0.01)
    spec.worldbody.add_body(name="shelf", pos=(0, 1, 0)).add_geom(size=(0.1, 0, 0))
    model = spec.compile()
    of = pieces(model)
    assert len(of) == model.nbody and of[0] == 0
    named = {model.body(body).name: model.body(int(piece)).name for body, piece in enumerate(of)}
    parts = {name: named[name] for name in named if name.startswith("part")}
    assert parts == {f"part{n}": f"part{0 if n < 3 else n}" for n in range(8)}
    assert named["knob"] == "part6" and named["shelf"] == "shelf"
    things = Things(model)
    tones = {
        model.body(int(model.geom_bodyid[g])).name: row[16] for g, row in zip(things.geoms, things.rows, strict=True)
    }
    assert tones["part0"] == tones["part1"] == tones["part2"] != tones["part3"]


def test_the_ground_has_the_tone_of_its_look():
    """The world's first geom, a slab; a plane; height fields of bodies of their own."""
    spec = mujoco.MjSpec()
    material = materials.add(spec, "slate")
    spec.add_hfield(name="hill", nrow=2, ncol=2, size=(1, 1, 1, 1), userdata=[0.0, 1, 0, 1])
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(1, 1, 0.1), material=material)
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=(0, 0, 1), material=material)
    for number in range(3):
        body = spec.worldbody.add_body(name=f"hill{number}")
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_HFIELD, hfieldname="hill", material=material)
    tones = Things(spec.compile()).rows[:, 16]
    assert len(tones) == 5 and np.unique(tones) == pytest.approx([1.0]), "a material's own colour lies in its picture"


@pytest.mark.gl
@pytest.mark.parametrize("renderer", ["preview", "traced"])
def test_two_boxes_of_one_look_differ_by_more_than_their_light(renderer):
    model, data = blocks(["wood_oak", "wood_oak", "#9a7b50", "#9a7b50"])
    drawing = renderers.SEAM.find(renderer).take(model, 48, 48)
    pictures = [drawing.image(data, eye, 4)[14:34, 14:34].astype(float).mean(axis=-1) for eye in range(4)]
    drawing.close()
    oak, other_oak, plain, other_plain = (picture - picture.mean() for picture in pictures)
    assert np.abs(plain - other_plain).mean() < 1.0
    assert np.abs(oak - other_oak).mean() > 4 * np.abs(plain - other_plain).mean()
    assert np.corrcoef(oak.ravel(), other_oak.ravel())[0, 1] < 0.6
    assert abs(pictures[0].mean() - pictures[1].mean()) > 2 * abs(pictures[2].mean() - pictures[3].mean())


@pytest.mark.gl
@pytest.mark.parametrize("shape", ["box", "cylinder"])
def test_the_preview_rounds_edges_so_that_they_catch_the_light_from_above(shape):
    spec = scene.new("edge", time_step=0.002, setting="outdoor")
    put = {"box": {"size": (0.2, 0.2, 0.2)}, "cylinder": {"diameter": 0.2, "height": 0.2}}[shape]
    getattr(bodies, shape)(spec, "one", pos=(0, 0, 0.1), look="#9a7b50", **put)
    spec.worldbody.add_camera(name="eye", pos=(0, -0.6, 0.195), xyaxes=(1, 0, 0, 0, 0, 1), fovy=2.2)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    drawing = renderers.SEAM.find("preview").take(model, 48, 48)
    rows = drawing.image(data, 0, 4).astype(float).mean(axis=(1, 2))
    drawing.close()
    side, edge = rows[36:].mean(), rows[13:17].mean()  # the side ends above row 12; a row is half a millimetre
    assert edge > 1.08 * side, rows.round()

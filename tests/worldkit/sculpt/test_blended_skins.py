"""One skin over several bodies follows each of them, flows between, and does not tear."""

import mujoco
import numpy as np
import pytest

from worldkit import bodies, forms, joints, portable, scene, sculpt
from worldkit.sculpt import blended, brushes

pytestmark = pytest.mark.usefixtures("kept")


def arm(**words):
    """An arm that hangs, with an elbow at z = 0.35 m, in a sleeve."""
    spec = scene.new("arm", time_step=0.002)
    bodies.capsule(spec, "upper", diameter=0.09, height=0.36, pos=(0, 0, 0.5), mass=2.0, fixed=True)
    elbow = joints.Hinge("elbow", anchor=(0, 0, 0.35), axis=(0, 1, 0))
    bodies.capsule(spec, "lower", diameter=0.09, height=0.36, pos=(0, 0, 0.2), mass=1.5, parent="upper", joint=elbow)
    sleeve = sculpt.capsule((0, 0, 0.06), (0, 0, 0.64), 0.11)
    sculpt.dress(spec, ("upper", "lower"), sleeve, pos=(0, 0, -0.15), cells=64, **words)
    return spec


def skin_at(model, angle):
    """Corners (N, 3), m, of the only skin with the elbow at an angle."""
    data = mujoco.MjData(model)
    data.joint("elbow").qpos = angle
    mujoco.mj_forward(model, data)
    view = mujoco.MjvScene(model, maxgeom=200)
    every = mujoco.mjtCatBit.mjCAT_ALL
    mujoco.mjv_updateScene(model, data, mujoco.MjvOption(), mujoco.MjvPerturb(), mujoco.MjvCamera(), every, view)
    return np.array(view.skinvert, dtype=float).reshape(-1, 3)


def test_it_lies_where_it_was_drawn_and_follows_each_body_without_a_tear():
    model = arm(look="#c99774").compile()
    rest, bent = skin_at(model, 0.0), skin_at(model, -1.5)
    assert rest.min(axis=0) == pytest.approx((-0.055, -0.055, 0.005), abs=2e-3)
    high, low = rest[:, 2] > 0.45, rest[:, 2] < 0.25
    assert np.allclose(bent[high], rest[high], atol=1e-6)
    c, s = np.cos(-1.5), np.sin(-1.5)
    turned = (rest - (0, 0, 0.35)) @ np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]]) + (0, 0, 0.35)
    assert np.allclose(bent[low], turned[low], atol=1e-6)
    faces = model.skin_face.reshape(-1, 3)
    sides = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]]])
    longest = [np.linalg.norm(points[sides[:, 0]] - points[sides[:, 1]], axis=1).max() for points in (rest, bent)]
    assert longest[1] < 2.5 * longest[0]  # torn apart, a side would reach over half the sleeve
    assert (model.geom_group[[model.geom("upper").id, model.geom("lower").id]] == 3).all()


def test_fingers_side_by_side_do_not_hold_each_other():
    spec = scene.new("hand", time_step=0.002)
    bodies.box(spec, "palm", size=(0.08, 0.02, 0.08), pos=(0, 0, 0.5), mass=0.3, fixed=True)
    for name, x in (("left", -0.012), ("right", 0.012)):
        bend = joints.Hinge(f"{name}_knuckle", anchor=(x, 0, 0.54), axis=(1, 0, 0))
        bodies.capsule(spec, name, diameter=0.018, height=0.07, pos=(x, 0, 0.57), mass=0.02, parent="palm", joint=bend)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    ids = [model.body(name).id for name in ("palm", "left", "right")]
    found = blended.shares(model, data, ids, np.array([[-0.003, 0, 0.59], [-0.012, 0, 0.535], [0.0, 0, 0.47]]), 0.02)
    assert found.sum(axis=1) == pytest.approx(np.ones(3)) and (found >= 0).all()
    assert found[0].tolist() == [0, 1, 0]  # near the other finger, and held by its own alone
    assert found[1, 0] > 0 and found[1, 1] > 0 and found[2].tolist() == [1, 0, 0]


def test_it_goes_with_the_world_and_wears_its_paint(tmp_path):
    spec = arm(paint=lambda points, normals: (brushes.plain(points, "#804020"), 0.3), texels=64, metallic=1.0)
    portable.write(spec, tmp_path / "world.mjz")
    model, again = spec.compile(), portable.read(tmp_path / "world.mjz")
    material = int(model.skin_matid[0])
    assert model.mat_texid[material].max() >= 0 and model.skin_texcoordadr[0] >= 0
    assert model.mat_roughness[material] == pytest.approx(0.3) and model.mat_metallic[material] == 1.0
    assert again.nskin == 1 and np.allclose(skin_at(again, -1.0), skin_at(model, -1.0), atol=1e-5)


def test_a_ring_goes_over_a_glove_and_both_stay():
    spec = arm(look="#c99774")
    glove, ring = sculpt.capsule((0, 0, -0.135), (0, 0, 0.135), 0.1), sculpt.torus(0.12, 0.02)
    for shape, look in ((glove, "#222222"), (ring, "gold")):
        sculpt.dress(spec, "lower", shape, look=look, cells=32)
    sculpt.dress(
        spec, ("upper", "lower"), sculpt.capsule((0, 0, 0.06), (0, 0, 0.64), 0.12), pos=(0, 0, -0.15), cells=32
    )
    model = spec.compile()
    shown = {model.geom(g).name for g in range(model.ngeom) if model.geom_group[g] < 3}
    assert {"lower/look", "lower/look2"} <= shown and not {"upper", "lower"} & shown
    assert [model.skin(k).name for k in range(model.nskin)] == ["upper/skin", "upper/skin2"]


def test_what_is_sculpted_or_lathed_is_dressed_too():
    spec = scene.new("bench", time_step=0.002)
    sculpt.add(spec, sculpt.sphere(0.1), name="ball", pos=(0, 0, 1), cells=24)
    post = forms.lathe(profile=[(0, -0.1), (0.05, -0.1), (0.05, 0.1), (0, 0.1)])
    bodies.formed(spec, "post", form=post, pos=(1, 0, 1))
    for name in ("ball", "post"):
        sculpt.dress(spec, name, sculpt.sphere(0.12), look="gold", cells=24)
    model = spec.compile()
    shown = [model.geom(g).name for g in range(model.ngeom) if model.geom_group[g] < 3 and model.geom_bodyid[g]]
    assert shown == ["ball/look", "ball/look2", "post/look2"]  # what a form draws is the body's own


def test_a_body_that_is_not_there_is_told():
    with pytest.raises(ValueError, match="no body 'tail'"):
        sculpt.dress(arm(), ("upper", "tail"), sculpt.sphere(0.1), cells=16)

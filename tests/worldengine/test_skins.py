"""A body under one skin with another is seen: by the scan, by a still's numbers, and by other programs."""

import mujoco
import numpy as np
import pytest

from small_worlds import record
from worldengine.film import carried_scene, light_meter
from worldengine.film.drawn_frames import Frames
from worldengine.film.passes import visible
from worldengine.recording import describing
from worldkit import bodies, cameras, joints, scene, sculpt
from worldkit.sculpt import brushes
from worldwright.model.recording.trajectory_files import read_trajectory
from worldwright.scan.anomalies import engine
from worldwright.scan.anomalies.sign import Context

PARTS = ("upper", "lower")


@pytest.fixture(autouse=True)
def kept(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDKIT_SCULPT_CACHE", str(tmp_path / "kept"))


def striped(points, normals):
    """Bands along z, 2 cm of red and 2 cm of white."""
    return brushes.over(np.tile((0.9, 0.9, 0.9), (len(points), 1)), "#c01010", (points[:, 2] % 0.04 < 0.02) * 1.0)


def arm(**words):
    """A forearm that swings below an upper arm, in one sleeve."""
    spec = scene.new("arm", time_step=0.002, setting="studio")
    bodies.capsule(spec, "upper", diameter=0.09, height=0.36, pos=(0, 0, 0.5), mass=2.0, fixed=True)
    elbow = joints.Hinge("elbow", anchor=(0, 0, 0.35), axis=(0, 1, 0), damping=0.01)
    bodies.capsule(spec, "lower", diameter=0.09, height=0.36, pos=(0, 0, 0.2), mass=1.5, parent="upper", joint=elbow)
    sleeve = sculpt.capsule((0, 0, 0.06), (0, 0, 0.64), 0.11)
    sculpt.dress(spec, PARTS, sleeve, pos=(0, 0, -0.15), cells=48, **words)
    cameras.add(spec, "eye", position=(0.3, -1.3, 0.5), target=(0, 0, 0.35), fovy=35)
    return spec


def bent(model, angle=1.0):
    data = mujoco.MjData(model)
    data.joint("elbow").qpos = angle
    mujoco.mj_forward(model, data)
    return data


def test_the_scan_counts_it_as_drawn_and_a_hidden_skin_as_hidden(tmp_path):
    spec = arm(look="#c99774")
    found = {}
    for name, group in (("drawn", 0), ("hidden", 3)):
        spec.skin("upper/skin").group = group
        record(spec, tmp_path / name, 100, before=lambda model, data: data.qpos.fill(1.0))
        report = engine.scan(read_trajectory(tmp_path / name), Context(planned=True, movers=PARTS))
        found[name] = [(a.body, a.severity) for a in report.anomalies if a.code == "WS312"]
    assert found == {"drawn": [], "hidden": [("lower", "blocking")]}
    assert describing.describe(spec.compile())["skins"] == [
        {"name": "upper/skin", "bodies": list(PARTS), "visible": False}
    ]


@pytest.mark.gl
@pytest.mark.parametrize("renderer", ["preview", "classic"])
def test_a_still_tells_which_body_a_skins_pixels_belong_to(monkeypatch, renderer):
    monkeypatch.setenv("WORLDKIT_RENDERER", renderer)
    model = arm(look="#c99774").compile()
    with Frames(model, 160, 120) as frames:
        geoms = frames.segmentation(bent(model), "eye")
        assert frames.renderer == renderer, frames.reason
    seen = visible(model, geoms)
    assert seen["upper"]["pixels"] > 200 and light_meter.subjects(model, geoms, PARTS)["upper"] > 400
    if renderer == "preview":  # the plain one gives all of a skin to its first body
        assert seen["lower"]["pixels"] > 200 and seen["lower"]["box"][3] > seen["upper"]["box"][3]


@pytest.mark.gl
@pytest.mark.parametrize("renderer", ["preview", "traced"])
def test_a_painted_skin_wears_its_paint_where_it_was_painted(monkeypatch, renderer):
    monkeypatch.setenv("WORLDKIT_RENDERER", renderer)
    model = arm(paint=striped, texels=256).compile()
    with Frames(model, 240, 300) as frames:
        image = frames.image(bent(model, 0.0), "eye", quality="video").astype(int)
        assert frames.renderer == renderer, frames.reason
        geoms = frames.segmentation(bent(model, 0.0), "eye")
    on = np.isin(geoms, [model.geom(name).id for name in PARTS])
    rows = np.flatnonzero(on.sum(axis=1) > 6)
    red = [(image[y][on[y]] @ (1, -1, 0) > 60).mean() > 0.5 for y in rows]
    assert np.abs(np.diff(np.array(red, dtype=int))).sum() == pytest.approx(2 * 0.65 / 0.04, abs=4)


def test_other_programs_get_it_as_pieces_that_move_with_their_bodies():
    model = arm(paint=striped, texels=64).compile()
    found = {model.body(part.body).name: part for part in carried_scene.parts(model) if part.body}
    assert set(found) == set(PARTS)
    upper, lower = found["upper"].points, found["lower"].points + np.array((0, 0, 0.2))  # both built unturned
    assert upper[:, 2].max() + 0.5 == pytest.approx(0.64 + 0.055, abs=5e-3)
    assert lower[:, 2].min() == pytest.approx(0.06 - 0.055, abs=5e-3)
    assert lower[:, 2].max() > upper[:, 2].min() + 0.5 + 0.01  # they overlap where it bends
    outward = found["upper"].points * (1, 1, 0)
    assert (np.einsum("vk,vk->v", outward, found["upper"].normals) > -1e-4).all()

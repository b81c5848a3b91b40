"""A figure of sculpted parts becomes an asset: rigid in its `asset.yaml`, jointed in its `moving.xml`, alike in weight and place."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from worldkit import assets, contacts, joints, models, scene
from worldkit.assets.reading import read_asset
from worldkit.errors import IntakeError
from worldkit.intake import of_figure, taken_in
from worldkit.sculpt import Part, brushes, crisp

SAID = {
    "category": "box", "description": "a box with a lid", "source": "a test", "licence": "CC0-1.0", "creator": "somebody",
    "metric_height_source": "a test", "friction": 0.4, "restitution": 0.3,
}  # fmt: skip
OAK = contacts.surface(friction=0.7, density=700)
WALLS = crisp.box((0.2, 0.3, 0.1)).translate(z=0.05) - crisp.box((0.18, 0.28, 0.1)).translate(z=0.06)


def red(points, normals):
    return brushes.plain(points, "#c02020"), 0.3


PARTS = (
    Part("box", WALLS, look="wood_oak", surface=OAK, make={"hulls": 5}),
    Part(
        "lid", crisp.box((0.2, 0.3, 0.01)).translate(z=0.105), "box", paint=red, density=1000.0,
        joint=joints.Hinge("hinge", (-0.1, 0, 0.1), (0, -1, 0), range_deg=(0, 100), damping=0.01, frictionloss=0.002),
        make={"hulls": "convex", "texels": 64},
    ),
)  # fmt: skip


@pytest.fixture(scope="module")
def chest(tmp_path_factory):
    """An asset of two parts in a catalog of its own, and its facts."""
    patch = pytest.MonkeyPatch()
    catalog = tmp_path_factory.mktemp("catalog")
    patch.setenv("WORLDWRIGHT_CATALOG", str(catalog))
    patch.setenv("WORLDWRIGHT_ASSETS", str(catalog / "none"))
    files, facts = of_figure.files("chest", PARTS, SAID)
    taken_in.write(catalog / "chest", files, facts)
    yield catalog / "chest", facts
    patch.undo()


def test_the_rigid_asset_has_the_weight_of_its_parts_and_the_looks_of_the_table(chest):
    folder, facts = chest
    asset = read_asset(folder)
    assert asset.native_extents == pytest.approx((0.2, 0.3, 0.11))
    walls, lid = 700 * (0.2 * 0.3 * 0.1 - 0.18 * 0.28 * 0.09), 1000 * 0.2 * 0.3 * 0.01
    assert asset.mass == pytest.approx(walls + lid, rel=1e-4)
    assert asset.materials["look:wood_oak"] == {"look": "wood_oak"} and facts["measured"]["moving"] == {
        "hinge": [0.0, 100.0]
    }
    painted = asset.materials["picture_01"]
    assert painted["texture"].name == "picture_01.png" and painted["roughness"] == pytest.approx(0.3)
    spec = scene.new("room", time_step=0.002)
    assets.add(spec, "chest", name="thing", height=0.11, pos=(0, 0, 0.055))
    model = spec.compile()
    worn = {model.mat(model.geom_matid[g]).name for g in range(model.ngeom) if model.geom_group[g] == 2}
    assert "wood_oak" in worn, "a renderer knows the look by its name"
    assert model.body("thing").mass[0] == pytest.approx(asset.mass)


def test_the_moving_one_is_as_heavy_stands_where_it_stood_and_turns_on_its_hinge(chest):
    folder, facts = chest
    spec = scene.new("room", time_step=0.002)
    text = (folder / "moving.xml").read_text(encoding="utf-8")
    models.attach(spec, text, name="thing", pos=(0, 0, 0.055), folder="chest", fixed=True)
    model = spec.compile()
    assert model.body_subtreemass[model.body("thing").id] == pytest.approx(facts["mass"], rel=1e-5)
    data = mujoco.MjData(model)
    data.joint("thing_hinge").qpos = np.radians(90)
    mujoco.mj_forward(model, data)
    lid = model.body("thing_lid").id
    assert data.xipos[lid] == pytest.approx((-0.105, 0, 0.2), abs=1e-3), "it stands upright behind the box"
    assert data.ncon == 0 or not any(lid in model.geom_bodyid[pair] for pair in data.contact.geom)
    joint = model.joint("thing_hinge")
    assert joint.damping[0] == pytest.approx(0.01) and joint.frictionloss[0] == pytest.approx(0.002)
    touched = [
        g for g in range(model.ngeom) if model.geom_bodyid[g] == model.body("thing").id and model.geom_contype[g]
    ]
    assert len(touched) == 5 and model.geom_friction[touched[0]][0] == pytest.approx(0.7)
    named = {model.mat(model.geom_matid[g]).name for g in range(model.ngeom) if model.geom_group[g] == 2}
    assert "wood_oak" in named and not any(name.startswith("thing_look:") for name in named)


def test_what_is_drawn_is_drawn_the_same_in_both_and_wears_its_paint_the_right_way_up(chest):
    folder, _ = chest
    rows = (folder / "look_01.obj").read_text(encoding="utf-8").splitlines()
    points = np.array([row.split()[1:] for row in rows if row.startswith("v ")], float)
    assert np.ptp(points, axis=0) == pytest.approx((0.2, 0.3, 0.01), abs=1e-5)
    assert points[:, 2].max() == pytest.approx(0.055, abs=1e-5)
    assert any(row.startswith("vt ") for row in rows)


def test_parts_without_a_common_root_and_too_many_triangles_are_refused():
    with pytest.raises(IntakeError) as refused:
        of_figure.files("chest", [PARTS[0], Part("other", WALLS)], SAID)
    assert refused.value.code == "several_roots" and "box, other" in refused.value.cause
    many = Part("ball", crisp.ball(0.1), make={"triangles": 70_000})
    patch = pytest.MonkeyPatch()
    patch.setattr(of_figure, "MOST_TRIANGLES", 100)
    with pytest.raises(IntakeError) as refused:
        of_figure.files("ball", [many], SAID)
    patch.undo()
    assert refused.value.code == "too_many_faces" and refused.value.next_move


def test_an_unknown_look_in_an_entry_is_named_with_those_near_it(tmp_path: Path, chest):
    folder, _ = chest
    (tmp_path / "chest").mkdir()
    for path in folder.iterdir():
        (tmp_path / "chest" / path.name).write_bytes(path.read_bytes())
    entry = tmp_path / "chest/asset.yaml"
    entry.write_text(entry.read_text().replace("look: wood_oak", "look: wood_oka"))
    with pytest.raises(assets.AssetError, match="wood_oak"):
        read_asset(tmp_path / "chest")

"""A door of the user's own folder is in a plan what any MJCF is: its joint has a name, its meshes are found, its key is what is hashed."""

from pathlib import Path

import pytest
import trimesh

from worldkit.assets.catalog import taken
from worldwright.model.plan import imported
from worldwright.model.plan.scene_objects import AssetRow

MOVING = """<mujoco><compiler angle="radian"/><asset><mesh name="part_00" file="part_00.obj"/></asset><worldbody><body name="oak_door">
<geom type="box" size=".05 .5 .05"/><body name="leaf"><joint name="leaf_hinge" axis="0 0 1" range="0 1.9"/>
<geom type="mesh" mesh="part_00"/></body></body></worldbody></mujoco>"""


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "own" / "oak_door"
    folder.mkdir(parents=True)
    (folder / "moving.xml").write_text(MOVING)
    trimesh.creation.box((0.04, 0.9, 2.0)).export(folder / "part_00.obj")
    monkeypatch.setenv("WORLDWRIGHT_ASSETS", str(folder.parent))
    return folder


def test_a_door_of_ones_own_brings_its_hinge(own: Path, tmp_path: Path) -> None:
    row = AssetRow.model_validate({"name": "door", "type": "mjcf", "filename": "oak_door/moving.xml", "fixed": True})
    model = imported.load(row, tmp_path)
    assert model.folder == "oak_door" and model.joints["door_leaf_hinge"] == "hinge"
    assert model.extents == pytest.approx((0.1, 1.0, 2.0), abs=1e-4)


def test_what_is_built_of_it_notes_its_key(own: Path) -> None:
    import mujoco

    from worldkit import models

    spec = mujoco.MjSpec()
    models.attach(spec, MOVING, name="door", pos=(0, 0, 1), folder="oak_door", fixed=True)
    assert spec.compile().joint("door_leaf_hinge").range[1] == pytest.approx(1.9) and "oak_door" in taken()

"""The seam of asset sources: what every source must deliver, and a mesh file that becomes an asset."""

import math
import os
import re
import time
from pathlib import Path

import mujoco
import numpy as np
import pytest

from worldkit import assets, scene
from worldkit.assets import catalog, folders, instance
from worldkit.assets.reading import read_asset
from worldkit.assets.sources import SEAM, recipes

SAID = """
description: A ball of granite
category: nature
source: made for a test
licence: CC0-1.0
height: 0.4
density: 2650
friction: 0.7
restitution: 0.3
rgba: [0.5, 0.5, 0.48, 1]
"""


def octahedron(folder: Path, key: str = "boulder", shift: float = 5.0, open_: bool = False) -> None:
    """A closed mesh of height 2 and width 4, far from its own origin."""
    points = [(2, 0, 0), (-2, 0, 0), (0, 2, 0), (0, -2, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(1, 3, 5), (3, 2, 5), (2, 4, 5), (4, 1, 5), (3, 1, 6), (2, 3, 6), (4, 2, 6), (1, 4, 6)]
    rows = [f"v {x + shift} {y} {z - shift}" for x, y, z in points]
    rows += [f"f {a} {b} {c}" for a, b, c in faces[open_ * 1 :]]
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{key}.obj").write_text("\n".join(rows) + "\n")
    (folder / f"{key}.yaml").write_text(SAID)


@pytest.fixture
def meshes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("WORLDWRIGHT_CATALOG", str(tmp_path))
    (tmp_path / "mug").symlink_to(Path(__file__).parents[2] / "catalog" / "mug")
    octahedron(tmp_path / "meshes")
    return tmp_path / "meshes"


@pytest.mark.parametrize("name", SEAM.names())
def test_every_source_delivers_its_example_whole(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("WORLDWRIGHT_CATALOG", str(tmp_path))
    monkeypatch.setenv("WORLDWRIGHT_ASSETS", str(tmp_path / "own"))
    source = SEAM.find(name)
    assert source.keys() == (), "an empty catalog"
    key = source.example(tmp_path)
    assert source.keys() == (key,) and catalog.sources() == {key: name}
    entry, files = assets.find(key), source.files(key)
    assert entry.key == key and entry.licence and entry.source and entry.description
    assert entry.extents()[2] == pytest.approx(entry.metric_height) and entry.mass_at() > 0
    assert files == tuple(sorted(files)) and all(path.is_file() and path.is_relative_to(tmp_path) for path in files)
    used = {path.resolve() for path, _ in entry.visual} | {path.resolve() for path in entry.hulls}
    assert used <= {path.resolve() for path in files}, "what it is made of decides what it is"
    spec = scene.new("one", time_step=0.002)
    height = entry.metric_height
    assets.add(spec, key, name="thing", height=height, pos=(0, 0, height / 2))
    model = spec.compile()
    assert model.body("thing").mass[0] == pytest.approx(entry.mass_at(height))


def test_a_folder_is_an_asset_as_soon_as_it_is_whole(tmp_path: Path) -> None:
    root = tmp_path / "catalog"
    assert folders.keys(root) == ()
    recipes.cube(root / "cube")
    (root / "later").mkdir()
    (root / ".incoming-1").mkdir()
    (root / ".incoming-1" / "asset.yaml").write_text("half of it")
    os.utime(root, ns=(0, time.time_ns() - 10**9))  # long enough ago to be remembered
    for _ in range(2):
        assert folders.keys(root) == ("cube",)
    (root / "later" / "asset.yaml").write_text("a folder that was there is filled")
    assert folders.keys(root) == ("cube", "later")
    (root / "cube").rename(root / ".gone")
    assert folders.keys(root) == ("later",)


def test_the_users_own_lie_beside_the_catalog_and_are_named_apart(
    meshes: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    own = meshes.parent / "own of mine"
    monkeypatch.setenv("WORLDWRIGHT_ASSETS", str(own))
    recipes.cube(own / "my_cube")
    assert assets.keys() == ("boulder", "mug", "my_cube")
    assert [asset.key for asset in assets.entries()] == ["boulder", "mug", "my_cube"]
    assert [assets.relative(path) for path in assets.files("my_cube")] == [
        "own/my_cube/asset.yaml",
        "own/my_cube/cube.obj",
    ]
    assert assets.relative(assets.files("boulder")[0]) == "meshes/boulder.obj"


def test_both_are_in_one_list(meshes: Path) -> None:
    assert assets.keys() == ("boulder", "mug")
    assert catalog.sources() == {"boulder": "mesh_files", "mug": "recipes"}


def test_a_mesh_file_is_measured(meshes: Path) -> None:
    found = assets.find("boulder")
    assert found.native_extents == pytest.approx((4, 4, 2))
    assert found.solid_volume == pytest.approx(16 / 3), "two pyramids of base 8 and height 1"
    assert found.mass_at(0.4) == pytest.approx(2650 * 16 / 3 * 0.2**3)
    assert found.inertia_com == pytest.approx((0, 0, 0), abs=1e-9)
    assert found.inertia_per_kg[2] == pytest.approx(0.8), "(a^2 + b^2) / 10 of an octahedron with half axes 2 and 2"


def test_it_stands_where_it_is_put_and_falls_as_it_weighs(meshes: Path) -> None:
    spec = scene.new("quarry", time_step=0.002)
    assets.add(spec, "boulder", name="rock", height=0.4, pos=(1, 2, 0.2))
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    rock = model.body("rock").id
    assert model.body_mass[rock] == pytest.approx(2650 * 16 / 3 * 0.2**3)
    for geom in np.flatnonzero(model.geom_bodyid == rock):
        mesh = model.geom_dataid[geom]
        first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
        cloud = model.mesh_vert[first : first + count] @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]
        assert cloud.min(axis=0) == pytest.approx((0.6, 1.6, 0.0), abs=1e-6), "drawn and solid alike"
        assert cloud.max(axis=0) == pytest.approx((1.4, 2.4, 0.4), abs=1e-6)
    for _ in range(500):
        mujoco.mj_step(model, data)
    assert np.isfinite(data.qpos).all() and data.xpos[rock, 2] < 0.2, "it rolls off its tip"
    assert math.dist(data.xpos[rock, :2], (1, 2)) < 2


def test_a_file_that_changes_is_read_again(meshes: Path) -> None:
    assert assets.find("boulder").density == 2650
    (meshes / "boulder.yaml").write_text(SAID.replace("2650", "2700"))
    assert assets.find("boulder").density == 2700


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("licence: CC0-1.0\n", "", "licence is missing"),
        ("density: 2650", "density: 2650\nmass: 3", "either mass"),
        ("density: 2650", "density: -1", "density must be a number"),
        ("density: 2650", "density: 2650\ncolor: red", "color is not a known key"),
        ("height: 0.4", "height: tall", "height must be a number"),
    ],
)
def test_what_is_wrong_with_it_is_named(meshes: Path, old: str, new: str, said: str) -> None:
    (meshes / "boulder.yaml").write_text(SAID.replace(old, new))
    with pytest.raises(assets.AssetError, match=rf"boulder\.yaml: .*{said}"):
        assets.find("boulder")


def test_a_file_that_is_no_mesh_and_an_open_one_are_refused(meshes: Path) -> None:
    (meshes / "boulder.obj").write_text("hello\n")
    with pytest.raises(assets.AssetError, match=r"boulder\.obj"):
        assets.find("boulder")
    octahedron(meshes, open_=True)
    with pytest.raises(assets.AssetError, match=r"boulder\.obj: it is not closed"):
        assets.find("boulder")


def test_two_sources_of_one_key_are_refused(meshes: Path) -> None:
    octahedron(meshes, "mug")
    with pytest.raises(assets.AssetError, match="both mesh_files and recipes deliver 'mug'"):
        assets.find("mug")


def test_a_key_of_the_users_own_gives_way_to_the_catalogs(meshes: Path, tmp_path: Path, monkeypatch) -> None:
    from click.testing import CliRunner

    from worldwright.intake.command import command

    monkeypatch.setenv("WORLDWRIGHT_ASSETS", str(tmp_path / "own"))
    recipes.cube(tmp_path / "own" / "mug")
    recipes.cube(tmp_path / "own" / "die")
    assert catalog.sources() == {"boulder": "mesh_files", "die": "own_folder", "mug": "recipes"}
    assert catalog.hidden() == ("mug",) and assets.find("mug").folder.parent == tmp_path
    listed = CliRunner().invoke(command, ["list"])
    assert listed.exit_code == 0 and "mug: the catalog's is used; rename yours" in listed.output


def test_what_was_mended_is_a_list(tmp_path: Path) -> None:
    recipes.cube(tmp_path / "die")
    said = (tmp_path / "die" / "asset.yaml").read_text()
    for words in ("mended: 3", "assumed: null", "mended: a word"):
        (tmp_path / "die" / "asset.yaml").write_text(f"{said}\n{words}\n")
        with pytest.raises(assets.AssetError, match="must be a list of texts"):
            read_asset(tmp_path / "die")


def test_a_look_of_ours_may_cover_it(meshes: Path) -> None:
    spec = scene.new("painted", time_step=0.002)
    assets.add(spec, "boulder", name="rock", height=0.4, pos=(0, 0, 0.2), look="#336699")
    model = spec.compile()
    drawn = next(g for g in range(model.ngeom) if model.geom_group[g] == instance.VISUAL_GROUP)
    assert model.mat_rgba[model.geom_matid[drawn], 2] > model.mat_rgba[model.geom_matid[drawn], 0]


def test_what_is_called_just_so_is_found_before_its_rivals(meshes: Path) -> None:
    from worldwright.retrieve.tools import find_asset

    for key in ("tin_box", "tin_can"):  # "can" is a word that a question has in passing
        octahedron(meshes, key)
    assert [hit.key for hit in find_asset("tin can").assets[:2]] == ["tin_can", "tin_box"]


def test_what_is_said_of_it_anew_is_found_within_a_second(meshes: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from worldwright.retrieve import assets as found
    from worldwright.retrieve.tools import find_asset

    octahedron(meshes, "marker")
    monkeypatch.setattr(found, "FRESH_S", 1e9)
    assert [hit.key for hit in find_asset("marker").assets[:1]] == ["marker"]
    entry = next(path for path in meshes.rglob("*.yaml") if "marker" in path.as_posix().removeprefix(meshes.as_posix()))
    text = re.sub(r"description: .*", "description: A zebra crossing", entry.read_text(encoding="utf-8"))
    entry.write_text(text, encoding="utf-8")
    octahedron(meshes, "beacon")  # what is new is found at once, and all is read again with it
    assert [hit.key for hit in find_asset("beacon").assets[:1]] == ["beacon"]
    assert [hit.key for hit in find_asset("zebra").assets[:1]] == ["marker"]
    entry.write_text(text.replace("zebra", "pelican"), encoding="utf-8")
    os.utime(entry, ns=(1, 1))
    assert "marker" not in [hit.key for hit in find_asset("pelican").assets]
    monkeypatch.setattr(found, "FRESH_S", 0.0)
    assert [hit.key for hit in find_asset("pelican").assets[:1]] == ["marker"]


def test_it_is_found_placed_and_drawn_like_any_other(meshes: Path) -> None:
    from worldwright.place.drawing.silhouettes import asset_clouds
    from worldwright.retrieve.tools import find_asset

    hit = find_asset("granite boulder").assets[0]
    assert (hit.key, hit.thumbnail) == ("boulder", "")
    (cloud,) = asset_clouds("boulder", 0.4)
    assert cloud.max(axis=0) == pytest.approx((0.4, 0.4, 0.2)) and cloud.min(axis=0) == pytest.approx(
        (-0.4, -0.4, -0.2)
    )

"""A world as one file: plain MuJoCo opens it anywhere, and it moves as the program's."""

import warnings
import zipfile
from pathlib import Path

import mujoco
import numpy as np
import pytest

from worldkit import assets, cameras, materials, motion, portable, scene, world
from worldkit.errors import ProgramError


def table() -> mujoco.MjSpec:
    """Catalog meshes with picture textures, painted textures of both kinds, a launch."""
    spec = scene.new("table", time_step=0.002, floor="wood_planks")
    assets.add(spec, "mug", name="mug", height=0.1, pos=(0, 0, 0.3))
    ball = spec.worldbody.add_body(name="ball", pos=(1 / 3, 0, 0.7))
    ball.add_freejoint()
    ball.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.1 / 3, 0, 0), material=materials.add(spec, "beach_ball"))
    cameras.add(spec, "overview", view="perspective", subjects=("ball", "mug"))
    motion.launch(spec, {"ball": motion.Launch(linear=(-0.7, 0, 0), angular=(0, 0, 0))})
    return spec


def run(model: mujoco.MjModel, steps: int = 300) -> np.ndarray:
    data = world.start(model)
    for _ in range(steps):
        mujoco.mj_step(model, data)
    return data.qpos.copy()


def test_plain_mujoco_opens_it_elsewhere_and_it_moves_alike(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    model = table().compile()
    path = tmp_path / "world.mjz"
    facts = portable.write(table(), path)
    assert all(apart < 1e-12 for apart in facts["rounded"].values())
    monkeypatch.chdir("/")
    opened = mujoco.MjSpec.from_file(str(path)).compile()
    assert np.array_equal(opened.tex_data, model.tex_data)
    assert np.allclose(run(opened), run(model), rtol=0, atol=1e-6)
    with zipfile.ZipFile(path) as archive:
        names = archive.namelist()
        text = archive.read("model.xml").decode()
    assert all(name == "model.xml" or name.startswith("assets/") for name in names)
    assert str(assets.catalog_root()) not in text
    assert len(set(names)) == len(names) == facts["files"]


def test_small_content_is_packed_hard_and_large_content_fast(tmp_path: Path) -> None:
    text = b"<body/>" * (portable.SMALL // 7)
    for content, most in ((text, 0.01), (text + text, 0.02)):
        portable._store({"model.xml": content}, tmp_path / "world.mjz")
        with zipfile.ZipFile(tmp_path / "world.mjz") as archive:
            assert archive.read("model.xml") == content
            assert archive.infolist()[0].compress_size < most * len(content)
    assert portable._level(portable.SMALL) > portable._level(portable.SMALL + 1)


def test_a_file_that_is_gone_is_named(tmp_path: Path) -> None:
    spec = mujoco.MjSpec()
    wedge = tmp_path / "wedge.obj"
    wedge.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    spec.add_mesh(name="wedge", file=str(wedge))
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="wedge")
    portable.write(spec.copy(), tmp_path / "a.mjz")
    wedge.unlink()
    with pytest.raises(ProgramError, match=r"cannot be read|wedge"):
        portable.take_in(spec)


@pytest.mark.parametrize("second", ["./model.xml", "/model.xml", "sub/../model.xml", "model.xml"])
def test_an_archive_that_two_readers_open_differently_is_refused(tmp_path, second):
    path = tmp_path / "world.mjz"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("model.xml", "<mujoco/>")
        with warnings.catch_warnings(action="ignore"):
            archive.writestr(second, "<mujoco><worldbody><geom size='1'/></worldbody></mujoco>")
    with pytest.raises(ValueError, match="another world"):
        portable.read(path)


def test_a_limit_that_is_none_is_told_as_one(tmp_path: Path) -> None:
    spec = mujoco.MjSpec()
    body = spec.worldbody.add_body()
    body.add_geom(size=(0.1, 0, 0))
    body.add_joint(name="slide", type=mujoco.mjtJoint.mjJNT_SLIDE, range=(0, float("inf")))
    with pytest.raises(ProgramError) as told:
        portable.write(spec, tmp_path / portable.NAME)
    assert "jnt_range of slide" in told.value.cause and "finite limit" in told.value.next_move

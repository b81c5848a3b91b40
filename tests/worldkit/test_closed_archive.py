"""What an archive opens is in the archive: nothing from the disk, no bombs, no surprises, and a typed error for each."""

import contextlib
import zipfile
from pathlib import Path

import mujoco
import pytest

from worldkit import closed_archive, portable

WEDGE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
BALL = "<worldbody><geom size='1'/></worldbody>"


def archive(folder: Path, text: str, compression: int = zipfile.ZIP_STORED, **files: bytes) -> Path:
    path = folder / "world.mjz"
    with zipfile.ZipFile(path, "w", compression) as opened:
        opened.writestr("model.xml", text)
        for name, content in files.items():
            opened.writestr(f"assets/{name}.obj", content)
    return path


@pytest.fixture
def outside(tmp_path, monkeypatch):
    """A folder with models and a mesh that no archive holds; it is the working folder too."""
    (tmp_path / "wedge.obj").write_text(WEDGE)
    (tmp_path / "more.xml").write_text(f"<mujoco>{BALL}</mujoco>")
    (tmp_path / "inside").mkdir()
    monkeypatch.chdir(tmp_path / "inside")
    return tmp_path


REACHING = {
    "include": "<include file='{0}/more.xml'/>",
    "include by a parent": "<include file='../more.xml'/>",
    "model": "<asset><model name='m' file='{0}/more.xml'/></asset>",
    "mesh": "<asset><mesh name='m' file='{0}/wedge.obj'/></asset>",
    "mesh by a parent": "<asset><mesh name='m' file='../wedge.obj'/></asset>",
    "folder of meshes": "<compiler meshdir='{0}'/><asset><mesh name='m' file='wedge.obj'/></asset>",
    "folder of all": "<compiler assetdir='..'/><asset><mesh name='m' file='wedge.obj'/></asset>",
    "stripped path": "<compiler strippath='true'/><asset><mesh name='m' file='assets/wedge.obj'/></asset>",
    "a face of a cube": "<asset><texture name='t' type='cube' fileright='{0}/right.png'/></asset>",
}


@pytest.mark.parametrize("reach", REACHING.values(), ids=REACHING)
def test_what_reaches_outside_is_refused_by_its_place(outside, reach):
    path = archive(outside, f"<mujoco>\n{reach.format(outside)}{BALL}</mujoco>", wedge=WEDGE.encode())
    with pytest.raises(ValueError, match=r"line 2 of model\.xml"):
        portable.read(path)


def test_what_lies_in_it_opens(outside):
    text = f"<mujoco><asset><mesh name='m' file='assets/wedge.obj'/></asset>{BALL}</mujoco>"
    assert portable.read(archive(outside, text, wedge=WEDGE.encode())).nmesh == 1


def test_a_world_built_with_stripped_paths_is_written_whole(outside):
    """Its author's option is an author's: in the archive each file has its name."""
    folder = outside / "meshes"
    folder.mkdir()
    (outside / "wedge.obj").rename(folder / "wedge.obj")
    text = f"<mujoco><asset><mesh name='m' file='meshes/wedge.obj'/></asset>{BALL}</mujoco>"
    (outside / "world.xml").write_text(text)
    spec = mujoco.MjSpec.from_file(str(outside / "world.xml"))
    portable.write(spec, outside / "world.mjz")
    assert portable.read(outside / "world.mjz").nmesh == 1


def test_a_bomb_is_refused_before_it_is_unpacked(tmp_path, monkeypatch):
    monkeypatch.setattr(closed_archive, "MOST_BYTES", 1 << 20)
    path = archive(tmp_path, "<mujoco/>", zipfile.ZIP_DEFLATED, zeros=bytes(2 << 20))
    assert path.stat().st_size < 1 << 14
    monkeypatch.setattr(zipfile.ZipFile, "read", lambda *_: pytest.fail("it was unpacked"))
    with pytest.raises(ValueError, match="larger than 1 MB"):
        portable.read(path)


@pytest.mark.parametrize("kept", [0.0, 0.3, 0.9])
@pytest.mark.parametrize("compression", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])
def test_a_truncated_archive_is_none(tmp_path, kept, compression):
    path = archive(tmp_path, f"<mujoco>{BALL}</mujoco>", compression)
    content = path.read_bytes()
    path.write_bytes(content[: int(kept * len(content))])
    with pytest.raises(ValueError, match="no archive of a world"):
        portable.read(path)


def test_every_flipped_byte_opens_the_same_world_or_is_refused(tmp_path):
    path = archive(tmp_path, f"<mujoco>{BALL}</mujoco>", zipfile.ZIP_DEFLATED)
    content = path.read_bytes()
    for at in range(len(content)):
        path.write_bytes(content[:at] + bytes([content[at] ^ 0x55]) + content[at + 1 :])
        with contextlib.suppress(ValueError):
            assert portable.read(path).ngeom == 1


@pytest.mark.parametrize(
    "text",
    ["", "<mujoco", "<mujoco><worldbody>", "<!DOCTYPE m [<!ENTITY a 'b'>]><mujoco model='&a;'/>", "\x00", "<a/><b/>"],
)
def test_text_that_is_no_world_is_refused(tmp_path, text):
    with pytest.raises(ValueError, match=r"well-formed|XML|document type|mujoco"):
        portable.read(archive(tmp_path, text))


@pytest.mark.parametrize("size", ["nan", "-1", "1e400"])
def test_numbers_that_are_none_are_refused(tmp_path, size):
    with pytest.raises(ValueError, match=r"size|number|bad format"):
        portable.read(archive(tmp_path, f"<mujoco><worldbody><geom size='{size}'/></worldbody></mujoco>"))


@pytest.mark.parametrize("more", ["<camera name='eye' pos='nan 0 0'/>", "<geom name='eye' size='1' rgba='nan 0 0 1'/>"])
def test_numbers_that_only_a_picture_shows_are_refused_too(tmp_path, more):
    with pytest.raises(ValueError, match=r"none \(nan, inf\): \w+ of eye"):
        portable.read(archive(tmp_path, f"<mujoco><worldbody>{more}</worldbody></mujoco>"))

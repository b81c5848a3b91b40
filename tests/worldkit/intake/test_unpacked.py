"""An archive is unpacked bounded and in its place, whatever it claims; and the one mesh in it is found."""

import stat
import zipfile
from pathlib import Path

import pytest
import trimesh

from worldkit.errors import IntakeError
from worldkit.intake import unpacked


def packed(path: Path, members: dict[str, bytes]) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as held:
        for name, content in members.items():
            held.writestr(name, content)
    return path


def test_the_mesh_comes_out_with_what_belongs_to_it_and_nothing_else(tmp_path: Path) -> None:
    obj = trimesh.creation.box().export(file_type="obj").encode()
    members = {
        "a/crate.obj": obj,
        "a/crate.stl": b"x",
        "a/tex/wood.PNG": b"png",
        "a/crate.mtl": b"",
        "a/readme.txt": b"",
        "run.sh": b"",
    }
    out = tmp_path / "out"
    assert unpacked.unpack(packed(tmp_path / "a.zip", members), out) == out / "a/crate.obj"
    assert {path.relative_to(out).as_posix() for path in out.rglob("*") if path.is_file()} == {*members} - {
        "a/readme.txt",
        "run.sh",
    }


def test_what_macos_lays_beside_each_file_is_no_mesh(tmp_path: Path) -> None:
    obj = trimesh.creation.box().export(file_type="obj").encode()
    notes = b"\0\x05\x16\x07\0\x02\0\0Mac OS X        "
    members = {
        "Crate/crate.obj": obj,
        "__MACOSX/Crate/._crate.obj": notes,
        "__MACOSX/Crate/lid.obj": notes,
        "._Crate.stl": notes,
    }
    out = tmp_path / "out"
    assert unpacked.unpack(packed(tmp_path / "a.zip", members), out) == out / "Crate/crate.obj"
    assert [path for path in out.rglob("*") if path.is_file()] == [out / "Crate/crate.obj"]
    for name, content in members.items():  # as it lies in a folder that was unpacked by hand
        (tmp_path / "by_hand" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "by_hand" / name).write_bytes(content)
    assert unpacked.the_mesh(tmp_path / "by_hand", "by_hand") == tmp_path / "by_hand/Crate/crate.obj"


@pytest.mark.parametrize("name", ["../evil.obj", "/etc/evil.obj", "a/../../evil.obj", "..\\evil.obj", "C:/evil.obj"])
def test_a_path_that_climbs_out_is_refused_before_anything_is_written(name: str, tmp_path: Path) -> None:
    path = packed(tmp_path / "a.zip", {"good.obj": b"v 0 0 0\n", name: b"v 0 0 0\n"})
    with pytest.raises(IntakeError) as told:
        unpacked.unpack(path, tmp_path / "out")
    assert told.value.code == "climbs_out" and told.value.place == "a.zip" and told.value.next_move
    assert [found.name for found in tmp_path.rglob("*")] == ["a.zip"]


def test_a_link_is_refused(tmp_path: Path) -> None:
    row = zipfile.ZipInfo("a.obj")
    row.external_attr = (stat.S_IFLNK | 0o777) << 16
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as held:
        held.writestr(row, "/etc/passwd")
    with pytest.raises(IntakeError, match="is a link"):
        unpacked.unpack(tmp_path / "a.zip", tmp_path / "out")


@pytest.mark.parametrize("lies", [False, True])
def test_a_bomb_is_refused_by_what_it_claims_and_by_what_it_is(lies: bool, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr(unpacked, "MOST_BYTES", 1 << 20)
    path = packed(tmp_path / "a.zip", {"a.obj": b"\n" * (8 << 20)})
    assert path.stat().st_size < 20_000
    if lies:  # as if the archive's directory claimed one byte
        monkeypatch.setattr(unpacked, "sum", lambda _: 1, raising=False)
    with pytest.raises(IntakeError, match="unpacks to more than 1 MB" if lies else "it says that it unpacks") as told:
        unpacked.unpack(path, tmp_path / "out")
    assert told.value.code == "too_large"
    written = sum(found.stat().st_size for found in (tmp_path / "out").rglob("*") if found.is_file())
    assert written <= 1 << 20


@pytest.mark.parametrize(
    ("members", "code"), [({"a.txt": b""}, "no_mesh"), ({"a.obj": b"", "b/c.stl": b""}, "several_meshes")]
)
def test_none_and_several_are_told(members: dict[str, bytes], code: str, tmp_path: Path) -> None:
    with pytest.raises(IntakeError) as told:
        unpacked.unpack(packed(tmp_path / "a.zip", members), tmp_path / "out")
    assert told.value.code == code


def test_an_archive_that_is_cut_off_is_told(tmp_path: Path) -> None:
    path = packed(tmp_path / "a.zip", {"a.obj": bytes(range(256)) * 50})
    for content in (path.read_bytes()[:-30], path.read_bytes()[:10], b"PK no"):
        path.write_bytes(content)
        with pytest.raises(IntakeError, match="cannot be unpacked"):
            unpacked.unpack(path, tmp_path / "out")


@pytest.mark.parametrize("kind", [zipfile.ZIP_DEFLATED, zipfile.ZIP_LZMA])
def test_an_archive_whose_middle_is_broken_is_refused(tmp_path: Path, kind: int) -> None:
    with zipfile.ZipFile(tmp_path / "a.zip", "w", kind) as held:
        held.writestr("a.obj", "".join(f"v {n} {n * n} 1\n" for n in range(500)))
    content = bytearray((tmp_path / "a.zip").read_bytes())
    content[44:300] = bytes([255]) * 256
    (tmp_path / "a.zip").write_bytes(content)
    with pytest.raises(IntakeError, match="cannot be unpacked") as told:
        unpacked.unpack(tmp_path / "a.zip", tmp_path / "out")
    assert told.value.code == "truncated"

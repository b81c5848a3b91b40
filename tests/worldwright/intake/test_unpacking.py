"""A robot's archive becomes a folder beside the plan, whole or not at all."""

import io
import tarfile
from pathlib import Path

import pytest

from worldkit.intake import unpacked
from worldwright.intake.refusing import IntakeFailedError
from worldwright.intake.unpacking import unpack
from worldwright.model.errors import NotFoundError


def packed(path: Path, members: dict[str, bytes], kind: bytes = tarfile.REGTYPE) -> Path:
    with tarfile.open(path, "w:gz") as made:
        for name, content in members.items():
            row = tarfile.TarInfo(name)
            row.size, row.type = len(content), kind
            made.addfile(row, io.BytesIO(content))
    return path


def test_a_robot_is_unpacked_and_its_models_are_named(tmp_path: Path) -> None:
    members = {
        "arm/arm.urdf": b"<robot/>",
        "arm/meshes/a.stl": b"x",
        "arm/run.sh": b"",
        "arm/parts.xml": b"<mujocoinclude/>",
    }
    told = unpack(packed(tmp_path / "arm.tar.gz", members))
    assert told.models == ("arm/arm.urdf",) and "type: urdf, filename: arm/arm/arm.urdf" in told.text()
    assert sorted(path.name for path in (tmp_path / "arm").rglob("*.*")) == ["a.stl", "arm.urdf", "parts.xml"]
    with pytest.raises(IntakeFailedError, match="already"):
        unpack(tmp_path / "arm.tar.gz")
    with pytest.raises(NotFoundError):
        unpack(tmp_path / "none.zip")


@pytest.mark.parametrize(
    ("name", "kind", "code"),
    [
        ("../a.urdf", tarfile.REGTYPE, "climbs_out"),
        ("a.urdf", tarfile.SYMTYPE, "climbs_out"),
        ("a.urdf", tarfile.CHRTYPE, "climbs_out"),
    ],
)
def test_a_tape_that_climbs_out_or_links_leaves_nothing(tmp_path: Path, name: str, kind: bytes, code: str) -> None:
    packed(tmp_path / "arm.tgz", {name: b""}, kind)
    with pytest.raises(IntakeFailedError) as told:
        unpack(tmp_path / "arm.tgz")
    assert told.value.code == code and [path.name for path in tmp_path.iterdir()] == ["arm.tgz"]


def test_a_tape_is_read_no_further_than_it_may_unpack(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr(unpacked, "MOST_BYTES", 1 << 20)
    packed(tmp_path / "arm.tgz", {"a.bin": b"\0" * (4 << 20), "a.urdf": b"<robot/>"})
    with pytest.raises(IntakeFailedError, match="more than") as told:
        unpack(tmp_path / "arm.tgz")
    assert told.value.code == "too_large"

"""The page of an accepted run shows what was accepted, whatever lies beside it since."""

import hashlib
from pathlib import Path
from types import SimpleNamespace

import pytest

from worldwright.model.evidence.run import Run
from worldwright.report import material
from worldwright.stamp import lies_beside
from worldwright.stamp.statement import Digest, Statement, Subject

KEY = "0123456789abcdef"
FILES = {
    "prompt.md": b"A crate slides.", "evidence/visual.json": b'{"author": "measured"}', "evidence/stills.json": b"{}",
    "stills/side.png": b"an honest picture", "video/side.mp4": b"an honest film",
}  # fmt: skip


@pytest.fixture
def found(tmp_path: Path) -> SimpleNamespace:
    """A run with an accepted folder, and the evidence that it was copied from."""
    (tmp_path / "plan.md").write_text("a plan")
    run = Run(tmp_path)
    for name, content in FILES.items():
        beside = run.folder / (
            "prompt.md" if name == "prompt.md" else f"evidence/{KEY}/{name.removeprefix('evidence/')}"
        )
        for path in (run.accepted / name, beside):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
    passed = run.evidence(KEY) / "stills" / "result.json"
    (run.evidence(KEY) / "stills.json").rename(passed)
    subjects = [Subject(name=n, digest=Digest(sha256=hashlib.sha256(c).hexdigest())) for n, c in FILES.items()]
    source = SimpleNamespace(source=SimpleNamespace(key=KEY))
    stamp = Statement.model_construct(subject=tuple(subjects), predicate=source)
    return SimpleNamespace(run=run, stamp=stamp, missing={}, plan=None)


def test_pictures_and_reports_are_the_accepted_ones(found: SimpleNamespace, monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[Path] = []
    monkeypatch.setattr(
        material.Kept, "read", lambda path, model: read.append(path) or SimpleNamespace(value=None, problem="")
    )
    folder = found.run.evidence(KEY)
    (folder / "stills" / "another.png").write_bytes(b"painted")
    (found.run.accepted / "video" / "another.mp4").write_bytes(b"not in the stamp")
    material._evidence(found, folder)
    assert found.stills == {"side": found.run.accepted / "stills" / "side.png"}
    assert found.videos == {"side": found.run.accepted / "video" / "side.mp4"}
    assert found.run.accepted / "evidence" / "visual.json" in read
    assert folder / "robust.json" in read  # made beside, after it was accepted
    assert not found.missing


def test_films_drawn_since_are_said_to_be_and_links_are_not_shown(found: SimpleNamespace) -> None:
    listed = tuple(s for s in found.stamp.subject if not s.name.startswith("video/"))
    found.stamp = found.stamp.model_copy(update={"subject": listed})
    folder = found.run.evidence(KEY) / "video"
    (folder / "linked.mp4").symlink_to(found.run.prompt)
    assert material._pictures(found, folder.parent, "video", ".mp4") == {"side": folder / "side.mp4"}
    assert "drawn since it was accepted" in found.missing["video"]


@pytest.mark.parametrize(
    "name",
    [
        "prompt.md",
        f"evidence/{KEY}/visual.json",
        f"evidence/{KEY}/stills/result.json",
        f"evidence/{KEY}/video/side.mp4",
    ],
)
def test_what_differs_from_the_accepted_is_told(found: SimpleNamespace, name: str) -> None:
    assert list(lies_beside.other(found.run, found.stamp)) == []
    path = found.run.folder / name
    honest = path.read_bytes()
    path.write_bytes(b"6 km !")
    assert list(lies_beside.other(found.run, found.stamp)) == [name]
    (found.run.folder / "elsewhere").write_bytes(honest)
    path.unlink()
    path.symlink_to(found.run.folder / "elsewhere")
    assert list(lies_beside.other(found.run, found.stamp)) == [name]

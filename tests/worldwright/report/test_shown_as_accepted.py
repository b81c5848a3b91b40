"""The page of an accepted run shows what was accepted, whatever lies beside it since."""

import hashlib
import json
import shutil
from pathlib import Path
from types import SimpleNamespace

import pytest

from worldwright import exported, made_scenes
from worldwright.model.errors import GateError
from worldwright.model.evidence.handed_in import HandedIn
from worldwright.model.evidence.run import Run
from worldwright.report import material, media
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


@pytest.mark.parametrize("name", ["/etc/passwd", "../elsewhere", ""])
def test_a_stamp_that_lists_what_lies_elsewhere_has_nothing_read_there(found: SimpleNamespace, name: str) -> None:
    (found.run.folder.parent / "elsewhere").write_text("another's")
    odd = Subject(name=name, digest=Digest(sha256="0" * 64))
    found.stamp.predicate.source.materials = {}
    found.stamp = found.stamp.model_copy(update={"subject": (odd,)})
    assert list(lies_beside.other(found.run, found.stamp)) == []
    assert list(lies_beside.added(found.run, found.stamp)) == ["prompt.md"]


def film(content: bytes) -> HandedIn:
    return HandedIn(name="handed_in.mp4", sha256=hashlib.sha256(content).hexdigest(), seconds=1.0, size=(64, 36))


def test_another_film_than_the_listed_one_is_left_out_and_said_to_be(
    found: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever was handed in since, the stamp lists one film, and its bytes alone are put into the page."""
    beside = found.run.folder / "handed_in.mp4"
    beside.write_bytes(b"another film")
    monkeypatch.setattr(material, "film_handed_in", lambda _: film(b"another film"))
    found.handed_in = found.handed_in_path = None
    found.stamp.predicate.handed_in = None
    material._handed_in(found)
    assert found.handed_in is None and "none that its stamp lists" in found.missing.pop("handed-in film")
    found.stamp.predicate.handed_in = film(b"the listed film")
    material._handed_in(found)
    assert (
        found.handed_in == film(b"the listed film") and "none that its stamp lists" in found.missing["handed-in film"]
    )
    assert media.handed_in(found.handed_in_path, found.handed_in.sha256) == ""
    beside.write_bytes(b"the listed film")
    assert media.handed_in(found.handed_in_path, found.handed_in.sha256).startswith("data:video/mp4;base64,")


def test_a_scene_that_was_not_written_here_or_is_of_another_recording_is_left_out(tmp_path: Path) -> None:
    """It says of itself which recording it shows; whoever writes one can write that, too."""
    run, accepted = Run(tmp_path), "a" * 64
    assert exported.scene(run, accepted) == (None, "")
    forged = b'glTF....{"asset":{"extras":{"recording_sha256":"' + accepted.encode() + b'"}}}'
    (tmp_path / "scene.glb").write_bytes(forged)
    data, why = exported.scene(run, accepted)
    assert data is None and "was not written here" in why
    made_scenes.note(tmp_path, b"an honest scene", accepted)
    assert exported.scene(run, accepted)[0] is None
    (tmp_path / "scene.glb").write_bytes(b"an honest scene")
    made_scenes._MADE.clear()  # another process
    assert exported.scene(run, accepted) == (b"an honest scene", "")
    data, why = exported.scene(run, "b" * 64)
    assert data is None and "of another recording than the accepted one" in why


def test_no_scene_is_made_of_a_recording_that_calls_itself_another(reviewed: Path, tmp_path: Path) -> None:
    recording = shutil.copytree(next(reviewed.glob("evidence/*/physics/trajectory")), tmp_path / "trajectory")
    exported._sha256(recording)
    ended = json.loads((recording / "complete.json").read_bytes())
    (recording / "complete.json").write_text(json.dumps(ended | {"sha256": "0" * 64}))
    with pytest.raises(GateError, match="what it holds is"):
        exported._sha256(recording)

"""What `verify` judges is one copy of an accepted folder: whoever writes there meanwhile changes nothing of the answer."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.model.errors import GateError
from worldwright.model.evidence.run import Run
from worldwright.model.storage import StorageError
from worldwright.stamp import bundle, keyring, private_copy, signing, verification
from worldwright.stamp import tools as stamp
from worldwright.stamp.statement import Statement

Copy = Callable[[Path], Path]


def test_a_signature_that_changes_between_two_looks_is_the_one_of_the_first(
    accepted: Path, copy: Copy, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A stranger's signature lies there first; a genuine one, of another stamp even, put in its place later vouches for nothing."""
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

    folder = copy(accepted)
    inner = folder / "accepted"
    genuine = {name: (inner / name).read_bytes() for name in (signing.ENVELOPE, signing.PUBLIC)}
    signing.sign(inner, bundle.STAMP, Ed25519PrivateKey.generate())
    real = verification.static

    def and_then_swapped(*words: object) -> object:
        found = real(*words)  # type: ignore[arg-type]
        for name, content in genuine.items():
            (inner / name).write_bytes(content)
        (inner / "simulation.py").write_text("import another_world\n", encoding="utf-8")
        return found

    monkeypatch.setattr(verification, "static", and_then_swapped)
    result = stamp.verify(str(folder), timeout_s=600)
    assert result.state == "proved" and not result.ok, result.text()
    assert result.signature is not None and result.signature.holder == "unknown"


def test_the_copy_has_every_listed_byte_and_of_the_rest_the_names(accepted: Path, copy: Copy, tmp_path: Path) -> None:
    folder = copy(accepted)
    inner = folder / "accepted"
    (tmp_path / "of-the-host").write_text("a secret")
    (inner / "stills" / "extra.png").write_bytes(b"another picture")
    (inner / "a-link").symlink_to(tmp_path / "of-the-host")
    (inner / "plan.md").unlink()
    (inner / "plan.md").symlink_to(folder / "plan.md")
    with private_copy.of(Run(folder)) as taken:
        there = taken.stamped
        assert taken.name == folder.name and not there.is_relative_to(folder)
        assert taken.folder.parent.stat().st_mode & 0o077 == 0
        assert (there / "world.mjz").read_bytes() == (inner / "world.mjz").read_bytes()
        assert (taken.journal.read_bytes(), taken.plan.read_bytes()) == (
            (folder / "journal.jsonl").read_bytes(),
            (folder / "plan.md").read_bytes(),
        )
        assert (there / "stills" / "extra.png").read_bytes() == b""
        assert (there / "a-link").is_symlink() and not (there / "a-link").exists()
        told = bundle.damage(there, Statement.model_validate_json((inner / bundle.STAMP).read_bytes()))
        assert told == [
            "plan.md is a link",
            "a-link is a link, and not in the stamp",
            "stills/extra.png is not in the stamp",
        ]
    assert not taken.folder.exists()


def test_a_file_of_holes_that_no_disk_holds_is_refused_at_once(accepted: Path, copy: Copy) -> None:
    folder = copy(accepted)
    os.truncate(folder / "accepted" / "world.mjz", 1 << 43)
    with pytest.raises(StorageError) as caught, private_copy.of(Run(folder)):
        pass
    assert caught.value.code == "disk_full" and "world.mjz" in caught.value.place


def test_an_accepted_folder_behind_a_link_is_refused(accepted: Path, copy: Copy, tmp_path: Path) -> None:
    folder = copy(accepted)
    (folder / "accepted").rename(tmp_path / "elsewhere")
    (folder / "accepted").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(GateError, match="accepted/ is a link"):
        stamp.verify(str(folder))
    assert stamp.status(str(folder)).state == "open"


def test_what_a_killed_verification_left_is_removed_and_what_another_holds_is_not(accepted: Path) -> None:
    root = keyring.folder() / "copies"
    left = root / "left-by-a-killed-one"
    left.mkdir(parents=True, exist_ok=True)
    with private_copy.of(Run(accepted)) as one, private_copy.of(Run(accepted)) as other:
        assert one.folder.exists() and other.folder.exists() and not left.exists()


def test_what_is_signed_was_never_in_the_run(reviewed: Path, copy: Copy, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whoever writes in the run folder while it is accepted reaches nothing that this machine's key is about to sign."""
    folder = copy(reviewed)
    real = signing.sign

    def watched(place: Path, *words: object) -> str:
        assert not place.resolve().is_relative_to(folder) and not list(folder.glob(f"{bundle.PREFIX}*"))
        return real(place, *words)  # type: ignore[arg-type]

    monkeypatch.setattr(signing, "sign", watched)
    while not stamp.accept(str(folder), timeout_s=60).ok:
        pass
    assert stamp.accept(str(folder), signing_key=keyring.folder() / keyring.OWN).already

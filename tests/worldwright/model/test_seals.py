"""A journal that was written anew, by who has no key, has no seal, however well it is chained."""

import json
from pathlib import Path

import pytest

from worldwright.model.evidence import seals
from worldwright.model.evidence.journal import Journal
from worldwright.model.evidence.run import Run
from worldwright.stamp import keyring, sealed


@pytest.fixture
def key(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("WORLDWRIGHT_DATA", str(tmp_path / "data"))
    return keyring.own().public_key()


def told(run: Run) -> str:
    return sealed.told(Journal(run.journal), sealed.known())


def test_each_line_is_sealed_and_the_chain_holds(tmp_path: Path, key) -> None:
    run = Run(tmp_path / "run")
    for action in ("approve", "describe", "review"):
        run.log("user", action, came={"how": "terminal"})
    journal = Journal(run.journal)
    assert journal.breaks() == [] and seals.by(journal, key) == (3, 3, ())
    assert told(run) == f"3 of 3 lines sealed by key sha256:{keyring.own_fingerprint()[:16]}"


def test_what_was_changed_moved_or_invented_is_not_sealed(tmp_path: Path, key) -> None:
    run = Run(tmp_path / "run")
    run.log("stamp", "approve", by="nobody")
    run.log("stamp", "review", reviewer="world-review")
    entries = list(run.entries())
    run.journal.unlink()
    entries[1]["reviewer"] = "a person who never saw it"
    for entry in (*entries, {"action": "describe", "seal": entries[0]["seal"]}):
        Journal(run.journal).append(entry)  # it drops seals and chains that it is given
    journal = Journal(run.journal)
    assert journal.breaks() == [] and seals.by(journal, key).many == 0
    assert told(run) == "NOT sealed: whoever can write the folder can have written it"
    run.log("stamp", "accept")
    assert told(run).endswith("; not sealed: 1 (approve), 2 (review), 3 (describe)")
    # A line with its own honest seal, in another place than it was written.
    lines = run.journal.read_text().splitlines()
    moved = json.loads(lines[3])
    stolen = Journal(tmp_path / "stolen.jsonl")
    stolen.append({k: v for k, v in moved.items() if k not in ("seal", "chain")}, lambda *_: moved["seal"])
    assert stolen.breaks() == [] and seals.by(stolen, key).many == 0


def test_without_a_key_of_its_own_a_process_seals_nothing_and_writes_all_the_same(
    tmp_path: Path, key, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = Run(tmp_path / "run")
    path = keyring.folder() / keyring.OWN
    path.chmod(0o644)  # others may have read it
    run.log("stamp", "approve")
    path.write_text("no key")
    path.chmod(0o600)
    run.log("stamp", "review")
    path.unlink()
    run.log("stamp", "accept")
    assert Journal(run.journal).breaks() == [] and seals.by(Journal(run.journal), key).many == 0
    assert [entry["action"] for entry in run.entries()] == ["approve", "review", "accept"]

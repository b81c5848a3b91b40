"""Who vouches for a stamp: this machine's key by default, keys that a person called known, and nobody else.

The attacks are those of somebody who can write the whole folder, recomputes every hash in it, and has no key of ours.
"""

import base64
import json
import stat
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from worldwright import expose
from worldwright.cli import main
from worldwright.model.errors import GateError
from worldwright.model.evidence.journal import Journal
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.stamp import bundle, keyring, signing, small_form
from worldwright.stamp import tools as stamp
from worldwright.stamp.statement import Statement
from worldwright.stamp.verification import static

Copy = Callable[[Path], Path]
Edit = Callable[[dict[str, Any]], None]


@pytest.fixture
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Another user's data folder: no key of this machine, and nobody known."""
    folder = tmp_path / "elsewhere"
    monkeypatch.setenv("WORLDWRIGHT_DATA", str(folder))
    return folder


def test_where_the_key_may_not_be_read_nothing_is_signed_and_its_owner_is_still_known(elsewhere, monkeypatch) -> None:
    """So it is in the shell of an agent, which root cannot be kept from by a file's mode: the opening itself is refused."""
    mine = signing.fingerprint(keyring.own().public_key())
    real = Path.open

    def refused(path: Path, *words: Any, **named: Any) -> Any:
        if path.name == keyring.OWN:
            raise PermissionError(13, "Permission denied")
        return real(path, *words, **named)

    monkeypatch.setattr(Path, "open", refused)
    with pytest.raises(signing.SigningError, match="shell of an agent may not") as no:
        keyring.own()
    assert "stamp.accept" in no.value.next_move and "terminal of your own" in no.value.next_move
    assert keyring.holder(mine) == ("own", "this machine") and keyring.own_fingerprint() == mine
    (elsewhere / keyring.PUBLIC).unlink()
    assert keyring.holder(mine) == ("unknown", "")


def forge(folder: Path, edit: Edit, program: str = "") -> None:
    """Change the stamp of a small form and recompute every hash and the whole journal, as one who has no key can."""
    path = folder / "simulation.py"
    before = sha256_file(path)
    path.write_text(path.read_text() + program)
    after, facts = sha256_file(path), json.loads((folder / bundle.STAMP).read_text())
    edit(facts["predicate"])
    entries = [{k: v for k, v in e.items() if k != "chain"} for e in Journal(folder / "journal.jsonl").entries()]
    entries = json.loads(json.dumps(entries).replace(before, after))
    accepts = next(i for i, e in enumerate(entries) if e["action"] == "accept")
    (folder / "journal.jsonl").unlink()
    journal = Journal(folder / "journal.jsonl")
    for entry in entries[:accepts]:
        if entry["action"] == "approve":
            entry["by"] = entry["actor"] = facts["predicate"]["approval"]["by"]
        journal.append(entry)
    facts["predicate"]["journal_head"] = journal.head()
    statement = Statement.model_validate_json(json.dumps(facts).replace(before, after))
    (folder / bundle.STAMP).write_text(statement.to_json())
    journal.append(entries[accepts] | {"stamp_sha256": sha256_file(folder / bundle.STAMP)})
    present = [s for s in statement.subject if (folder / s.name).is_file()]
    (folder / bundle.SUMS).write_text(bundle.sums(present, sha256_file(folder / bundle.STAMP)))


def approver(predicate: dict[str, Any]) -> None:
    predicate["approval"]["by"] = "the head of the laboratory"


def reviewer(predicate: dict[str, Any]) -> None:
    predicate["reviewer"] = "a person who never saw it"


def nothing(predicate: dict[str, Any]) -> None:
    pass


ATTACKS: dict[str, tuple[Edit, str]] = {
    "approver": (approver, ""),
    "reviewer": (reviewer, ""),
    "program": (nothing, "\n# another author's line\n"),
}


@pytest.fixture
def small(accepted: Path, tmp_path: Path) -> Path:
    target = tmp_path / "kept" / accepted.name
    small_form.write(Run(accepted), target)
    return target


def first_line(folder: Path, **options: Any) -> tuple[bool, str]:
    result = stamp.verify(str(folder), timeout_s=120, **options)
    # A world that is proved, and that nobody known here vouches for, is told by the exit code from one that is not.
    assert expose.exit_code(result) == (0 if result.ok else 3 if result.state == "proved" else 1)
    return result.ok, result.text().splitlines()[0]


def test_accept_signs_with_this_machines_key_and_verify_names_it(accepted: Path) -> None:
    fingerprint = keyring.own_fingerprint()
    ok, line = first_line(accepted)
    assert ok
    assert line.endswith(f"signed by this machine's key sha256:{fingerprint[:16]}")
    assert "this machine's key" in stamp.status(str(accepted)).text()


def test_the_signed_statement_holds_the_journals_head(accepted: Path) -> None:
    envelope = json.loads((accepted / "accepted" / signing.ENVELOPE).read_bytes())
    signed = Statement.model_validate_json(base64.b64decode(envelope["payload"]))
    journal = Journal(accepted / "journal.jsonl")
    assert signed.predicate.journal_head in list(journal.heads())
    key = f"lines sealed by key sha256:{keyring.own_fingerprint()[:16]}"
    lines = len(list(journal.entries()))
    (check,) = [c for c in static(Run(accepted), accepted / "accepted") if c.name == "journal"]
    # The last line is about the stamp itself; the first may be older than the key, which an approval makes.
    for said, of in ((signed.predicate.journal_seal, lines - 1), (check.detail, lines)):
        assert said.endswith((f"{of} of {of} {key}", f"{of - 1} of {of} {key}; not sealed: 1 (resolve)"))


def test_the_key_is_made_once_and_its_owners_alone(elsewhere: Path) -> None:
    key = keyring.own()
    path = elsewhere / keyring.OWN
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert keyring.own().private_bytes_raw() == key.private_bytes_raw()
    assert sorted(p.name for p in elsewhere.iterdir()) == [keyring.OWN, keyring.PUBLIC]
    path.chmod(0o640)
    with pytest.raises(signing.SigningError, match="others may read"):
        keyring.own()


@pytest.mark.parametrize("attack", ATTACKS)
def test_a_forged_folder_with_the_old_signature_is_refuted(small: Path, attack: str) -> None:
    forge(small, *ATTACKS[attack])
    checks = static(Run(small), small)
    (journal,) = [c for c in checks if c.name == "journal"]
    assert journal.ok and journal.detail.endswith("NOT sealed: whoever can write the folder can have written it")
    failing = {c.name: c.detail for c in checks if not c.ok}
    assert failing == {"signature": "another stamp was signed"}  # every hash of the attacker's own is right
    assert first_line(small) == (False, f"{small.name}: refuted")
    assert stamp.status(str(small)).state != "accepted"


@pytest.mark.parametrize("attack", ATTACKS)
def test_a_forged_folder_without_a_signature_is_no_yes_and_its_first_line_says_why(small: Path, attack: str) -> None:
    forge(small, *ATTACKS[attack])
    for name in (signing.ENVELOPE, signing.PUBLIC):
        (small / name).unlink()
    ok, line = first_line(small)
    assert not ok
    assert "UNSIGNED" in line and ": proved" in line
    assert first_line(small, anybody=True)[0]  # the world itself does what it claims; who said so is another question


def test_a_forged_folder_signed_by_the_attacker_is_no_yes_and_its_first_line_names_the_key(small: Path) -> None:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

    forge(small, *ATTACKS["approver"])
    theirs = Ed25519PrivateKey.generate()
    fingerprint = signing.sign(small, bundle.STAMP, theirs)
    ok, line = first_line(small)
    assert not ok
    assert "UNKNOWN" in line and fingerprint[:16] in line


def test_a_list_of_known_keys_beside_the_folder_is_not_believed(small: Path) -> None:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

    fingerprint = signing.sign(small, bundle.STAMP, Ed25519PrivateKey.generate())
    for place in (small, small.parent):
        keyring.trust(fingerprint, "the head of the laboratory", place / keyring.KNOWN)
    assert signing.check(small, bundle.STAMP).holder == "unknown"


def test_another_machine_knows_the_key_only_after_a_person_said_so(small: Path, elsewhere: Path) -> None:
    assert signing.check(small, bundle.STAMP).holder == "unknown"
    assert stamp.status(str(small)).state == "accepted"
    assert not (elsewhere / keyring.KNOWN).exists()  # looking does not make it known
    said = CliRunner().invoke(main, ["keys", "trust", str(small), "--name", "the other machine"])
    assert said.exit_code == 0, said.output
    found = signing.check(small, bundle.STAMP)
    assert (found.holder, found.name) == ("known", "the other machine")
    listed = CliRunner().invoke(main, ["keys", "show"]).output
    assert found.fingerprint in listed and "the other machine" in listed
    assert CliRunner().invoke(main, ["keys", "forget", f"sha256:{found.fingerprint[:12]}"]).exit_code == 0
    assert CliRunner().invoke(main, ["keys", "forget", found.fingerprint]).exit_code == 1
    assert signing.check(small, bundle.STAMP).holder == "unknown"


def test_finding_an_unsigned_stamp_does_not_sign_it(small: Path, tmp_path: Path) -> None:
    for name in (signing.ENVELOPE, signing.PUBLIC):
        (small / name).unlink()
    (tmp_path / "key.pem").write_bytes((keyring.folder() / keyring.OWN).read_bytes())
    for key in (None, tmp_path / "key.pem"):
        with pytest.raises(GateError, match="lint: not done"):
            stamp.accept(str(small), signing_key=key)
    assert signing.check(small, bundle.STAMP).holder == "unsigned"


def test_a_public_key_of_another_kind_is_a_typed_error(tmp_path):
    """One flipped bit in an Ed25519 key's file can make it name an algorithm that nobody knows."""
    pem = "-----BEGIN PUBLIC KEY-----\nMCowBQYDK2VsAyEA" + "A" * 43 + "=\n-----END PUBLIC KEY-----\n"
    (tmp_path / "stamp.pub").write_text(pem)
    with pytest.raises(signing.SigningError, match="cannot be read"):
        signing.public_key(tmp_path / "stamp.pub")

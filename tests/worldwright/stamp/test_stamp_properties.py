"""Whatever happens to the files of a run: status answers, and no gate opens that should not."""

import random
import shutil
import tempfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from worldwright.model.errors import WorldwrightError
from worldwright.stamp import bundle, signing
from worldwright.stamp import tools as stamp

SETTINGS = settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
NEVER = "accepted/ must not appear"


def spoil(folder: Path, choices: random.Random, count: int) -> None:
    """Delete, truncate, corrupt or replace random files, as crashes and clumsy hands do."""
    for _ in range(count):
        files = [p for p in folder.rglob("*") if p.is_file() or p.is_dir()]
        if not files:
            return
        path = choices.choice(files)
        what = choices.choice(["delete", "empty", "cut", "flip", "noise", "folder", "json"])
        if path.is_dir():
            shutil.rmtree(path)
            continue
        data = path.read_bytes()
        if what in ("delete", "folder"):
            path.unlink()
            if what == "folder":
                path.mkdir()
        elif what == "empty":
            path.write_bytes(b"")
        elif what == "cut":
            path.write_bytes(data[: choices.randrange(len(data) + 1)])
        elif what == "flip" and data:
            at = choices.randrange(len(data))
            path.write_bytes(data[:at] + bytes([data[at] ^ (1 << choices.randrange(8))]) + data[at + 1 :])
        elif what == "noise":
            path.write_bytes(choices.randbytes(64))
        else:
            path.write_text(choices.choice(["null", "[]", "{}", "[" * 5000, '{"ok": true}', '"x"', "1e999", "\x00"]))


@SETTINGS
@given(seed=st.integers(0, 2**32), count=st.integers(1, 6))
def test_status_never_raises_on_a_spoiled_folder(accepted: Path, seed: int, count: int) -> None:
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / accepted.name
        shutil.copytree(accepted, folder)
        spoil(folder, random.Random(seed), count)
        try:
            status = stamp.status(str(folder))
        except WorldwrightError as error:  # nothing that makes it a run is left
            assert error.next_move
            return
        assert status.next_move
        assert len(status.text()) < 20_000
        assert status.state in ("open", "accepted", "blocked")


@SETTINGS
@given(at=st.floats(0, 1), text=st.text(alphabet=st.characters(codec="utf-8"), min_size=1, max_size=20))
def test_an_edited_plan_is_never_accepted(reviewed: Path, at: float, text: str) -> None:
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / reviewed.name
        shutil.copytree(reviewed, folder)
        plan = (folder / "plan.md").read_bytes()
        cut = int(at * len(plan))
        (folder / "plan.md").write_bytes(plan[:cut] + text.encode() + plan[cut:])
        assert not next(s for s in stamp.status(str(folder)).steps if s.name == "approve").holds
        with pytest.raises(WorldwrightError):
            stamp.accept(str(folder), timeout_s=30)
        assert not (folder / "accepted").exists(), NEVER


EVIDENCE = ["lint.json", "scan.json", "expect.json", "visual.json", "review.json", "physics", "stills", "video"]


@SETTINGS
@given(gone=st.sets(st.sampled_from(EVIDENCE), min_size=1))
def test_missing_evidence_is_named_and_never_accepted(reviewed: Path, gone: set[str]) -> None:
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / reviewed.name
        shutil.copytree(reviewed, folder)
        evidence = folder / "evidence" / stamp.status(str(folder)).key
        for name in gone:
            path = evidence / name
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        steps = {s.name: s for s in stamp.status(str(folder)).steps}
        for name in gone:
            assert not steps[{"visual.json": "describe"}.get(name, name.removesuffix(".json"))].holds  # type: ignore[index]
        with pytest.raises(WorldwrightError):
            stamp.accept(str(folder), timeout_s=30)
        assert not (folder / "accepted").exists(), NEVER


@SETTINGS
@given(seed=st.integers(0, 2**32))
def test_a_flipped_bit_in_the_bundle_is_always_noticed(accepted: Path, seed: int) -> None:
    from worldwright.stamp.statement import Statement

    choices = random.Random(seed)
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "accepted"
        shutil.copytree(accepted / "accepted", folder)
        statement = Statement.model_validate_json((folder / "stamp.json").read_bytes())
        before = signing.check(folder, bundle.STAMP)
        path = folder / choices.choice(bundle.files_in(folder))
        data = path.read_bytes()
        if not data:
            return
        at = choices.randrange(len(data))
        path.write_bytes(data[:at] + bytes([data[at] ^ (1 << choices.randrange(8))]) + data[at + 1 :])
        after = signing.check(folder, bundle.STAMP)
        if path.name in (
            signing.ENVELOPE,
            signing.PUBLIC,
        ):  # a note beside the signature may change; who signed may not
            assert after.holder == "broken" or after == before
        else:
            assert bundle.damage(folder, statement) or not _loads(folder)


def _loads(folder: Path) -> bool:
    from worldwright.stamp.kept import Kept
    from worldwright.stamp.statement import Statement

    return Kept.read(folder / "stamp.json", Statement).value is not None

"""The journal: whatever happens to its bytes is noticed, and a crash loses at most the line being written."""

import errno
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldwright.model.evidence.journal import Journal
from worldwright.model.evidence.reports import EvidenceKey, LintReport
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.model.storage import StorageError

VALUES = st.one_of(st.text(max_size=12), st.integers(), st.booleans(), st.lists(st.text(max_size=4), max_size=3))
FIELDS = st.dictionaries(st.sampled_from(("actor", "note", "chain")), VALUES)
ENTRIES = st.lists(FIELDS.map(lambda found: {"action": "step", **found}), min_size=1, max_size=6)
QUICK = settings(max_examples=60, deadline=None)


def written(path: Path, entries: list[dict]) -> Journal:
    journal = Journal(path)
    for entry in entries:
        journal.append(entry)
    return journal


def test_a_folder_in_place_of_the_journal_is_named(tmp_path):
    (tmp_path / "journal.jsonl").mkdir()
    journal = Journal(tmp_path / "journal.jsonl")
    assert list(journal.entries()) == []
    assert journal.breaks() == ["the journal is a folder, not a file"]


@QUICK
@given(ENTRIES)
def test_what_is_written_is_read_and_the_chain_holds(entries):
    with tempfile.TemporaryDirectory() as scratch:
        journal = written(Path(scratch, "j"), entries)
        read = list(journal.entries())
        assert [{k: v for k, v in e.items() if k != "chain"} for e in read] == [
            {k: v for k, v in e.items() if k != "chain"} for e in entries
        ]
        assert journal.breaks() == []
        assert list(journal.heads())[-1] == journal.head() == read[-1]["chain"]


@QUICK
@given(ENTRIES, st.data())
def test_any_edited_byte_is_noticed(entries, data):
    """In the chain itself, or by the head that a stamp holds."""
    with tempfile.TemporaryDirectory() as scratch:
        journal = written(Path(scratch, "j"), [*entries, {"action": "last"}])
        head, before = journal.head(), journal.path.read_bytes()
        at = data.draw(st.integers(0, len(before) - 2))
        bit = data.draw(st.integers(0, 7))
        journal.path.write_bytes(before[:at] + bytes([before[at] ^ (1 << bit)]) + before[at + 1 :])
        assert journal.breaks() or head not in journal.heads()


@QUICK
@given(ENTRIES, st.data())
def test_a_line_taken_out_or_put_in_is_noticed(entries, data):
    with tempfile.TemporaryDirectory() as scratch:
        journal = written(Path(scratch, "j"), [{"action": "first"}, *entries, {"action": "last"}])
        lines = journal.path.read_bytes().splitlines(keepends=True)
        at = data.draw(st.integers(1, len(lines) - 2))
        journal.path.write_bytes(b"".join(lines[:at] + lines[at + 1 :]))
        assert journal.breaks()
        journal.path.write_bytes(b"".join([*lines[:at], b'{"action": "approve"}\n', *lines[at:]]))
        assert "not written by worldwright" in journal.breaks()[0]


@QUICK
@given(ENTRIES, st.integers(1, 200))
def test_a_torn_last_line_loses_that_line_and_nothing_else(entries, cut):
    with tempfile.TemporaryDirectory() as scratch:
        journal = written(Path(scratch, "j"), entries)
        whole = len(journal.path.read_bytes())
        journal.append({"action": "torn"})
        torn = journal.path.read_bytes()
        journal.path.write_bytes(torn[: max(whole, len(torn) - cut)])
        journal.append({"action": "after"})
        assert journal.breaks() == []
        assert [e.get("action") for e in journal.entries()][-1] == "after"
        assert len(list(journal.entries())) >= len(entries) + 1


def test_an_older_journal_is_bound_as_a_whole(tmp_path):
    path = tmp_path / "j"
    path.write_text('{"action": "approve"}\n{"action": "lint"}\n')
    journal = written(path, [{"action": "stage"}])
    assert journal.breaks() == []
    path.write_bytes(path.read_bytes().replace(b"approve", b"approvX"))
    assert journal.breaks()


def test_many_writers_at_once_make_one_chain(tmp_path):
    script = (
        "import sys; from pathlib import Path; from worldwright.model.evidence.journal import Journal\n"
        "for i in range(25): Journal(Path(sys.argv[1])).append({'by': sys.argv[2], 'i': i})"
    )
    path = tmp_path / "j"
    writers = [subprocess.Popen([sys.executable, "-c", script, str(path), str(n)]) for n in range(4)]
    assert [w.wait() for w in writers] == [0] * 4
    journal = Journal(path)
    assert journal.breaks() == []
    assert len(list(journal.entries())) == 100
    for n in range(4):
        assert [e["i"] for e in journal.entries() if e["by"] == str(n)] == list(range(25))


LIMITED = """
import resource, sys
from pathlib import Path
from worldwright.model.evidence.run import Run
from worldwright.model.storage import StorageError
run = Run(sys.argv[1])
run.log("tester", "first")
size = run.journal.stat().st_size
import signal; signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (size + 20, size + 20))
try:
    run.log("tester", "second", note="x" * 100)
except StorageError as error:
    print(error.code, run.journal.stat().st_size == size, bool(error.next_move))
"""


def test_a_line_that_the_disk_does_not_take_is_taken_back(tmp_path):
    done = subprocess.run([sys.executable, "-c", LIMITED, str(tmp_path)], capture_output=True, text=True, check=False)
    assert done.stdout.split() == ["disk_full", "True", "True"], done.stderr
    Run(tmp_path).log("tester", "third")
    assert Journal(tmp_path / "journal.jsonl").breaks() == []


def test_a_report_on_a_full_disk_leaves_the_older_one(tmp_path, monkeypatch):
    run = Run(tmp_path)
    key = EvidenceKey(program_sha256="a", plan_sha256="b", environment_sha256="c")
    path = run.keep(key, "lint", LintReport(rules=1))

    def full(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(StorageError, match="nothing that stood there was changed") as caught:
        run.keep(key, "lint", LintReport(rules=2))
    assert caught.value.code == "disk_full"
    assert json.loads(path.read_text())["rules"] == 1
    assert sorted(p.name for p in path.parent.iterdir()) == ["key.json", "lint.json"]


def test_each_line_says_how_program_and_plan_stood_and_which_reports_were_kept(tmp_path):
    run = Run(tmp_path)
    run.plan.write_text("a plan")
    run.program.write_text("print()")
    key = run.evidence_key("environment")
    path = run.keep(key, "lint", LintReport(rules=1))
    run.log("lint", "lint", key=key.key)
    (entry,) = run.entries()
    assert (entry["actor"], entry["action"]) == ("lint", "lint")
    assert entry["program_sha256"] == key.program_sha256
    assert entry["plan_sha256"] == key.plan_sha256
    assert entry["reports"] == {"lint": sha256_file(path)}
    assert (run.evidence(key) / "source" / "simulation.py").read_text() == "print()"
    run.log("stage", "stage")
    assert "reports" not in list(run.entries())[-1]

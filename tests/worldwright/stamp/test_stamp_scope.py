"""What was changed by another way than a legal step refuses acceptance, by name, with the way back."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.lint import tools as lint
from worldwright.model.errors import GateError
from worldwright.model.evidence.journal import Journal
from worldwright.model.evidence.run import Run
from worldwright.stamp import gates
from worldwright.stamp import tools as stamp
from worldwright.stamp.going import Going
from worldwright.stamp.state import State

Copy = Callable[[Path], Path]


def refused(folder: Path) -> list:
    return gates.refusals("accept", State.find(str(folder)))


def flip(path: Path, at: int = -2) -> None:
    data = bytearray(path.read_bytes())
    data[at] ^= 1
    path.write_bytes(bytes(data))


def test_the_journal_says_who_did_what_on_which_hashes(reviewed: Path) -> None:
    journal = Journal(Run(reviewed).journal)
    assert journal.breaks() == []
    entries = list(journal.entries())
    actions = [e["action"] for e in entries]
    assert actions == ["resolve", "approve", "lint", "stage", "stage", "stage", "scan", "expect", "describe", "review"]
    assert all(e["actor"] and e["plan_sha256"] and e["chain"] for e in entries)
    assert all(e["program_sha256"] for e in entries[1:])
    assert all(e["result_sha256"] for e in entries if e["action"] == "stage")
    assert refused(reviewed) == []


def test_a_program_changed_by_nobody_is_named_and_can_be_restored(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    program = folder / "simulation.py"
    before = program.read_bytes()
    program.write_bytes(before + b"# somebody was here\n")
    (folder / "simulation.py.changed").write_text("kept of an earlier time")
    (refusal,) = refused(folder)
    assert "simulation.py was changed since the last legal step (lint by lint" in refusal.cause
    status = stamp.status(str(folder))
    assert any("outside the write scope: simulation.py" in note for note in status.notes)
    assert status.next_move == refusal.next_move
    first, back = refusal.next_move.split("; or, if nobody meant the change, ")
    assert first.startswith("worldwright lint check-program"), "a changed program is mostly its author's"
    keep, restore = (command.split() for command in back.split(" && "))
    assert keep[0] == restore[0] == "cp" and keep[1] == restore[2] == str(program)
    shutil.copy(*keep[1:])
    shutil.copy(*restore[1:])
    assert (folder / "simulation.py.changed").read_text() == "kept of an earlier time"
    assert program.read_bytes() == before and b"somebody was here" in Path(keep[2]).read_bytes()
    assert refused(folder) == []


def test_a_walk_goes_on_from_a_program_that_was_changed_and_changed_back(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    program = folder / "simulation.py"
    before = program.read_bytes()
    program.write_bytes(before + b"# another try\n")
    lint.check_program([program])
    program.write_bytes(before)
    (refusal,) = refused(folder)
    assert "changed since the last legal step (lint" in refusal.cause and ".changed" not in refusal.next_move
    assert Going(Run(folder)).lint()
    assert refused(folder) == []


def test_a_plan_changed_after_its_approval_is_named(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    plan = folder / "plan.md"
    plan.write_text(plan.read_text(encoding="utf-8").replace("time_step: 0.002", "time_step: 0.001"), encoding="utf-8")
    (refusal,) = refused(folder)
    assert "plan.md was changed since the last legal step (approve by tester" in refusal.cause
    assert "stamp approve" in refusal.next_move
    with pytest.raises(GateError, match=r"plan\.md was changed"):
        stamp.accept(str(folder))


@pytest.mark.parametrize("name", ["lint", "scan", "expect", "interventions", "visual", "review"])
def test_a_report_written_by_hand_is_not_believed(reviewed: Path, copy: Copy, name: str) -> None:
    folder = copy(reviewed)
    path = State.find(str(folder)).folder / f"{name}.json"
    path.write_text(json.dumps(json.loads(path.read_text())), encoding="utf-8")  # the same words, other bytes
    (refusal,) = refused(folder)
    assert f"{name}.json is not what its step wrote" in refusal.cause
    assert refusal.next_move


def test_a_result_written_by_hand_is_not_believed(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    flip(State.find(str(folder)).folder / "physics" / "result.json", at=-5)
    (refusal,) = refused(folder)
    assert "physics/result.json is not what its step wrote" in refusal.cause


def test_an_approval_slipped_into_the_journal_opens_nothing(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    with (folder / "journal.jsonl").open("a", encoding="utf-8") as journal:
        journal.write('{"actor": "user", "action": "approve"}\n')
    (refusal,) = refused(folder)
    assert "the journal was changed: line 11 was not written by worldwright" in refusal.cause


def test_without_its_journal_nothing_is_vouched_for(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    (folder / "journal.jsonl").unlink()
    stamp.approve(str(folder), by="tester")
    assert any("no line of the journal vouches for physics/result.json" in r.cause for r in refused(folder))


def test_the_stamp_holds_the_head_of_the_journal(accepted: Path, copy: Copy) -> None:
    folder = copy(accepted)
    journal = folder / "journal.jsonl"
    lines = journal.read_bytes().splitlines(keepends=True)
    assert json.loads(lines[-1])["action"] == "accept"
    head = json.loads((folder / "accepted" / "stamp.json").read_text())["predicate"]["journal_head"]
    assert head == json.loads(lines[-2])["chain"]
    journal.write_bytes(lines[0])  # a shorter journal, whose chain holds
    assert Journal(journal).breaks() == []
    result = stamp.verify(str(folder))
    assert not result.ok
    assert "FAIL journal: it lacks the line that stood last" in result.text()

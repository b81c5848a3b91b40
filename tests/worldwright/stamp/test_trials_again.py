"""Repetitions that nobody made are found by verification, which simulates some of them again, drawn anew each time."""

from collections import Counter
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

from worldwright.model.errors import GateError
from worldwright.model.evidence.audits import Held, RefineReport, RobustReport, Trial
from worldwright.model.evidence.reports import ExpectReport
from worldwright.model.evidence.run import Run
from worldwright.scan import tools as scan
from worldwright.scan.audits import robustness
from worldwright.scan.audits.trials import label_of
from worldwright.stamp import audited, bundle, trials_again, verification
from worldwright.stamp import tools as stamp
from worldwright.stamp.state import State
from worldwright.stamp.statement import Statement

Copy = Callable[[Path], Path]
LABELS = [label_of(words) for words in robustness.WORLDS]


def resealed(folder: Path, report: RobustReport) -> None:
    """Lay a report into an accepted folder and compute every hash anew, as one who has no key of ours can."""
    inner = folder / "accepted"
    (inner / "evidence" / "robust.json").write_text(report.model_dump_json(), encoding="utf-8")
    statement = Statement.model_validate_json((inner / "stamp.json").read_bytes())
    bundle.seal(inner, statement.model_copy(update={"subject": bundle.subjects(inner)}))
    for other in (inner / "stamp.dsse.json", inner / "stamp.pub", folder / "journal.jsonl"):
        other.unlink()


def test_invented_repetitions_are_refuted(accepted: Path, copy: Copy) -> None:
    folder = copy(accepted)
    inner = folder / "accepted"
    proof = Statement.model_validate_json((inner / "stamp.json").read_bytes()).predicate.proof
    expected = ExpectReport.model_validate_json((inner / "evidence" / "expect.json").read_bytes())
    holding = [
        (o.index, e.name)
        for o in expected.objectives
        for e in o.expectations
        if e.status == "holds" and not e.needs_stills
    ]
    invented = RobustReport(
        trajectory_sha256=proof.trajectory_sha256,
        worlds=tuple(Trial(label=label, trajectory_sha256="0" * 64) for label in LABELS),
        claims=tuple(Held(objective=i, name=name, holds=len(LABELS), of=len(LABELS)) for i, name in holding),
    )
    resealed(folder, invented)
    while (result := stamp.verify(str(folder), timeout_s=60, anybody=True)).state == "running":
        pass
    (check,) = [c for c in result.checks if c.name == trials_again.NAME]
    assert result.state == "refuted" and not check.ok, result.text()
    assert check.detail.startswith("robust: ") and "moved as 0000000000000000, and it moves as" in check.detail


def test_acceptance_makes_a_part_of_the_audits_again_before_it_signs(
    reviewed: Path, copy: Copy, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = copy(reviewed)
    state, run = State.find(str(folder)), Run(folder)
    told = {"trajectory_sha256": state.trajectory_sha256, "time_step": 0.002, "refined_time_step": 0.001}
    run.keep(state.key, "refine", RefineReport(**told, refined_sha256="1" * 64))
    run.log("scan", "refine", key=state.key.key)
    monkeypatch.setattr(audited, "unshown", lambda _: ())  # its kept recordings are as well forged as itself
    with pytest.raises(GateError, match="simulated again, the audit does not say what it shows: refine: ") as refused:
        accept(folder)
    assert "moved as 1111111111111111, and it moves as" in refused.value.cause
    assert not (folder / "accepted").exists()
    monkeypatch.undo()
    (state.folder / "refine.json").unlink()
    while scan.scan(str(folder), refine=True, timeout_s=60).pending:
        pass
    accept(folder)
    statement = Statement.model_validate_json((folder / "accepted" / "stamp.json").read_bytes())
    assert statement.predicate.proof.simulated_again == ("refine",)


def accept(folder: Path) -> None:
    while stamp.accept(str(folder), timeout_s=60).state == "proving":
        pass


def test_no_part_is_spared_and_a_verification_that_goes_on_keeps_what_it_drew(tmp_path: Path) -> None:
    (tmp_path / bundle.STAMP).write_bytes(b"a stamp")
    parts = [SimpleNamespace(name=f"robust: {label}") for label in LABELS]
    chosen: Counter[str] = Counter()
    for number in range(200):
        scratch = tmp_path / str(number)
        scratch.mkdir()
        drawn = trials_again._drawn(scratch)
        assert trials_again._drawn(scratch) == drawn
        chosen[min(parts, key=lambda part: trials_again._place(tmp_path, drawn, part)).name] += 1
    assert {*chosen} == {part.name for part in parts} and max(chosen.values()) < 80


@pytest.mark.parametrize("content", [b"{", b'{"worlds": 3}'])
def test_a_damaged_report_is_no_audit(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "evidence").mkdir()
    (tmp_path / "evidence" / "causes.json").write_bytes(content)
    proved = SimpleNamespace(run=None, recording=tmp_path, trajectory_sha256="")
    (check,) = trials_again.checks(
        tmp_path,
        tmp_path,
        proved,  # type: ignore[arg-type]
        stamped="",
        exact=True,
        vouched=True,
        every=False,
        deadline=0.0,
    )
    assert not check.ok and "causes.json is damaged" in check.detail


@pytest.mark.parametrize("exact", [True, False])
def test_an_audit_of_another_recording_is_none_of_this_world_on_any_machine(tmp_path: Path, exact: bool) -> None:
    (tmp_path / "evidence").mkdir()
    there = RobustReport(
        trajectory_sha256="1" * 64
    )  # what this machine proved, which elsewhere is not what was stamped
    (tmp_path / "evidence" / "robust.json").write_text(there.model_dump_json(), encoding="utf-8")
    proved = SimpleNamespace(run=None, recording=tmp_path, trajectory_sha256="1" * 64)
    (check,) = trials_again.checks(
        tmp_path,
        tmp_path,
        proved,  # type: ignore[arg-type]
        stamped="2" * 64,
        exact=exact,
        vouched=True,
        every=False,
        deadline=0.0,
    )
    assert not check.ok and check.detail == "robust.json is of another recording"


def test_the_command_that_goes_on_keeps_what_was_asked(
    accepted: Path, copy: Copy, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = copy(accepted)
    monkeypatch.setattr(verification, "_again", lambda *_: None)  # it needs longer than this call
    plain = stamp.verify(str(folder))
    assert plain.state == "running" and plain.next_move == f"worldwright stamp verify {folder}"
    signer = folder / "accepted" / "stamp.pub"
    asked = stamp.verify(str(folder), signer=signer, anybody=True, rebuild=True, every_trial=True)
    options = f"--signer {signer} --anybody --rebuild --every-trial"
    assert asked.state == "running" and asked.next_move == f"worldwright stamp verify {folder} {options}"

"""Acceptance asks the three audits of truth, and an audit of something else does not answer."""

from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.model.errors import GateError
from worldwright.model.evidence.audits import CauseResult, CausesReport, InterventionReport, RefineReport
from worldwright.model.evidence.run import Run
from worldwright.model.finding import Anomaly
from worldwright.report.material import gather
from worldwright.report.page import render
from worldwright.scan import tools as scan
from worldwright.stamp import audited, gates
from worldwright.stamp import tools as stamp
from worldwright.stamp.state import State

Copy = Callable[[Path], Path]
PUSH = {
    "kind": "force", "target": "ball", "body": "ball", "count": 40, "stretches": 1, "first_s": 0.1, "last_s": 0.2,
    "peak": 3.0, "unit": "N", "work_j": 0.5,
}  # fmt: skip


def refused(folder: Path) -> str:
    return " | ".join(r.cause for r in gates.refusals("accept", State.find(str(folder))))


def spoil(folder: Path, name: str, report: InterventionReport | RefineReport | CausesReport | None, **changes) -> None:
    """Let the scan have found something else, or nothing."""
    state = State.find(str(folder))
    if report is None:
        (state.folder / f"{name}.json").unlink()
        return
    run = Run(folder)
    run.keep(state.key, name, type(report).model_validate(report.model_dump() | changes))
    run.log("scan", name, key=state.key.key)


def recording(folder: Path) -> str:
    return State.find(str(folder)).trajectory_sha256


def anomaly(code: str, name: str) -> Anomaly:
    return Anomaly(
        code=code, name=name, severity="blocking", body="ball", window_s=(0.0, 0.1), measured=1.0, threshold=0.0,
        unit="claims", message="falls holds at 2 ms and fails at 1 ms",
    )  # fmt: skip


def test_a_clean_world_needs_only_its_ledger(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    assert refused(folder) == ""
    assert next(s for s in stamp.status(str(folder)).steps if s.name == "causes").status == "not_needed"
    spoil(folder, "interventions", None)
    assert "no interventions.json for this key" in refused(folder)
    scan.scan(str(folder))
    assert refused(folder) == ""


def test_a_ledger_of_another_recording_vouches_for_nothing(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    spoil(folder, "interventions", InterventionReport(trajectory_sha256="0" * 64))
    assert "interventions.json is of another recording" in refused(folder)


def test_an_undeclared_row_is_refused_and_shown_by_name(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    spoil(folder, "interventions", InterventionReport(trajectory_sha256=recording(folder), acting=(PUSH,)))
    assert "undeclared intervention: force on ball, 40 steps, 0.100-0.200 s: peak 3 N" in refused(folder)
    with pytest.raises(GateError, match="take it out of"):
        stamp.accept(str(folder))
    page = render(gather(Run(folder)))
    assert "undeclared</span> <b>force</b>" in page
    assert "undeclared interventions" in page


def test_a_damaged_audit_is_named(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    for name in ("interventions", "causes", "refine"):
        (State.find(str(folder)).folder / f"{name}.json").write_text("{", encoding="utf-8")
        assert any(f"{name}.json is damaged" in r.cause for r in audited.refusals(State.find(str(folder))))
    assert "interventions.json is not what its step wrote" in refused(folder)


def test_a_claim_that_the_time_step_decides_is_refused(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    report = RefineReport(
        trajectory_sha256=recording(folder), refined_sha256="1" * 64, time_step=0.002, refined_time_step=0.001
    )
    spoil(folder, "refine", report)  # it names no fault, and was never made
    assert "refine.json is told, not shown: of the repetition `time-step-factor 0.5`" in refused(folder)
    spoil(folder, "refine", report.model_copy(update={"anomalies": (anomaly("WS311", "numerical_artefact"),)}))
    assert "falls holds at 2 ms and fails at 1 ms" in refused(folder)
    page = render(gather(Run(folder)))
    assert "At half the time step" in page
    assert "numerical artefact" in page


def test_a_cause_that_is_none_is_refused_even_where_none_was_asked_for(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    staged = CauseResult(
        objective=0, claim="it falls", cause="foot", effect="falls", outcome="survives", message="it falls anyway"
    )
    spoil(
        folder,
        "causes",
        CausesReport(
            trajectory_sha256=recording(folder),
            causes=(staged,),
            anomalies=(anomaly("WS321", "effect_without_cause"),),
        ),
    )
    assert "effect_without_cause" in refused(folder)
    assert next(s for s in stamp.status(str(folder)).steps if s.name == "causes").status == "fails"
    page = render(gather(Run(folder)))
    assert "no cause" in page
    assert "it falls anyway" in page


def test_a_named_cause_is_taken_away_before_acceptance(
    planned: Path, copy: Copy, prepare: Callable[[Path], None]
) -> None:
    """The real thing: the plan names gravity, the world is refused, the audit runs, the world is accepted."""
    folder = copy(planned)
    plan = folder / "plan.md"
    text = plan.read_text(encoding="utf-8").replace("mode: cameras", "mode: none")
    assert "The ball falls to the floor." in text
    plan.write_text(
        text.replace("The ball falls to the floor.", "The ball falls to the floor.\n  cause: gravity"), encoding="utf-8"
    )
    prepare(folder)
    assert "objective 0 names its cause (gravity)" in refused(folder)
    assert stamp.status(str(folder)).next_move.endswith("--causes")
    spoil(folder, "causes", CausesReport(trajectory_sha256=recording(folder)))
    assert "objective 0 names gravity as its cause, and causes.json does not mention it" in refused(folder)
    while scan.scan(str(folder), causes=True).pending:
        pass
    assert refused(folder) == ""
    assert stamp.accept(str(folder), timeout_s=60).ok
    assert "evidence/causes.json" in (folder / "accepted" / "SHA256SUMS").read_text()
    page = render(gather(Run(folder)))
    state = State.find(str(folder))
    assert state.causes.value
    told = state.causes.value.model_copy(update={"trials": ()})
    assert scan.unlike_trials(Run(folder), {"causes": told})
    assert "<b>gravity</b> causes falls" in page
    assert "1/1" in page

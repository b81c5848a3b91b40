"""Each claimed outcome emerged, was declared, was only drawn, was timed, or was never tested; by evidence that is as stamped."""

import hashlib
import json
import shutil
from pathlib import Path

import pytest

from worldwright.judge import staging_audit
from worldwright.model.errors import NotFoundError, WorldwrightError
from worldwright.model.evidence.audits import Acting, CauseResult, CausesReport, HelperResult, InterventionReport
from worldwright.model.evidence.reports import ExpectReport, ObjectiveResult
from worldwright.model.evidence.run import Run

MOTOR = Acting(
    kind="control", target="motor", body="motor", count=9, stretches=1, first_s=0, last_s=1, peak=1, unit="N",
    work_j=2, declared=True,
)  # fmt: skip


def expected(*status):
    return ExpectReport(
        trajectory_sha256="t",
        objectives=tuple(ObjectiveResult(index=i, claim="c", status=word) for i, word in enumerate(status)),
    )


def ledger(*acting):
    return InterventionReport(trajectory_sha256="t", acting=acting)


def causes(*helpers, timed=()):
    found = tuple(
        CauseResult(objective=i, claim="c", cause="x", effect="e", outcome=word, message="") for i, word in timed
    )
    return CausesReport(trajectory_sha256="t", helpers=helpers, causes=found)


def helper(*needed, target="motor", failed=False):
    return HelperResult(kind="control", target=target, law="1 N", needed_by=needed, failed=failed, message="said")


SECOND = MOTOR.model_copy(update={"target": "second"})


@pytest.mark.parametrize(
    ("given", "found"),
    [
        ((expected("proved", "visual_only"), ledger(), None), ("emerged", "drawn")),
        ((expected("proved", "proved"), ledger(MOTOR), causes(helper(1))), ("emerged", "declared")),
        ((expected("proved"), ledger(MOTOR), None), ("untested",)),
        ((expected("proved"), ledger(MOTOR), causes()), ("untested",)),
        ((expected("proved"), ledger(MOTOR), causes(helper(failed=True))), ("untested",)),
        ((expected("proved"), ledger(MOTOR), causes(helper())), ("emerged",)),
        ((expected("proved"), ledger(MOTOR, SECOND), causes(helper(), helper(target="second"))), ("untested",)),
        ((expected("proved"), ledger(MOTOR, SECOND), causes(helper(), helper(0, target="second"))), ("declared",)),
        ((expected("proved"), ledger(MOTOR.model_copy(update={"declared": False})), causes(helper())), ("untested",)),
        (
            (expected("proved", "proved"), ledger(), causes(timed=[(0, "survives"), (1, "caused")])),
            ("timed", "emerged"),
        ),
        ((expected("refuted", "unproved"), ledger(), None), ("untested", "untested")),
    ],
)
def test_an_outcome_is_told_by_ledger_and_causal_audit(given, found):
    assert staging_audit.origins(*given) == found


def test_many_worlds_are_counted_together():
    one = staging_audit.Staging(counts={"emerged": 2, "drawn": 1})
    found = staging_audit.together([one, staging_audit.Staging(counts={"emerged": 1})])
    assert found.text() == "of 4: 3 emerged, 1 drawn" and found.worlds == 2


def test_a_world_is_told_by_the_evidence_that_was_stamped(tmp_path):
    kept = Path(__file__).parents[3] / "examples/rolling-marble"
    run = Run(tmp_path / "run")
    (run.accepted / "evidence").mkdir(parents=True)
    with pytest.raises(NotFoundError, match="not accepted"):
        staging_audit.of_accepted(run)
    shutil.copy(kept / "stamp.json", run.accepted)
    with pytest.raises(NotFoundError, match=r"expect\.json"):
        staging_audit.of_accepted(run)
    stamp = json.loads((run.accepted / "stamp.json").read_text())
    for name, report in (("expect", expected("proved", "visual_only")), ("interventions", ledger())):
        content = report.model_dump_json().encode()
        (run.accepted / f"evidence/{name}.json").write_bytes(content)
        next(s for s in stamp["subject"] if s["name"] == f"evidence/{name}.json")["digest"]["sha256"] = hashlib.sha256(
            content
        ).hexdigest()
    with pytest.raises(WorldwrightError, match="not the one that was stamped"):
        staging_audit.of_accepted(run)
    (run.accepted / "stamp.json").write_text(json.dumps(stamp))
    assert staging_audit.of_accepted(run).counts == {"emerged": 1, "drawn": 1}
    film = next(s["digest"]["sha256"] for s in stamp["subject"] if s["name"].startswith("video/"))
    assert staging_audit.of_accepted(run, film).of == 2
    with pytest.raises(WorldwrightError, match="none of those"):
        staging_audit.of_accepted(run, "0" * 64)


def test_an_audit_of_before_says_in_words_that_a_trial_failed():
    row = {"kind": "control", "target": "motor", "law": "1 N", "needed_by": []}
    assert HelperResult.model_validate({**row, "message": "it could not be switched off: no such body"}).failed
    assert not HelperResult.model_validate({**row, "message": "nothing needs it"}).failed

"""A row that says that a world was driven live is held against the drive's statement, not taken at its word."""

import json
from pathlib import Path

import pytest

from small_worlds import heap, record
from worldengine.recording import stored
from worldwright.model.errors import GateError
from worldwright.model.evidence.reports import LintReport, PassResult
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.model.plan.committed import Intervention
from worldwright.stamp import driven_live, keyring, signing
from worldwright.stamp.proof import Proved

LAW = "driven live by Ada, whose commands were recorded"


def proved(run: Path, sha256: str = "") -> Proved:
    """A proof run of a recording, which moves as told."""
    recording = run / "trajectory"
    summary = {"trajectory_sha256": sha256 or stored.open(recording).sha256}
    return Proved(Run(run), PassResult(stage="physics", ok=True, summary=summary), LintReport(), recording)


@pytest.fixture
def run(tmp_path: Path) -> Path:
    """A run with a recording and the signed statement of the drive that it is."""
    record(heap(1, integrator="DISCRETE"), tmp_path / "trajectory", 3, None)
    told = {
        "driven_by": [{"driver": "Ada", "where": "here", "from_s": 0.0, "to_s": 1.0}],
        "trajectory_sha256": stored.open(tmp_path / "trajectory").sha256,
        "inputs_sha256": "0" * 64,
        "witnessed": True,
    }
    (tmp_path / "driven").mkdir()
    said = json.dumps({"predicateType": driven_live.PREDICATE, "predicate": told})
    (tmp_path / "driven" / "drive.json").write_text(said)
    signing.sign(tmp_path / "driven", "drive.json", keyring.own())
    return tmp_path


def row(run: Path, **changes: str) -> Intervention:
    source = f"drive 1, signed by the live run, drive.json sha256:{sha256_file(run / 'driven/drive.json')[:16]}"
    told = {"kind": "control", "bodies": ["cart"], "law": LAW, "trigger": "always", "source": source, **changes}
    return Intervention.model_validate(told)


def test_a_drive_that_is_shown_is_told_with_its_signature(run: Path) -> None:
    (told,) = driven_live.declared(Run(run), [row(run)], proved(run))
    assert "; it moves bit for bit as driven by Ada, whose drive was signed by this machine's key" in told
    (told,) = driven_live.declared(Run(run.parent), [row(run, law="a constant pull", source="given")], proved(run))
    assert told == "control on cart: a constant pull (trigger: always; source: given)"


def test_commands_that_were_changed_and_words_that_do_not_fit_are_refused(run: Path) -> None:
    def refused(where: Path, says: str, moves: str = "", **changes: str) -> None:
        with pytest.raises(GateError, match=says):
            driven_live.declared(Run(where), [row(run, **changes)], proved(run, moves))

    refused(run, "is not what Ada drove", moves="1" * 64)
    refused(run, "driven by Ada", law=LAW.replace("Ada", "Bob"))
    refused(run, r"another drive\.json", source="drive 1, drive.json sha256:" + "0" * 16)
    refused(run / "trajectory", r"no driven/drive\.json")
    forged = (run / "driven/drive.json").read_text().replace("Ada", "Bob")
    (run / "driven/drive.json").write_text(forged)
    refused(run, "another stamp was signed", law=LAW.replace("Ada", "Bob"))


def test_a_drive_that_nobody_signed_is_said_not_to_be_shown(run: Path) -> None:
    (run / "driven" / signing.ENVELOPE).unlink()
    (told,) = driven_live.declared(Run(run), [row(run)], proved(run))
    assert "NOT SHOWN that Ada drove it: UNSIGNED" in told

"""An acceptance whose proof run is an earlier call's says so: in its answer, its stamp, the journal and the report."""

from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.model.errors import GateError
from worldwright.model.evidence.run import Run
from worldwright.report.facts import provenance
from worldwright.report.material import gather
from worldwright.stamp import acceptance
from worldwright.stamp import tools as stamp
from worldwright.stamp.statement import Statement

Copy = Callable[[Path], Path]


def test_a_found_proof_is_told_with_its_time_and_key(
    reviewed: Path, copy: Copy, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = copy(reviewed)

    def refused(*_: object) -> None:
        raise GateError("a picture shows another world")

    with monkeypatch.context() as patch, pytest.raises(GateError, match="another world"):  # noqa: PT012 - until it ends
        patch.setattr(acceptance, "_look", refused)
        while not stamp.accept(str(folder), timeout_s=120).ok:
            pass
    while not (answer := stamp.accept(str(folder), timeout_s=60)).ok:
        pass
    proof = Statement.model_validate_json((folder / "accepted" / "stamp.json").read_bytes()).predicate.proof
    assert answer.ok and not answer.already and answer.proof_earlier and proof.earlier
    assert (answer.proof_began, answer.proof_key) == (proof.began, proof.key) and proof.began and len(proof.key) > 8
    told = f"begun {proof.began}, evidence key {proof.key}: an earlier call's, nothing was simulated by this one"
    assert told in answer.text()
    (line,) = [e for e in Run(folder).entries() if e["action"] == "accept"]
    assert (line["proof_began"], line["proof_earlier"]) == (proof.began, True)
    shown = dict(provenance(gather(Run(folder)))["Stamp"])["proof run"]
    assert f"evidence key {proof.key}: an earlier call's" in shown
    again = stamp.accept(str(folder))
    assert again.already and again.proof_earlier and told in again.text()

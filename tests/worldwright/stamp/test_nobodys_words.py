"""Of a stamp that nobody known here signed, what nothing proves is named as the words of nobody."""

from pathlib import Path

import pytest

from worldwright.stamp import bundle, nobodys_words
from worldwright.stamp.statement import Approval, Digest, Statement, Subject

EXAMPLE = Path(__file__).parents[3] / "examples" / "bouncing-basketball"


@pytest.fixture(scope="module")
def forged() -> Statement:
    honest = Statement.model_validate_json((EXAMPLE / bundle.STAMP).read_bytes())
    jane = Approval(by="Jane Doe", time="2026-01-01T00:00:00+00:00", came="a person at a terminal")
    said = {"approval": jane, "reviewer": "Richard Roe", "described_by": "Janie Doe"}
    robust = Subject(name="evidence/robust.json", digest=Digest(sha256="0" * 64))
    predicate = honest.predicate.model_copy(update=said)
    return honest.model_copy(update={"predicate": predicate, "subject": (*honest.subject, robust)})


def test_invented_people_and_reports_are_named(forged: Statement) -> None:
    told = nobodys_words.told(forged)
    assert told.ok and told.note
    for words in (
        "nobody known here signed",
        "approved in the name of Jane Doe (confirmed at a terminal)",
        "Richard Roe",
        "Janie Doe",
        "robust",
    ):
        assert words in told.detail


def test_a_report_that_is_not_there_is_not_named(forged: Statement) -> None:
    bare = forged.model_copy(update={"subject": ()})
    assert "reports" not in nobodys_words.told(bare).detail

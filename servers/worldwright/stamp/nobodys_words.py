"""What a stamp says that nobody known here signed and that no verification proves: whoever could write the folder can have
written it.

The world, its motion and what is measured of it are proved again whoever signed. Who approved, looked and reviewed, how it
was confined, and reports that nothing repeats rest on the signature alone.
"""

from collections.abc import Iterator

from ..model.evidence import came
from .as_stamped import Check
from .statement import Acceptance, Statement

REPORTS = ("visual", "review", "robust", "causes", "refine", "interventions")
"""Reports of the evidence that verification does not make again, or only in part (`trials_again`)."""


def told(statement: Statement) -> Check:
    """A note that names them, of a stamp that nobody known here vouches for."""
    words = "; ".join(_words(statement.predicate, {s.name for s in statement.subject}))
    detail = f"nobody known here signed them and nothing here proves them: {words}"
    return Check(name="words of nobody", ok=True, note=True, detail=detail)


def _words(said: Acceptance, listed: set[str]) -> Iterator[str]:
    yield f"approved {said.approval.told}{_how(said.approval.came)}"
    if said.described_by:
        yield f"described by {said.described_by}{_how(said.description_came)}"
    if said.reviewer:
        yield f"reviewed by {said.reviewer}{_how(said.review_came)}"
    yield f"confined by {said.proof.sandbox or 'nothing it names'}, accepted {said.accepted_at}"
    if reports := [name for name in REPORTS if f"evidence/{name}.json" in listed]:
        yield f"its reports {', '.join(reports)}"


def _how(said: str) -> str:
    return f" ({came.told(said)})" if said else ""

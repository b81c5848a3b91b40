"""Measure a plan's objectives on a recording: each ends up proved, refuted, visual only, or unproved."""

from types import FunctionType
from typing import Any

from pydantic import ValidationError

from ..model.errors import NotFoundError
from ..model.evidence import ExpectationResult, ExpectReport, ObjectiveResult
from ..model.plan import Objective, Plan
from ..model.trajectory import Trajectory
from ..shelf import Shelf
from .measured import UnknowableError

EXPECTATIONS = Shelf(
    "worldwright.scan.expectations", {"Given": type, "measure": FunctionType, "GOOD": tuple, "BAD": tuple}
)


def expect(trajectory: Trajectory, plan: Plan) -> ExpectReport:
    """Every objective with its measurements."""
    results = tuple(_objective(trajectory, number, objective) for number, objective in enumerate(plan.objectives))
    return ExpectReport(trajectory_sha256=trajectory.sha256, objectives=results)


def _objective(trajectory: Trajectory, index: int, objective: Objective) -> ObjectiveResult:
    measured = tuple(
        measure(trajectory, name, arguments if isinstance(arguments, dict) else {"body": arguments})
        for row in objective.expect
        for name, arguments in row.items()
    )
    states = {result.status for result in measured}
    if "fails" in states:
        failed = [f"{r.name}: {r.message}" for r in measured if r.status == "fails"]
        status, reason = "refuted", "; ".join(failed)
    elif measured and states == {"holds"}:
        status, reason = "proved", ""
    elif not measured and objective.visual_only:
        status, reason = "visual_only", objective.visual_only
    else:
        unknown = [f"{r.name}: {r.message}" for r in measured if r.status == "unknown"]
        status, reason = "unproved", "; ".join(unknown) or "nothing was expected of the recorded state"
    return ObjectiveResult.model_validate(
        {"index": index, "claim": objective.claim, "status": status, "reason": reason, "expectations": measured}
    )


def argument_problem(name: str, arguments: Any) -> tuple[str, str] | None:
    """What is wrong with the arguments of an expectation, and the fix; None when nothing is, or the name is unknown."""
    try:
        entry = EXPECTATIONS.find(name)
    except NotFoundError:
        return None
    try:
        entry.Given.model_validate(arguments if isinstance(arguments, dict) else {"body": arguments})
    except ValidationError as cause:
        first = cause.errors()[0]
        where = ".".join(str(part) for part in first["loc"]) or "arguments"
        fields = ", ".join(
            field + ("" if info.is_required() else "?") for field, info in entry.Given.model_fields.items()
        )
        return f"{where}: {first['msg']}", f"its arguments: {fields} (those with ? may be left out)"
    return None


def measure(trajectory: Trajectory, name: str, arguments: dict[str, Any]) -> ExpectationResult:
    """One expectation; an unknown name, wrong arguments or a missing channel is `unknown` with its reason."""
    try:
        entry = EXPECTATIONS.find(name)
        given = entry.Given.model_validate(arguments)
        found = entry.measure(trajectory, given)
    except ValidationError as cause:
        fields = EXPECTATIONS[name].Given.model_fields
        first = cause.errors()[0]
        where = ".".join(str(part) for part in first["loc"])
        message = f"{where}: {first['msg']}; arguments: {', '.join(fields)}"
        return ExpectationResult(name=name, arguments=arguments, status="unknown", message=message)
    except (NotFoundError, UnknowableError) as cause:
        message = f"{cause.cause}; {cause.next_move}" if cause.next_move else cause.cause
        return ExpectationResult(name=name, arguments=arguments, status="unknown", message=message)
    return ExpectationResult(
        name=name,
        arguments=arguments,
        status="holds" if found.margin >= 0 else "fails",
        measured=float(found.measured),
        expected=found.expected,
        margin=float(found.margin),
        unit=found.unit,
        message=found.message,
    )

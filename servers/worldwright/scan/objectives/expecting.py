"""Measure a plan's objectives on a recording: each ends up proved, refuted, visual only, or unproved with a reason."""

import math
from typing import Any

import numpy as np
from pydantic import ValidationError

from ...model.errors import NotFoundError
from ...model.evidence.reports import ExpectationResult, ExpectReport, ObjectiveResult
from ...model.plan.committed import Objective, Plan
from ...model.plan.in_view import mentioned
from ...model.recording.trajectory import Trajectory
from ...shelf import failed
from ..anomalies.wholes import as_named
from ..measuring.measured import UnknowableError
from .claims import EXPECTATIONS

TIMES = ("window_s", "before_s", "after_s", "at_s")


def expect(trajectory: Trajectory, plan: Plan) -> ExpectReport:
    """Every objective with its measurements."""
    duration = plan.simulation_parameters.simulation_duration
    end = None if isinstance(duration, str) else duration
    results = tuple(_objective(trajectory, number, objective, end) for number, objective in enumerate(plan.objectives))
    return ExpectReport(trajectory_sha256=trajectory.sha256, objectives=results)


def _objective(
    trajectory: Trajectory, index: int, objective: Objective, duration_s: float | None = None
) -> ObjectiveResult:
    found = tuple(
        measured(trajectory, name, named(arguments), duration_s)
        for row in objective.expect
        for name, arguments in row.items()
    )
    states = {result.status for result in found}
    if "fails" in states:
        failed = [f"{r.name}: {r.message}" for r in found if r.status == "fails"]
        status, reason = "refuted", "; ".join(failed)
    elif found and states == {"holds"}:
        status, reason = "proved", ""
    elif not found and objective.visual_only:
        status, reason = "visual_only", objective.visual_only
    else:
        unknown = [f"{r.name}: {r.message}" for r in found if r.status == "unknown"]
        nothing = (
            "nothing is expected of the recorded state; add `expect:`, or `visual_only: why it cannot be measured`"
        )
        status, reason = "unproved", "; ".join(unknown) or nothing
    return ObjectiveResult.model_validate(
        {"index": index, "claim": objective.claim, "status": status, "reason": reason, "expectations": found}
    )


def measured(
    trajectory: Trajectory, name: str, arguments: dict[str, Any], duration_s: float | None = None
) -> ExpectationResult:
    """Measure one expectation, unproved as long as the recording ends before the time that it speaks of."""
    return _unless_cut(trajectory, measure(trajectory, name, arguments), duration_s)


def _unless_cut(trajectory: Trajectory, result: ExpectationResult, duration_s: float | None) -> ExpectationResult:
    """Leave a claim unproved if the recording ends before the time that it speaks of, though it holds so far.

    A claim about a lasting state (no event, no window) speaks of the whole simulation.
    """
    if result.status != "holds":
        return result
    late = max((float(np.max(v)) for key in TIMES if (v := result.arguments.get(key)) is not None), default=0.0)
    lasting = not EXPECTATIONS[result.name].EVENT and "window_s" not in result.arguments
    if lasting and duration_s is not None:
        late = max(late, duration_s)
    end = float(trajectory.t[-1])
    if late <= end + max(2 * trajectory.interval_s, 1e-3 * late):
        return result
    message = f"the recording ends at {end:.3f} s, the claim speaks of {late:g} s; so far: {result.message}"
    return result.model_copy(update={"status": "unknown", "message": message})


def named(arguments: Any) -> dict[str, Any]:
    """The arguments as a mapping: a lone text stands for a body."""
    return {str(k): v for k, v in arguments.items()} if isinstance(arguments, dict) else {"body": arguments}


def argument_problem(name: str, arguments: Any) -> tuple[str, str] | None:
    """What is wrong with the arguments of an expectation, and the fix; None when nothing is, or the name is unknown."""
    try:
        entry = EXPECTATIONS.find(name)
    except NotFoundError:
        return None
    try:
        entry.Given.model_validate(named(arguments))
    except ValidationError as cause:
        first = cause.errors()[0]
        where = ".".join(str(part) for part in first["loc"])
        said = first["msg"].removeprefix("Value error, ")
        fields = ", ".join(
            field + ("" if info.is_required() else "?") for field, info in entry.Given.model_fields.items()
        )
        return f"{where}: {said}" if where else said, f"its arguments: {fields} (those with ? may be left out)"
    return None


def measure(trajectory: Trajectory, name: str, arguments: dict[str, Any]) -> ExpectationResult:
    """Measure one expectation; an unknown name, wrong arguments or a missing channel gives `unknown` with the reason."""

    def unknown(message: str) -> ExpectationResult:
        return ExpectationResult(name=name, arguments=arguments, status="unknown", message=message)

    try:
        entry = EXPECTATIONS.find(name)
    except NotFoundError as cause:
        return unknown(f"{cause.cause}; {cause.next_move}")
    if problem := argument_problem(name, arguments):
        return unknown("; ".join(problem))
    if not trajectory.finite:
        return unknown("the recording is not finite; see the scan's finding `nan`, and repair the simulation first")
    try:
        with np.errstate(all="ignore"):
            found = entry.measure(as_named(trajectory, mentioned(arguments)), entry.Given.model_validate(arguments))
    except (NotFoundError, UnknowableError) as cause:
        return unknown(f"{cause.cause}; {cause.next_move}" if cause.next_move else cause.cause)
    except np.linalg.LinAlgError as cause:
        return unknown(f"no curve can be fitted to what was recorded: {cause}; look at it with `query` and `plot`")
    except Exception as defect:  # a defect of one expectation must neither prove nor refute anything
        return unknown(f"the expectation {failed(entry, defect)}")
    if not (math.isfinite(found.measured) and math.isfinite(found.margin)):
        return unknown(f"the recording is not finite where it is measured: {found.message}")
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

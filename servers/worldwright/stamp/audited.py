"""What acceptance needs of the three audits: interventions, causes, refinement.

The ledger is made by every scan and always needed. The causal audit is needed when an objective names its cause, or when
a declared intervention is to be triggered by what happens. A person may order the refinement audit; then its findings
count too. An audit of another recording counts for nothing.
"""

from collections.abc import Iterator
from contextlib import suppress
from typing import Literal

from ..model.errors import CallOverError, WorldwrightError
from ..model.evidence.audits import CausesReport, InterventionReport, RefineReport, RobustReport
from ..model.evidence.build_steps import StepName
from ..model.evidence.run import Run
from .kept import Kept
from .refusal import Refusal
from .state import State

LONG_S = 60.0
"""What took longer is not repeated seven times unasked, s."""
BEFORE_ROBUST: tuple[StepName, ...] = ("causes", "stills", "video")
"""What comes before the worlds a little otherwise, for which nobody waits."""
Standing = Literal["absent", "damaged", "stale", "fails", "holds"]
Audit = InterventionReport | CausesReport | RefineReport


def standing(state: State, kept: Kept[InterventionReport] | Kept[CausesReport] | Kept[RefineReport]) -> Standing:
    """Whether an audit exists, can be read, belongs to this recording, and has no blocking finding."""
    if kept.value is None:
        return "damaged" if kept.problem else "absent"
    if kept.value.trajectory_sha256 != state.trajectory_sha256:
        return "stale"
    return "holds" if kept.value.ok else "fails"


def why_causes(state: State) -> str:
    """Why the causal audit is needed; empty when it is not."""
    for index, objective in enumerate(state.plan.objectives if state.plan else ()):
        if objective.cause:
            return f"objective {index} names its cause ({', '.join(objective.cause)})"
    ledger = state.interventions.value
    for row in ledger.acting if ledger else ():
        if row.declared and row.when == "state":
            return f"{row.kind} on {row.target} is declared to be set off by what happens ({row.trigger})"
    return ""


def findings(report: Audit) -> tuple[str, ...]:
    """The blocking findings of an audit, one line each."""
    blocking = tuple(str(a) for a in report.anomalies if a.severity == "blocking")
    if isinstance(report, InterventionReport):
        return (*(f"undeclared intervention: {row.text}" for row in report.undeclared), *blocking)
    if isinstance(report, RefineReport) and not report.refined_sha256:
        return blocking or ("the physics could not be repeated at a finer time step",)
    return blocking


def refusals(state: State) -> Iterator[Refusal]:
    """Refusals for audits that are needed and missing, that belong to another recording, or that have a blocking finding."""
    again = f"worldwright scan scan {state.place}"
    yield from _of(state, "interventions", state.interventions, again, needed="every acceptance rests on it")
    yield from _of(state, "causes", state.causes, f"{again} --causes", needed=why_causes(state))
    yield from _of(state, "refine", state.refine, f"{again} --refine", needed="")


def unshown(state: State) -> Iterator[Refusal]:
    """Refusals for audits that say otherwise than their kept repetitions show; nothing is simulated."""
    from ..scan import tools as scan

    robust = Kept.read(state.folder / "robust.json", RobustReport)
    if robust.sha256:
        state.sees(robust.path, robust.sha256)
    given = {"causes": state.causes.value, "refine": state.refine.value, "robust": robust.value}
    said = {name: report for name, report in given.items() if report is not None}
    try:
        found = scan.unlike_trials(state.run, said) if said else []
    except CallOverError:
        raise  # it tells nothing of the audits
    except WorldwrightError as error:
        yield Refusal(cause=f"the audits cannot be judged again: {error.cause}", next_move=error.next_move)
        return
    for sentence in found:
        name = sentence.partition(".")[0]
        yield Refusal(
            cause=sentence,
            next_move=f"rm {state.folder}/{name}.json && worldwright scan scan {state.place} --{name}",
        )


def robust_beside(run: Run, *, proving: bool = False) -> str:
    """Have the claims measured in worlds a little otherwise, which nothing waits for; says in a line how it stands.

    Of a long physics they are not asked for by themselves, and while it is proved ahead (`proving`) they wait for that, whose
    process begins them at its end: both would share a processor for which acceptance waits.
    """
    from ..scan.tools import begin_robust

    state = State(run)
    physics = state.passes["physics"].value
    if physics is not None and physics.wall_s > LONG_S and not (state.folder / "robust.json").is_file():
        return f"seven more passes of about {physics.wall_s:.0f} s; `worldwright scan scan {state.place} --robust` makes them"
    if proving and not (state.folder / "robust.json").is_file():
        return "the worlds a little otherwise are simulated once the proof run has ended; the report will tell"
    with suppress(WorldwrightError):  # a remark, which blocks nothing
        return begin_robust(run).removeprefix("robust: ")
    return ""


def _of(
    state: State,
    name: str,
    kept: Kept[InterventionReport] | Kept[CausesReport] | Kept[RefineReport],
    command: str,
    needed: str,
) -> Iterator[Refusal]:
    how = standing(state, kept)
    if how == "absent" and needed:
        yield Refusal(cause=f"there is no {name}.json for this key, and {needed}", next_move=command)
    elif how == "damaged":
        yield Refusal(cause=kept.problem, next_move=command)
    elif how == "stale":
        yield Refusal(cause=f"{name}.json is of another recording", next_move=command)
    elif how == "fails" and kept.value is not None:
        for finding in findings(kept.value):
            yield Refusal(cause=finding, next_move=_remedy(state, name))
    elif how == "holds" and name == "causes":
        for untested in _untested(state):
            yield Refusal(cause=untested, next_move=command)


def _untested(state: State) -> Iterator[str]:
    """Refusals for causes that the plan names and the audit has not tested."""
    report = state.causes.value
    tested = {(c.objective, c.cause) for c in report.causes} if report else set()
    for index, objective in enumerate(state.plan.objectives if state.plan else ()):
        for cause in objective.cause:
            if (index, cause) not in tested:
                yield f"objective {index} names {cause} as its cause, and causes.json does not mention it"


def _remedy(state: State, name: str) -> str:
    program, plan = f"{state.place}/simulation.py", f"{state.place}/plan.md"
    if name == "interventions":
        return (
            f"take it out of {program}, or declare it under simulation_parameters.interventions (law, bodies, source) "
            "and have the plan approved again"
        )
    if name == "causes":
        return f"let the effect come from its cause in {program}, or correct the cause in {plan} and approve it again"
    return f"correct the time step or the solver in {program}, or the claim in {plan}, and run the passes again"

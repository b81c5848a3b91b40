"""The steps of a run, derived from its files: which hold for the current key, what is missing, and the exact next command."""

from collections.abc import Callable
from typing import Literal

from ..model.evidence import approval, came, environment, handed_in, pictures_of
from ..model.evidence.build_steps import STEPS, StepName
from ..model.frozen import Frozen
from . import audited, descriptions, next_repair, recognition, signing
from .bundle import STAMP, damage
from .state import State

Holding = Literal["holds", "fails", "missing", "damaged", "not_needed"]


class Step(Frozen):
    """One step of the way to an accepted world."""

    name: StepName
    status: Holding
    """`fails`: done, and the answer is no. `damaged`: its file exists and cannot be used."""
    detail: str = ""
    next_move: str = ""
    """The command to run, when the step does not hold."""

    @property
    def done(self) -> bool:
        """Whether the step has a result for this key, good or bad."""
        return self.status in ("holds", "fails", "not_needed")

    @property
    def holds(self) -> bool:
        """Whether the step has a good result for this key, or is not needed."""
        return self.status in ("holds", "not_needed")


def steps(state: State) -> dict[StepName, Step]:
    """Every step, in order."""
    return {name: one(state, name) for name in STEPS}


def one(state: State, name: StepName) -> Step:
    """Where one step stands."""
    status, detail, command = DERIVED[name](state)
    return Step(name=name, status=status, detail=detail, next_move="" if status in ("holds", "not_needed") else command)


Answer = tuple[Holding, str, str]


def _check(state: State) -> Answer:
    command = f"worldwright lint check-plan {state.place}/plan.md"
    if not state.run.plan.is_file():
        return "missing", "there is no plan.md", f"write {state.place}/plan.md"
    if state.plan is None:
        return "damaged", state.plan_problem, command
    report = state.validation
    if report is None:
        return "missing", "the plan could not be checked", command
    errors = [f for f in report.findings if f.severity == "error"]
    if errors:
        return "fails", f"{len(errors)} error(s), first: {errors[0].code} {errors[0].message}", command
    questions = [point for point in state.plan.unresolved() if not _of_layout(point)]
    if questions:
        return "fails", _told(questions), f"answer them in {state.place}/plan.md"
    return "holds", state.plan.title or state.plan.plan_type, ""


def _place(state: State) -> Answer:
    command = f"worldwright place resolve {state.place}/plan.md"
    if state.plan is None:
        return "missing", "the plan cannot be read", f"worldwright lint check-plan {state.place}/plan.md"
    if rows := [point for point in state.plan.unresolved() if _of_layout(point)]:
        return "fails", _told(rows), command
    return "holds", f"{len(state.plan.object_names())} objects", ""


def _of_layout(point: str) -> bool:
    """Whether what is open in a plan is the pose of a row, which `place` answers."""
    return point.startswith("topology.scene_predicates.")


def _told(points: list[str]) -> str:
    return f"{len(points)} open point(s): {'; '.join(points[:3])}"


def _approve(state: State) -> Answer:
    command = f"worldwright stamp approve {state.place}"
    if not state.plan_sha256:
        return "missing", "there is no plan to approve", f"write {state.place}/plan.md"
    if state.approval:
        who = approval.told(str(state.approval.get("by", "")), auto=bool(state.approval.get("auto")))
        how = _how(came.of(state.approval))
        return "holds", f"{who}{how}, {state.approval.get('time', '')}", ""
    if names := approval.changed(state.journal, state.plan_sha256, state.model_hashes):
        return "missing", f"{', '.join(names)}, which the plan names, changed after it was approved", command
    if any(entry.get("action") == "approve" for entry in state.journal):
        return "missing", "the plan was changed after it was approved", command
    return "missing", "nobody has approved the plan", command


def _draft(state: State) -> Answer:
    if state.program_problem:
        missing = not state.run.program.exists()
        command = f"worldwright go {state.place}" if missing else f"correct {state.place}/simulation.py"
        return "missing" if missing else "damaged", state.program_problem, command
    return "holds", f"sha256 {state.program_sha256[:16]}", ""


def _lint(state: State) -> Answer:
    command = f"worldwright lint check-program {state.place}/simulation.py"
    report = state.lint.value
    if report is None:
        return _absent(state, state.lint.problem, "lint.json", command)
    errors = [f for f in report.findings if f.severity == "error"]
    if errors:
        return "fails", f"{len(errors)} error(s), first: {errors[0].code} {errors[0].message}", command
    return "holds", f"{report.rules} rules, no error" if report.rules else "no error", ""


def _physics(state: State) -> Answer:
    command = f"worldwright stage start {state.place} --stage physics"
    status, detail, _ = _pass(state, "physics", command)
    if status != "holds":
        return status, detail, command
    trajectory = state.folder / "physics" / "trajectory"
    if not (trajectory / "complete.json").is_file():
        return "missing", "the result is here but the recording is not", f"rm -r {state.folder}/physics && {command}"
    return "holds", detail, ""


def _stills(state: State) -> Answer:
    return _pass(state, "stills", f"worldwright stage start {state.place} --stage stills")


def _video(state: State) -> Answer:
    if state.plan is not None and state.plan.recording_mode.mode == "none":
        return "not_needed", "the plan films nothing", ""
    return _pass(state, "video", f"worldwright stage start {state.place} --stage video")


def _pass(state: State, stage: Literal["physics", "stills", "video"], command: str) -> Answer:
    kept = state.passes[stage]
    if kept.value is None:
        status, detail, command = _absent(state, kept.problem, f"{stage}/result.json", command)
        failure = state.failure(stage)
        return (status, failure or detail, command) if status == "missing" else (status, detail, command)
    if not kept.value.ok:
        where = f" at {kept.value.place}" if kept.value.place else ""
        return "fails", f"{kept.value.code}{where}: {kept.value.message}", kept.value.next_move or command
    if other := state.filmed_otherwise(stage):
        return "missing", other, command
    told = f"{kept.value.wall_s:.1f} s in the {kept.value.sandbox or 'unknown'} sandbox"
    source = kept.value.summary.get("reused_from")
    return "holds", f"recording of {source} taken over: only the pictures differ" if source else told, ""


def _scan(state: State) -> Answer:
    command = f"worldwright scan scan {state.place}"
    report = state.scan.value
    if report is None:
        return _absent(state, state.scan.problem, "scan.json", command)
    if report.trajectory_sha256 != state.trajectory_sha256:
        return "missing", "the scan is of another recording", command
    if report.code_sha256 != environment.checks():
        return "missing", "the scan is by another version of the checks", command
    blocking = [a for a in report.anomalies if a.severity == "blocking"]
    if blocking:
        return (
            "fails",
            f"{len(blocking)} blocking anomaly(ies), first: {blocking[0]}",
            next_repair.of_anomaly(state, blocking[0].code),
        )
    others = f", {len(report.anomalies)} not blocking" if report.anomalies else ""
    return "holds", f"{len(report.checks)} checks{others}", ""


def _expect(state: State) -> Answer:
    command = f"worldwright scan expect {state.place}"
    report = state.expect.value
    if report is None:
        return _absent(state, state.expect.problem, "expect.json", command)
    if report.trajectory_sha256 != state.trajectory_sha256:
        return "missing", "the expectations are of another recording", command
    if report.code_sha256 != environment.checks():
        return "missing", "the expectations are by another version of the checks", command
    count = len(report.objectives)
    proved = sum(o.status == "proved" for o in report.objectives)
    if report.waits and all(o.waits or o.status in ("proved", "visual_only") for o in report.objectives):
        drawn = _stills(state)
        if drawn[0] != "holds":
            return "missing", "what is claimed of pictures needs the stills", drawn[2]
        return "missing", "the stills were drawn since", command
    if not report.ok:
        first = next(o for o in report.objectives if o.status not in ("proved", "visual_only"))
        return (
            "fails",
            f"{proved} of {count} proved; objective {first.index} is {first.status}: {first.claim}",
            (f"correct {state.place}/simulation.py, one patch"),
        )
    return "holds", f"{proved} of {count} objectives proved, {count - proved} visual only", ""


def _causes(state: State) -> Answer:
    command = f"worldwright scan scan {state.place} --causes"
    why = audited.why_causes(state)
    how = audited.standing(state, state.causes)
    report = state.causes.value
    if how == "fails" and report is not None:
        found = audited.findings(report)
        return "fails", f"{len(found)} finding(s), first: {found[0]}", f"correct {state.place}/simulation.py, one patch"
    if how == "holds" and report is not None:
        shown = sum(c.outcome == "caused" for c in report.causes)
        return "holds", f"{shown} of {len(report.causes)} causes shown by {len(report.trials)} repetitions", ""
    if not why:
        return "not_needed", "no objective names a cause", ""
    if how == "stale":
        return "missing", "the causes are of another recording", command
    status, detail, command = _absent(state, state.causes.problem, "causes.json", command)
    return status, f"{detail}; {why}" if status == "missing" else detail, command


def _describe(state: State) -> Answer:
    command = f"worldwright stamp describe {state.place} @description.json"
    if state.visual.value is None:
        return _absent(state, state.visual.problem, "visual.json", command)
    visual = state.visual.value
    unseen = [] if visual.looked else [str(i) for i in descriptions.by_eye(state)]
    blind = f"; NOT LOOKED AT: objective {', '.join(unseen)}" if unseen else ""
    return "holds", f"by {visual.author}{_how(state.came('describe'))}{blind}", ""


def _review(state: State) -> Answer:
    command = f"worldwright stamp review {state.place} @verdict.json"
    verdict = state.review.value
    if verdict is None:
        status, detail, command = _absent(state, state.review.problem, "review.json", command)
        return status, "; ".join(filter(None, (detail, recognition.asked(state)))), command
    if verdict.outcome == "pass":
        return "holds", f"passed by {verdict.reviewer}{_how(state.came('review'))}", ""
    if verdict.outcome == "repair":
        return (
            "fails",
            f"repair {verdict.repair_target}: {verdict.repair}",
            next_repair.next_move(state, verdict.repair_target),
        )
    return "fails", "the reviewer calls it blocked", f'worldwright stamp block {state.place} "CAUSE"'


def _accept(state: State) -> Answer:
    command = f"worldwright stamp accept {state.place}"
    stamp = state.stamp.value
    if stamp is None:
        if state.stamp.problem or state.run.accepted.exists():
            return "damaged", state.stamp.problem or "accepted/ has no stamp.json", command
        return "missing", "not accepted", command
    broken = damage(state.run.stamped, stamp)
    if broken:
        return "damaged", f"{state.run.stamped.name}/: {broken[0]}", command
    source = stamp.predicate.source
    if source.plan_sha256 != state.plan_sha256:
        return "missing", "accepted/ is for an earlier plan", command
    if state.program_sha256 not in (source.program_sha256, stamp.digest_of("simulation.py")):
        return "missing", "accepted/ is for an earlier program", command
    if pictures_of.author_sha256(state.run) != (stamp.predicate.film.sha256 if stamp.predicate.film else ""):
        return "missing", "accepted/ is for another film.py", command
    signature = signing.check(state.run.stamped, STAMP)
    if signature.holder == "broken":
        return "damaged", f"{state.run.stamped.name}/: {signature.problem}", command
    # A handed-in film is no evidence, so another one takes nothing away from what was accepted.
    note = "; the film handed in since is listed when it is accepted anew" if handed_in_since(state) else ""
    return "holds", f"accepted {stamp.predicate.accepted_at}, {signature.text()}{note}", ""


def handed_in_since(state: State) -> bool:
    """Whether there is a handed-in film that the stamp does not list; one that is not kept here takes nothing away."""
    listed = state.stamp.value.predicate.handed_in if state.stamp.value else None
    try:
        now = handed_in.sha256(state.run.folder)
    except handed_in.HandedInError:
        return True
    return bool(now) and (listed is None or now != listed.sha256)


def _how(came_by: str) -> str:
    """How an approval or review was sent, in brackets; empty for lines of older versions."""
    return f" ({came_by})" if came_by else ""


def _absent(state: State, problem: str, name: str, command: str) -> Answer:
    if problem:
        return "damaged", problem, command
    if state.earlier(name):
        return "missing", "holds only for an earlier program, plan or environment", command
    return "missing", "not done for this program, plan and environment", command


DERIVED: dict[StepName, Callable[[State], Answer]] = {
    "check": _check,
    "place": _place,
    "approve": _approve,
    "draft": _draft,
    "lint": _lint,
    "physics": _physics,
    "stills": _stills,
    "video": _video,
    "scan": _scan,
    "expect": _expect,
    "causes": _causes,
    "describe": _describe,
    "review": _review,
    "accept": _accept,
}

"""The causal audit: take the cause away, and the effect must vanish; make it weaker, and the effect must respond.

For each objective with a `cause`: the physics pass is repeated without it, and its expectations must now fail (those that
merely mention the cause are left out: a ball that is not there touches nothing). Then it is repeated with the cause at
80 % and at 50 %: the moment of the effect, or what was measured, must move, or the effect must fail to come; one
perturbation would not be enough, since a timer hides in the slack of one. Each declared intervention is switched off
once, which tells the claims that depend on it.
"""

from dataclasses import dataclass, field
from itertools import product

from ...model.errors import NotFoundError
from ...model.evidence.audits import Acting, CauseResult, CausesReport, HelperResult, Response
from ...model.evidence.reports import ExpectationResult, ExpectReport
from ...model.finding import Anomaly, AnomalySeverity
from ...model.plan.committed import Plan
from ...model.recording.trajectory import Trajectory
from ..anomalies.declared import mentioned
from ..objectives import expecting
from . import moment, triggers
from .relayed import Relayed, relayed
from .switches import TOGETHER, Switches
from .trials import Trials, label_of

WEAKER = (0.8, 0.5)
RESPONDS = 1e-3
"""Relative change of a measured value that counts as a response."""


@dataclass
class Causes:
    """The causal audit of one recording; `plan_trials` asks for repetitions, `report` judges them."""

    trajectory: Trajectory
    plan: Plan
    acting: tuple[Acting, ...]
    trials: Trials
    singly: bool = False
    """As a report of before `switches` has it."""
    switches: Switches = field(init=False)
    expected: ExpectReport = field(init=False)

    def __post_init__(self) -> None:
        self.switches = Switches(self.trajectory, self.plan, self.acting, self.singly)
        self.expected = expecting.expect(self.trajectory, self.plan)

    def plan_trials(self) -> None:
        """Ask for every repetition that the judgement needs."""
        step = self.trajectory.time_step or self.trajectory.interval_s
        for objective in self.plan.objectives:
            for cause in objective.cause:
                self.ask(cause)
        if any(not (row.declared and row.when != "state") for row in triggers.discrete(self.acting, step)):
            for factor in triggers.SLOWER:
                if words := triggers.slower(self.plan, self.trajectory, factor):
                    self.trials.ask(*words)
        for words, _ in self.switches.groups():
            self.trials.ask(*words)

    def ask_without(self) -> int:
        """Ask only for the repetitions without each cause; how many these are."""
        labels = {self.trials.ask(*self.switches.without(cause)) for o in self.plan.objectives for cause in o.cause}
        return len(labels)

    def wrong_without(self) -> list[Anomaly]:
        """What blocks already by those, of whatever the repetitions with less of a cause will show."""
        told = [(i, c) for i, o in enumerate(self.plan.objectives) for c in o.cause]
        seen = [(i, c) for i, c in told if label_of(self.switches.without(c)) not in self.trials.limited]
        return self._anomalies(tuple(self.cause(i, c) for i, c in seen))

    def ask(self, cause: str) -> None:
        """Ask for the repetitions that one cause needs."""
        weaker = (self.switches.weaker(cause, factor) for factor in WEAKER)
        for words in (self.switches.without(cause), *weaker):
            self.trials.ask(*words)

    def report(self) -> CausesReport:
        """The judgement; every repetition must have been made or have failed."""
        step = self.trajectory.time_step or self.trajectory.interval_s
        causes = tuple(self.cause(i, cause) for i, o in enumerate(self.plan.objectives) for cause in o.cause)
        tested = {label: made for label, made in self.trials.made.items() if label.startswith("weaken")}
        found = tuple(triggers.judge(self.trajectory, row, tested) for row in triggers.discrete(self.acting, step))
        anomalies = [*self._anomalies(causes), *triggers.anomalies(found)]
        return CausesReport(
            trajectory_sha256=self.trajectory.sha256,
            trials=self.trials.told(),
            causes=causes,
            triggers=found,
            helpers=tuple(h for words, rows in self.switches.groups() for h in self.helpers(words, rows)),
            anomalies=tuple(anomalies),
        )

    # -- one objective -----------------------------------------------------------------------------------------------

    def cause(self, index: int, cause: str) -> CauseResult:
        """The judgement of one; its repetitions must have been made or have failed."""
        objective, known = self.plan.objectives[index], self.expected.objectives[index]
        effects = self._effects(index, cause)
        facts = {
            "objective": index,
            "claim": objective.claim,
            "cause": cause,
            "effect": objective.effect or ", ".join(e.name for e in effects),
            "as_planned": tuple(self._respond("as planned", self.trajectory, e) for e in effects),
        }
        gone = label_of(self.switches.without(cause))
        if not effects or any(e.status != "holds" for e in known.expectations):
            why = "no expectation measures the effect" if not effects else "the effect does not hold as planned"
            return CauseResult(**facts, outcome="unclear", message=f"{why}, so its cause cannot be tested")
        if gone in self.trials.failed:
            why = self.trials.failed[gone]
            return CauseResult(**facts, outcome="unclear", message=f"{cause} could not be taken away: {why}")
        without = tuple(self._respond(gone, self.trials.made[gone], e) for e in effects)
        silent = self._silent(cause, gone, facts["as_planned"])
        survivors = [e.name for e, r in zip(effects, without, strict=True) if r.status == "holds"]
        facts["without"] = without
        if len(survivors) == len(effects):
            message = f"without {cause}, {', '.join(survivors)} still holds: {cause} is not its cause"
            return CauseResult(**facts, outcome="survives", message=message)
        asked = [label_of(self.switches.weaker(cause, factor)) for factor in WEAKER]
        made = [label for label in asked if label in self.trials.made]
        # A cause that never moves and has no motor cannot be weakened: the repetition is then the same motion, bit for bit.
        labels = [label for label in made if self.trials.made[label].sha256 != self.trajectory.sha256]
        answers = [[self._respond(label, self.trials.made[label], e) for e in effects] for label in labels]
        facts["weakened"] = tuple(r for row in answers for r in row)
        moved, what = self._moves(facts["as_planned"], answers)
        vanishes = f"without {cause} the effect does not come"
        if hollow := [one.text for one in silent if not one.in_plan]:
            message = (
                f"{vanishes}, but neither does {' nor '.join(hollow)}, ever act then: what that would do without {cause} was "
                f"not tried. Let it act without waiting for {cause}, or say in its `trigger` what of {cause} sets it off"
            )
            return CauseResult(**facts, outcome="unclear", message=message)
        if silent:
            vanishes += f", for it sets off {' and '.join(one.text for one in silent)}, whose work without {cause} was not tried"
        if survivors:
            vanishes += f" (though {', '.join(survivors)} still holds)"
        stopped = [label for label in asked if label in self.trials.limited]
        if stopped and not moved:
            message = f"{vanishes}, and whether it follows when {cause} is weaker was not seen: {self.trials.failed[stopped[0]]}"
            return CauseResult(**facts, outcome="unclear", message=message)
        if not labels:
            why = "nothing of it moves" if made else self.trials.failed.get(asked[0], "")
            return CauseResult(**facts, outcome="caused", message=f"{vanishes}; it cannot be weakened: {why}")
        if not moved:
            message = (
                f"{vanishes}, but with {cause} at {' and '.join(f'{f:.0%}' for f in WEAKER)} nothing moves: {what}"
            )
            return CauseResult(**facts, outcome="timed", message=message)
        return CauseResult(**facts, outcome="caused", message=f"{vanishes}; weakened, {what}")

    def _silent(self, cause: str, gone: str, planned: tuple[Response, ...]) -> tuple[Relayed, ...]:
        """The drives that the repetition without the cause leaves silent; none of a cause that is all of them."""
        if self.singly or "control" in self._own(cause):
            return ()
        until = max((r.event_s for r in planned if r.event_s is not None), default=float(self.trajectory.t[-1]))
        return tuple(relayed(self.trajectory, self.trials.made[gone], self.acting, self._own(cause), until))

    @staticmethod
    def _own(cause: str) -> set[str]:
        return {part.strip().rpartition(":")[2].partition("/")[0] for part in cause.split(TOGETHER)}

    def _effects(self, index: int, cause: str) -> tuple[ExpectationResult, ...]:
        """The expectations that measure the effect: those that `effect` names, else those that do not mention the cause."""
        objective, results = self.plan.objectives[index], self.expected.objectives[index].expectations
        named = tuple(e for e in results if e.name in objective.effect.replace(",", " ").split())
        if named:
            return named
        own = self._own(cause)
        others = tuple(e for e in results if not own & mentioned(e.arguments))
        return others or results

    def _respond(self, trial: str, trajectory: Trajectory, effect: ExpectationResult) -> Response:
        try:
            found = expecting.measure(trajectory, effect.name, effect.arguments)
        except NotFoundError as unknown:
            return Response(trial=trial, status="unknown", message=str(unknown))
        at = moment.event_s(trajectory, effect.name, effect.arguments) if found.status == "holds" else None
        return Response(
            trial=trial,
            status=found.status,
            event_s=at,
            measured=found.measured,
            unit=found.unit,
            message=f"{effect.name}: {found.message}",
        )

    def _moves(self, planned: tuple[Response, ...], answers: list[list[Response]]) -> tuple[bool, str]:
        """Whether any weaker cause moved any effect: its moment if it has one, else its measured value."""
        still = []
        for row, (number, before) in product(answers, enumerate(planned)):
            after = row[number]
            if after.status != before.status:
                return True, f"{after.message} ({after.trial})"
            if before.event_s is not None and after.event_s is not None:
                if abs(after.event_s - before.event_s) > 1.5 * self.trajectory.interval_s:
                    return True, f"it comes at {after.event_s:.3f} s instead of {before.event_s:.3f} s ({after.trial})"
                still.append(f"it comes at {after.event_s:.3f} s ({after.trial})")
            elif before.measured is not None and after.measured is not None:
                if abs(after.measured - before.measured) > RESPONDS * max(abs(before.measured), 1e-9):
                    return True, f"{after.measured:.4g} {after.unit} instead of {before.measured:.4g} ({after.trial})"
                still.append(f"{after.measured:.4g} {after.unit} ({after.trial})")
        return False, "; ".join(dict.fromkeys(still)) or "nothing was measured"

    def _anomalies(self, causes: tuple[CauseResult, ...]) -> list[Anomaly]:
        codes: dict[str, tuple[str, str, AnomalySeverity]] = {
            "survives": ("WS321", "effect_without_cause", "blocking"),
            "timed": ("WS322", "effect_unmoved", "blocking"),
            "unclear": ("WS324", "cause_untested", "blocking"),
        }
        found = []
        for result in causes:
            if result.outcome not in codes:
                continue
            code, name, severity = codes[result.outcome]
            if result.outcome == "timed" and not any(r.event_s is not None for r in result.as_planned):
                severity = "warn"  # a measured value may saturate, a moment must move
            times = [r.event_s for r in result.as_planned if r.event_s is not None]
            at = min(times, default=float(self.trajectory.t[-1]))
            message = f"objective {result.objective}: {result.message}"
            found.append(
                Anomaly(
                    code=code, name=name, severity=severity, body=result.cause, window_s=(at, at),
                    measured=1.0, threshold=0.0, unit="effects", message=message,
                )
            )  # fmt: skip
        return found

    # -- one declared intervention -----------------------------------------------------------------------------------

    def helpers(self, words: tuple[str, ...], rows: tuple[Acting, ...]) -> tuple[HelperResult, ...]:
        """Which claims need what these options switch off, for each row; their repetition must have been made or have failed."""
        return tuple(self._helper(label_of(words), row, rows) for row in rows)

    def _helper(self, label: str, row: Acting, rows: tuple[Acting, ...]) -> HelperResult:
        facts = {"kind": row.kind, "target": row.target, "law": row.law}
        if label not in self.trials.made:
            why = self.trials.failed.get(label, "")
            return HelperResult(**facts, needed_by=(), failed=True, message=f"it could not be switched off: {why}")
        after = expecting.expect(self.trials.made[label], self.plan)
        pairs = zip(self.expected.objectives, after.objectives, strict=True)
        needed = tuple(one.index for one, other in pairs if one.status == "proved" != other.status and not other.waits)
        said = f"objectives {', '.join(map(str, needed))} fail" if needed else "every objective holds all the same"
        gone = ", ".join(f"the {one.kind} on {one.target}" for one in rows)
        return HelperResult(**facts, needed_by=needed, message=f"without {gone}, {said}")

"""The answer of `status`: every step, the outcome, and one next command."""

from typing import Any, Literal

from ..model.evidence.build_steps import STEPS, StepName
from ..model.frozen import Frozen
from ..model.printable import line
from . import bundle, gates, iterations, scope
from .refusal import Refusal
from .state import State
from .steps import Step, steps

MARKS = {"holds": "✓", "fails": "✗", "missing": "·", "damaged": "!", "not_needed": "–"}
RELEASED: tuple[StepName, ...] = STEPS[: STEPS.index("lint")]


class Status(Frozen):
    """What has been proven so far."""

    run: str
    state: Literal["open", "accepted", "blocked"]
    key: str = ""
    """Evidence key of the current program, plan and environment; empty while one is missing."""
    steps: tuple[Step, ...]
    cause: str = ""
    """Why it is blocked."""
    next_move: str = ""
    """The one command to run now."""
    notes: tuple[str, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether it is enough: this program and plan are accepted."""
        return self.state == "accepted"

    def text(self) -> str:
        """The status as a person reads it."""
        lines = [line(f"{self.run}: {self.state}" + (f" (key {self.key})" if self.key else ""))]
        lines += [f"  {MARKS[s.status]} {s.name:<10}{line(s.detail)}" for s in self.steps]
        lines += [f"  blocked: {line(self.cause)}"] if self.cause else []
        lines += [f"  note: {line(note)}" for note in self.notes]
        return "\n".join(lines + ([f"  next: {self.next_move}"] if self.next_move else []))


def status(state: State) -> Status:
    """Derive the status from the files; never raises for what the files hold."""
    found = steps(state)
    ending = state.blocked.value
    same = ending is not None and (ending.program_sha256, ending.plan_sha256) == (
        state.program_sha256,
        state.plan_sha256,
    )
    spent = ending is not None and iterations.spent(state)
    same = same or spent
    outcome: Literal["open", "accepted", "blocked"] = "open"
    outside = list(scope.refusals(state))
    next_move = next((step.next_move for step in found.values() if not step.holds), "")
    if outside and found["draft"].holds and found["approve"].holds:
        next_move = outside[0].next_move
    if found["accept"].holds:
        outcome, next_move = "accepted", f"worldwright stamp verify {state.place}"
    elif same:
        outcome, next_move = "blocked", f"change {state.place}/plan.md or {state.place}/simulation.py"
        if spent:
            next_move = f"worldwright stamp approve {state.place}"  # a person allows more repairs
    return Status(
        run=state.run.name,
        state=outcome,
        key=state.key.key if state.key else "",
        steps=tuple(found.values()),
        cause=ending.cause if ending and same and outcome == "blocked" else "",
        next_move=next_move,
        notes=tuple(_notes(state, found, outside, outcome, bool(ending and not same))),
    )


def _notes(
    state: State, found: dict[StepName, Step], outside: list[Refusal], outcome: str, older_block: bool
) -> list[str]:
    notes = [f"outside the write scope: {refusal.cause}" for refusal in outside]
    if state.blocked.problem:
        notes.append(state.blocked.problem)
    if older_block:
        notes.append("blocked.json is about an earlier program or plan")
    stamp = state.stamp.value
    if (
        outcome == "accepted"
        and stamp
        and state.environment
        and stamp.predicate.environment.sha256() != state.environment.sha256()
    ):
        notes.append("it was accepted in another environment; verify says whether it holds in this one")
    if state.environment is None:
        notes.append("this machine's environment cannot be read, so no evidence can be addressed: worldwright doctor")
    leftovers = list(state.run.folder.glob(f"{bundle.PREFIX}*"))
    if leftovers:
        notes.append(f"{len(leftovers)} unfinished acceptance(s) were left by a crash; the next accept removes them")
    steps_back = ("roll_back", "review", "lint")
    back: dict[str, Any] = next((e for e in reversed(state.journal) if e.get("action") in steps_back), {})
    if back.get("action") == "roll_back" and state.key and back.get("key") == state.key.key:
        notes.append(f"the patch of {back.get('worse')} was rolled back ({back.get('why')}): make another one")
    if outcome == "open" and len(iterations.reviewed(state)) > 1 and (best := iterations.best(state)):
        notes.append(f"best of {len(iterations.reviewed(state))} reviewed iterations: {best}")
    if outcome == "open" and any(step.status == "fails" for step in found.values()):
        notes += [f"repair: {refusal.cause}; {refusal.next_move}" for refusal in gates.refusals("repair", state)]
    if outcome == "open" and state.other_keys and not any(found[n].holds for n in found if n not in RELEASED):
        notes.append(f"evidence of {len(state.other_keys)} earlier key(s) is kept and does not count")
    return notes

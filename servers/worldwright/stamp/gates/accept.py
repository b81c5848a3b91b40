"""The world may be accepted: everything holds for this exact program, plan and environment.

Needed: an approved and unchanged plan, a clean lint, all passes, no blocking anomaly, no refuted or unproved objective,
a passing review whose evidence still exists, evidence files as the passes left them, no undeclared intervention, every
declared cause shown to be one, no claim that a finer time step was found to change, and audits that say what their kept
repetitions show. Before all that: plan, program and reports are what the last legal step left, by the hashes in the
journal, and the folder is no rehearsal.

Why: an accepted world is one that a stranger can trust without having watched it being made.
"""

from collections.abc import Iterator

from ...model.errors import WorldwrightError
from ...model.evidence.build_steps import STEPS
from ...model.evidence.run import sha256_file
from .. import audited, bindings, interventions, iterations, scope
from ..needs import held, no_rehearsal
from ..refusal import Refusal
from ..state import State

CODE = "WG070"


def check(state: State) -> Iterator[Refusal]:
    """Refusals for whatever is missing, refuted, changed or undeclared."""
    outside = [*no_rehearsal(state), *scope.refusals(state)]
    yield from outside
    if outside:
        return
    missing = list(held(state, *STEPS[: STEPS.index("accept")]))
    yield from missing
    if missing:
        return
    yield from _blocked(state)
    if state.review.value is not None:
        yield from bindings.problems(state, state.review.value)
    yield from _changed(state)
    found = list(audited.refusals(state))
    yield from found or audited.unshown(state)
    yield from found or _undeclared(state)  # the recording itself is read too: a report can be written by hand


def _blocked(state: State) -> Iterator[Refusal]:
    ending = state.blocked.value
    if ending is not None and iterations.spent(state):
        yield Refusal(
            cause=f"the run is blocked: {ending.cause}",
            next_move=f"a person approves the plan anew, which allows more repairs: worldwright stamp approve {state.place}",
        )
        return
    same = (state.program_sha256, state.plan_sha256)
    if ending is not None and (ending.program_sha256, ending.plan_sha256) == same:
        yield Refusal(
            cause=f"this program and plan are blocked: {ending.cause}",
            next_move=f"change the program or the plan, or remove {state.place}/blocked.json",
        )


def _changed(state: State) -> Iterator[Refusal]:
    """Evidence files that no longer are what their pass wrote."""
    for stage, kept in state.passes.items():
        for name, wanted in (kept.value.files if kept.value else {}).items():
            try:
                found = sha256_file(state.folder / stage / name)
                state.sees(state.folder / stage / name, found)
                same = found == wanted
            except OSError:
                same = False
            if not same:
                yield Refusal(
                    cause=f"{stage}/{name} is not what the {stage} pass wrote",
                    next_move=f"remove {state.folder / stage} and run `worldwright stage start {state.place} "
                    f"--stage {stage}` again",
                )


def _undeclared(state: State) -> Iterator[Refusal]:
    declared = state.plan.declared() if state.plan else ()
    try:
        ledger = interventions.acted(state.folder / "physics" / "trajectory", declared)
    except WorldwrightError as error:
        yield Refusal(cause=error.cause, next_move=error.next_move)
        return
    for entry in ledger:
        if not entry.declared:
            yield Refusal(
                cause=f"undeclared intervention: {entry}",
                next_move=f"take it out of {state.place}/simulation.py, or declare it under "
                "simulation_parameters.interventions (law, bodies, source) and have the plan approved again",
            )

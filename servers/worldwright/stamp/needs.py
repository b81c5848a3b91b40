"""Refusals for steps that a gate needs and that do not hold, and for a rehearsal, of which nothing may rest."""

from collections.abc import Iterator

from ..model.evidence import rehearsed
from ..model.evidence.build_steps import StepName
from .refusal import Refusal
from .state import State
from .steps import steps


def held(state: State, *names: StepName) -> Iterator[Refusal]:
    """One refusal for each named step that does not hold."""
    found = steps(state)
    for name in names:
        if not found[name].holds:
            yield Refusal(cause=f"{name}: {found[name].detail}", next_move=found[name].next_move)


def answered(state: State, *names: StepName) -> Iterator[Refusal]:
    """One refusal for each named step that has no result for this key, good or bad."""
    found = steps(state)
    for name in names:
        if not found[name].done:
            yield Refusal(cause=f"{name}: {found[name].detail}", next_move=found[name].next_move)


def no_rehearsal(state: State) -> Iterator[Refusal]:
    """A refusal where the folder is a rehearsal: what was simulated unapproved is nobody's evidence."""
    if rehearsed.is_one(state.journal):
        run = state.place.removesuffix(f"/{rehearsed.FOLDER}")
        yield Refusal(
            cause="this is a rehearsal, simulated before anybody approved its plan; nothing of it is approved or accepted",
            next_move=f"worldwright go {run}",
        )

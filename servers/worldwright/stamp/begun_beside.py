"""What a walk begins beside whatever comes next, at its end: what acceptance will need, worlds a little otherwise, a traced film."""

from collections.abc import Callable, Collection
from typing import NamedTuple

from ..model.evidence.build_steps import StepName
from ..model.evidence.run import Run
from . import audited, proof_ahead, traced_ahead


class Begun(NamedTuple):
    """A line on each; empty where it was not begun."""

    proof: str = ""
    robust: str = ""
    traced: str = ""


def begin(
    run: Run, held: Collection[StepName], say: Callable[[str, str, str], None], *, sound: bool, attended: bool
) -> Begun:
    """Begin what the steps that hold allow.

    Args:
        run: the run.
        held: the steps that hold.
        say: told each line, with the name of what it is about.
        sound: nothing was found wrong.
        attended: somebody looks at the film.
    """
    proof = proof_ahead.begin(run) if sound and "expect" in held else ""
    drawn = all(step in held for step in audited.BEFORE_ROBUST)
    robust = audited.robust_beside(run, proving=bool(proof)) if drawn else ""
    begun = Begun(proof, robust, traced_ahead.begin(run) if drawn and sound and attended else "")
    for name, line in begun._asdict().items():
        if line:
            say(name, "done", line)
    return begun

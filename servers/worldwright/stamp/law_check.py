"""Whether a program's `control` gives the inputs that were recorded: it is asked again, in the sandbox.

A stream that somebody made by hand drives its world honestly, stays within what the plan declares, and is all the same not what
the program would have done. A known signer vouches that it is; of a stranger's world the program has to show it.

The stranger also wrote where it was stamped. So what another environment excuses is measured on what the program sends here,
and what can only be said not to repeat here is no yes: `open`.
"""

import json
import shutil
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..model.errors import GateError, WorldwrightError
from ..model.progress import Progress
from . import bundle, digest, measured_again, media_apart
from .as_stamped import Check
from .proof import DRIVEN, FACTS, WORLD, Proved, beside, lay_out, prove
from .statement import Statement

NAME = "law"


@dataclass(frozen=True)
class Law:
    """What came of asking a program again."""

    check: Check
    same: bool = False
    """It sends the recorded inputs, bit for bit."""


def concerns(folder: Path) -> bool:
    """Whether anything entered the kept world of an accepted folder, or its program may have a `control` that could send it.

    The facts beside the world are the stranger's, so that only the program's own text can say that there is none, and where the
    plan declares what a `control` may write, not even that: the program has to show it. What lies there is not read: a file that
    could drive the world is enough.
    """
    from ..lint import tools as lint
    from ..stage import tools as stage

    facts, program = folder / bundle.WORLD, folder / "simulation.py"
    try:
        said = json.loads((facts / FACTS[0]).read_bytes())
        controlled = bool(said.get("control") or said.get("laws"))
        stated = lint.stated_facts(program)
        unsaid = stated.get("control", "unknown") is not None or bool(stated.get("laws", "unknown"))
        open_to_it = any("solver" not in row for row in stage.declared_inputs(folder / "plan.md"))
        unshown = unsaid or not lint.states_alone(program)
        return controlled or unshown or open_to_it or any((facts / name).exists() for name in DRIVEN)
    except (OSError, ValueError, AttributeError, RecursionError, WorldwrightError):
        return True


def unconfined() -> Check | None:
    """None where a program that nobody known here vouches for may be run; else what is left open by that."""
    from ..stage import tools as stage

    if stage.may_run_strangers():
        return None
    return Check(
        name=NAME,
        ok=False,
        open=True,
        detail="nothing was simulated: nobody known here signed it, proving it takes running its program, and no sandbox "
        "confines that on this machine",
        next_move="`worldwright doctor` says what the sandbox lacks; or, if you have read the program and trust it, set "
        "WORLDWRIGHT_SANDBOX=rlimits",
    )


def check(
    folder: Path,
    scratch: Path,
    statement: Statement,
    proved: Proved,
    differences: Sequence[str],
    deadline: float,
    progress: Progress,
) -> Law | None:
    """Compare what the program sends when it is asked again with what was recorded; None when it needs longer.

    Args:
        folder: the accepted folder.
        scratch: where to work; a later call with the same one goes on.
        statement: its stamp.
        proved: the kept world, driven by its recorded inputs.
        differences: from the environment and the processor that it says it was stamped on; with any, the motion need not
            be the same bit for bit.
        deadline: on the monotonic clock, s.
        progress: is told how far it is.

    Raises:
        JobError: the machine had no room for it, or somebody ended it.
    """
    try:
        asked = prove(
            scratch / NAME,
            (folder / "simulation.py").read_bytes(),
            (folder / "plan.md").read_bytes(),
            reason=f"stamped as {statement.predicate.run}",
            timeout_s=max(1.0, deadline - time.monotonic()),
            progress=progress,
            near=beside(folder),
            kept=lay_out(scratch / "kept", folder / WORLD, folder / bundle.WORLD),
            elsewhere=bool(differences),
            linted=False,  # another version has other rules, and the stamp vouches for none
        )
    except GateError as error:
        shutil.rmtree(scratch / NAME, ignore_errors=True)
        return Law(_refused(str(error), differences))
    return compared(folder, statement, proved, asked, differences) if asked else None


def compared(folder: Path, statement: Statement, recorded: Proved, asked: Proved, differences: Sequence[str]) -> Law:
    """Compare a world driven by its recorded inputs with the same world whose program was asked again."""
    built = f"built again by the stamped program: {asked.rebuilt}"
    if recorded.inputs_sha256 == asked.inputs_sha256:
        sends = "; asked again, it sends the same inputs" if asked.inputs_sha256 else ""
        return Law(Check(name=NAME, ok=True, detail=built + sends), same=True)
    apart = digest.compare(digest.motion(recorded.recording), digest.motion(asked.recording))
    told = f"{built}; asked again, it sends other inputs than were recorded; {apart.message}"
    if not (differences and apart.within):
        return Law(_refused(told, differences))
    if strayed := media_apart.apart(recorded.recording, asked.recording):
        return Law(_refused(f"{told}; {strayed}", differences))
    wrong = [c for c in measured_again.checks(folder, statement, asked, exact=False) if not c.ok]
    if wrong:
        return Law(_refused(f"{told}; driven by those, {wrong[0].name}: {wrong[0].detail}", differences))
    return Law(Check(name=NAME, ok=True, detail=f"{told}; driven by those, all is as stamped, too"))


def _refused(detail: str, differences: Sequence[str]) -> Check:
    """No yes; where it was stamped in another environment, no more than that it does not repeat in this one."""
    if not differences:
        return Check(name=NAME, ok=False, detail=detail)
    return Check(
        name=NAME,
        ok=False,
        open=True,
        detail=f"it does not repeat here, where another environment than the stamped may be why: {detail}",
        next_move=f"verify it where it was stamped; here differs {'; '.join(differences)}",
    )

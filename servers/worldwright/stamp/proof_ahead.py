"""What acceptance needs of a world whose claims hold, begun at once, while its film is made and looked at.

First the repetitions that its causes ask for, then, of a long physics, the proof run, and that part of the repetitions which
acceptance simulates again. A process of its own makes them, a little less urgent than the film that is waited for meanwhile; by the
time that acceptance waits for them nothing else is at work. What nothing waits for, the worlds a little otherwise, begins where it ends.
It is about what was there when it began: once the program, the plan or what they use is changed, it ends its jobs and itself. Nothing is
decided by it; acceptance asks all its questions when it is called.
"""

from contextlib import suppress

from ..model import work_beside
from ..model.errors import WorldwrightError
from ..model.evidence.run import Run
from . import audited, private, repeats, trials_again
from .proof import Proved, prove
from .state import State
from .steps import one
from .strip import strip
from .taken import take

MODULE = "worldwright.proof_beside"
"""What the process runs."""
BEHIND = 10
"""So much nicer it is: on two cores a film that a role waited for stood still beside it, and acceptance comes after the film."""
LONG_S = 6.0
"""A physics pass that took less is proved while acceptance is waited for."""
LOOK_S = 5.0
"""How often it looks whether what it proves is still there, s."""
MADE = "made-ahead"
"""Beside a proof that has come to its end; acceptance removes both."""


def long(state: State) -> float:
    """How long the physics pass took, s, if that is long; else 0."""
    physics = state.passes["physics"].value
    return physics.wall_s if physics is not None and physics.ok and physics.wall_s >= LONG_S else 0.0


def begin(run: Run) -> str:
    """Begin what acceptance needs, unless it is done or under way; what there is to say of it, one line, else empty."""
    state = State(run)
    repeats_too = bool(audited.why_causes(state)) and audited.standing(state, state.causes) in ("absent", "stale")
    if not work_beside.allowed() or not (long(state) or repeats_too) or state.key is None:
        return ""
    if one(state, "accept").holds:
        return ""
    made = ["the repetitions that its causes ask for"] if repeats_too else []
    made += [f"the proof run, about {long(state):.0f} s"] if long(state) else []
    with suppress(WorldwrightError, OSError):  # it only saves time: acceptance proves in any case
        work = private.proofs(run, state.key.key)
        if (work / MADE).is_file() and not repeats_too:
            return ""
        work_beside.begin(MODULE, run.folder, work)
        return f"{', then '.join(made)}: made beside what comes next; `go` and `accept` find it"
    return ""


def finish(run: Run) -> bool:
    """Make it to its end; False when what it proves was changed meanwhile.

    Raises:
        WorldwrightError: why it is no proof; acceptance will tell the same.
    """
    state = State(run)
    if state.key is None:
        return False
    if audited.why_causes(state):
        from ..scan.tools import scan

        while scan(str(run.folder), causes=True, timeout_s=LOOK_S).pending:
            if _changed(run, state):
                return False
    if not long(state):
        return True
    near, work = take(run).near, private.proofs(run, state.key.key)
    program = strip((state.program_bytes or b"").decode(), f"{state.place}/simulation.py").source.encode()
    plan, kept = state.plan_bytes or b"", repeats.laid_out(state, work / "kept")
    proved: Proved | None = None
    while proved is None:
        proved = prove(
            work / "proof", program, plan, reason=f"copied from {run.name}", timeout_s=LOOK_S, near=near, kept=kept
        )
        if _changed(run, state):
            return False
    while repeats.driven_again(work / "again", program, plan, proved, timeout_s=LOOK_S) is None:
        if _changed(run, state):
            return False
    while trials_again.before_signing(State(run), proved, work, LOOK_S) is None:
        if _changed(run, state):
            return False
    (work / MADE).touch()
    return True


def _changed(run: Run, state: State) -> bool:
    """Whether another world than that of `state` is there now; then what is under way for it is ended."""
    if State(run).key == state.key:
        return False
    from ..stage.tools import cancel

    work = private.proofs(run, state.key.key if state.key else "")
    for folder in (work / "proof", work / "again" / "replay"):
        with suppress(WorldwrightError):  # nothing runs there
            cancel(str(folder))
    return True

"""The program may be patched: there is something to repair, repairs still help, and symbols are looked up first.

Needed: fewer repairs have been ordered than the approval allows (12 unless it says otherwise); and when the installed
simulator does not know a name that the program uses (WL101 to WL105, or an AttributeError of a pass), the journal has a
citation newer than the error. The physics gate asks for that citation too.

Why: patching from memory repeats the memory's mistake, and a thirteenth patch of the same world is a sign that the plan
is wrong. Then the honest ending is `blocked`, with the cause.
"""

from collections.abc import Iterator

from .. import iterations
from ..refusal import Refusal
from ..state import State

CODE = "WG065"


def check(state: State) -> Iterator[Refusal]:
    """Refusals for too many repairs, or for a simulator symbol that nobody looked up."""
    if iterations.spent(state):
        yield Refusal(
            cause=f"{len(iterations.ordered(state))} repairs were ordered already (the cap is {iterations.cap(state)})",
            next_move=f'worldwright stamp block {state.place} "CAUSE"',
        )
    unknown = _unknown_symbol(state)
    if unknown and not _cited_since_failure(state):
        yield Refusal(
            cause=f"the simulator does not know a name that the program uses ({unknown}) and nothing was looked up",
            next_move=f"worldwright retrieve symbol NAME --run {state.place} (or `retrieve read CITATION --run …`) journals what was read",
        )


def _unknown_symbol(state: State) -> str:
    from ...lint.tools import to_look_up

    report = state.lint.value
    for finding in report.findings if report else ():
        if finding.severity == "error" and to_look_up(finding.code):
            return f"{finding.code}: {finding.message}"
    failure = state.failure("physics")
    return failure if "AttributeError" in failure and "mujoco" in failure else ""


def _cited_since_failure(state: State) -> bool:
    """Whether something was cited after the error was first seen on this key."""
    key = state.key.key if state.key else ""
    seen = [i for i, e in enumerate(state.journal) if e.get("action") in ("lint", "stage") and e.get("key") == key]
    cited = [i for i, e in enumerate(state.journal) if e.get("action") == "cite"]
    return bool(cited) and cited[-1] > (seen[0] if seen else -1)

"""The second line of the write scope: what the journal says of plan.md, simulation.py and the evidence.

The first line is the hook of the harness, which denies a write before it happens. This one needs no hook. Every legal
step left a line with the hashes of the program and the plan as they stood, and of the reports it kept; the lines are
chained. A file that was changed in any other way is found by its hash, named, and refused at acceptance.

Legal for the program: it was drafted, linted by the one who wrote it, or rolled back. Legal for the plan: it was started
from another one, resolved, or approved. Legal for both: an accepted version was brought back (`versions`).
"""

import itertools
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..model.evidence.journal import Journal, reports, results
from ..model.evidence.run import SOURCE, sha256_file
from .refusal import Refusal
from .state import State

LEGAL = {
    "simulation.py": ("draft", "lint", "roll_back", "restore"),
    "plan.md": ("plan", "resolve", "approve", "restore"),
}
HASHES = {"simulation.py": "program_sha256", "plan.md": "plan_sha256"}
AGAIN = {
    "lint": "worldwright lint check-program {place}/simulation.py",
    "scan": "worldwright scan scan {place}",
    "interventions": "worldwright scan scan {place}",
    "expect": "worldwright scan expect {place}",
    "causes": "worldwright scan scan {place} --causes",
    "refine": "worldwright scan scan {place} --refine",
    "robust": "worldwright scan scan {place} --robust",
    "visual": "worldwright stamp describe {place} @description.json",
    "review": "worldwright stamp review {place} @verdict.json",
}
"""The command that makes each report again."""


def refusals(state: State) -> Iterator[Refusal]:
    """Files that are not what the last legal step left, most basic first; nothing when all of them are."""
    broken = Journal(state.run.journal).breaks()
    if broken:
        yield Refusal(
            cause=f"the journal was changed: {broken[0]}",
            next_move=f"restore {state.place}/journal.jsonl from version control; without a copy, move it away, have "
            "the plan approved and run every step again",
        )
        return
    found = [refusal for name in LEGAL for refusal in _file(state, name)]
    yield from found
    if not found:
        yield from _reports(state)


def changed(state: State, name: str) -> bool:
    """Whether program or plan is another than the last legal step left, also where evidence of it is kept from before."""
    return next(_file(state, name), None) is not None


def _file(state: State, name: str) -> Iterator[Refusal]:
    field = HASHES[name]
    lines = [e for e in state.journal if e.get("action") in LEGAL[name]]
    now = state.program_sha256 if name == "simulation.py" else state.plan_sha256
    if not lines or not now or lines[-1].get(field, now) == now:  # journals of older versions have lines without it
        return
    last = lines[-1]
    yield Refusal(
        cause=f"{name} was changed since the last legal step ({last['action']} by {last.get('actor')}, "
        f"{last.get('time')}): its sha256 was {str(last[field])[:16]}, and is {now[:16]}",
        next_move=f"{_legalise(state, name)}; or, if nobody meant the change, {_restore(state, name, str(last[field]), now)}",
    )


def _restore(state: State, name: str, sha256: str, now: str) -> str:
    """What brings the legal bytes back, where a copy of them is kept; what stands there is somebody's work, and kept first."""
    here = f"{state.place}/{name}"
    free = next(
        end
        for n in itertools.count(1)
        if not (state.run.folder / (end := f"{name}.changed{n if n > 1 else ''}")).exists()
    )
    mine = "" if _kept(state, name, now) else f"cp {here} {state.place}/{free}"
    if copy := _kept(state, name, sha256):
        return f"{mine and mine + ' && '}cp {state.place}/{copy} {here}"
    return f"{mine and mine + ', and '}restore {here} from version control"


def _kept(state: State, name: str, sha256: str) -> str:
    """Where in the run's evidence these bytes are kept; empty where nowhere."""
    for folder in sorted((state.run.folder / "evidence").glob(f"*/{SOURCE}")):
        if (folder / name).is_file() and sha256_file(folder / name) == sha256:
            return str((folder / name).relative_to(state.run.folder))
    return ""


def _legalise(state: State, name: str) -> str:
    if name == "plan.md":
        return f"have it approved again: worldwright stamp approve {state.place}"
    return f"worldwright lint check-program {state.place}/simulation.py, and run every pass again"


def _reports(state: State) -> Iterator[Refusal]:
    """Reports and results of this key whose bytes no line of the journal vouches for."""
    key = state.key.key if state.key else ""
    vouched = reports(state.journal, key) | results(state.journal, key)
    for name, command in AGAIN.items():
        yield from _vouched(state, state.folder / f"{name}.json", vouched.get(name), command.format(place=state.place))
    for stage in state.passes:
        again = f"rm -r {state.folder / stage} && worldwright stage start {state.place} --stage {stage}"
        yield from _vouched(state, state.folder / stage / "result.json", vouched.get(stage), again)


def _vouched(state: State, path: Path, wanted: Any, command: str) -> Iterator[Refusal]:
    name = path.name if path.name != "result.json" else f"{path.parent.name}/{path.name}"
    try:
        found = sha256_file(path)
    except OSError:
        return  # the steps report what is missing
    state.sees(path, found)
    if wanted is None:
        yield Refusal(cause=f"no line of the journal vouches for {name}", next_move=command)
    elif found != wanted:
        yield Refusal(
            cause=f"{name} is not what its step wrote: sha256 {found[:16]} instead of {str(wanted)[:16]}",
            next_move=command,
        )

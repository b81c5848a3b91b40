"""Would a stranger know what this is, and believe it? What was named blindly, held against what was wanted.

The visual role says what it sees before it has read any name: things, what happens, and how far it would take the film for one
of real things. The review compares. A world in which nobody recognises what was asked for is not accepted, however right its
numbers are; one that is not believed gets one repair of its look first.
"""

import re
from collections import Counter
from collections.abc import Iterator

from ..model.belief import BELIEVED
from ..model.evidence.reports import VisualDescription
from ..model.evidence.verdict import Verdict
from .refusal import Refusal
from .state import State

ROLE = "world-visual"
"""Who names blindly; a person who describes may."""
EVENT = "event"
DETAILS = 3
JOINED = ("weld", "hinge", "ball")
NUMBER = re.compile(r"[_-]?\d+$")
LOOKS = ("look", "not_recognised", "visual_mismatch")


def unnamed(description: VisualDescription, pictured: list[str]) -> Iterator[Refusal]:
    """Refuse a description of the visual role that names, scores or explains nothing blindly."""
    if description.author != ROLE and not description.named:
        return
    if not description.named:
        yield Refusal(
            cause="nothing is named",
            next_move='say what you see in your own words under `named`: [{"seen": "a wooden crate", "camera": "side"}]',
        )
    for sighting in description.named:
        if sighting.camera not in pictured:
            yield Refusal(
                cause=f"`{sighting.seen}` is named in `{sighting.camera}`, of which there is no picture",
                next_move=f"the cameras: {', '.join(pictured)}",
            )
    if not description.event.strip():
        yield Refusal(cause="nothing is said of what happens", next_move="say it in a sentence under `event`")
    if description.belief is None:
        yield Refusal(
            cause="nothing is said of whether it looks real",
            next_move="`belief`: 0 to 10, would you take this for a film of real things?",
        )
    elif description.belief < 10 and len(description.betrays) < DETAILS:
        yield Refusal(
            cause=f"{len(description.betrays)} details are named that give it away",
            next_move=f"name {DETAILS} under `betrays`, the worst first",
        )


def wanted(state: State) -> tuple[str, ...]:
    """What the pictures are about, by the names of the plan: the cameras' subjects and what may move, copies as one."""
    plan = state.plan
    if plan is None:
        return ()
    names = [name for camera in plan.cameras() for name in camera.subjects]
    names += [name for step in plan.implementation_steps for name in step.motion_expectations]
    drawn = set(plan.object_names())
    family = {name: base for base, copies in plan.families.items() for name in copies}
    return tuple(dict.fromkeys(family.get(name, name) for name in names if name in drawn or name in family))


def together(state: State) -> tuple[tuple[str, ...], ...]:
    """What is wanted, in groups of which one name stands for all: what a weld or a hinge joins directly, or what is told apart by a number alone.

    To somebody who was told nothing a chain of capsules is one branch, and a torso with its arms one figure. What hangs on a third
    thing that nobody asked for, a ceiling or a table, is no one thing by that.
    """
    names = wanted(state)
    if state.plan is None:
        return ()
    head = {name: name for name in names}  # a joint to any other joins nothing

    def first(name: str) -> str:
        while name != head[name]:
            name = head[name]
        return name

    family = {name: base for base, copies in state.plan.families.items() for name in copies}
    pairs = [(row.parent, row.child) for row in state.plan.topology.joints if row.type in JOINED]
    stems: dict[str, str] = {}
    for name in names:
        stem = NUMBER.sub("", name)
        if stem != name:
            pairs.append((stems.setdefault(stem, name), name))
    for ends in pairs:
        one, other = (family.get(end, end) for end in ends)
        if one in head and other in head:
            head[first(other)] = first(one)
    groups: dict[str, list[str]] = {}
    for name in names:
        groups.setdefault(first(name), []).append(name)
    return tuple(map(tuple, groups.values()))


def asked(state: State) -> str:
    """What a verdict's `recognised` has to say, before anybody writes it; empty where nobody named anything."""
    visual = state.visual.value
    if visual is None or not visual.named:
        return ""
    rows = ", ".join(group[0] for group in (*together(state), (EVENT,)))
    seen = "; ".join(dict.fromkeys(sighting.seen for sighting in visual.named))
    return f"`recognised` has a row for each of {rows}; `seen_as` is copied from: {seen}; of {EVENT}: {visual.event}"


def problems(state: State, verdict: Verdict) -> Iterator[Refusal]:
    """Why a verdict cannot stand on what was named blindly; nothing where nobody named anything."""
    visual = state.visual.value
    if visual is None or not visual.named:
        return
    things = {sighting.seen for sighting in visual.named}
    for name, count in Counter(row.wanted for row in verdict.recognised).items():
        if count > 1:
            yield Refusal(
                cause=f"`{name}` stands {count} times in `recognised`, and may be recognised once and not the next time",
                next_move="say once whether it was",
            )
    for row in verdict.recognised:
        # What happens is no thing, and a sentence about what happens names none.
        known = {visual.event} if row.wanted == EVENT else things
        if row.seen_as and _plain(row.seen_as) not in map(_plain, known):
            yield Refusal(
                cause=f"the description names {'no event' if row.wanted == EVENT else 'nothing'} `{row.seen_as}`",
                next_move=f"copy `seen_as` from it: {'; '.join(sorted(known))}",
            )
    if verdict.outcome != "pass":
        return
    given = {row.wanted: row for row in verdict.recognised}
    missing = []
    for group in (*together(state), (EVENT,)):
        rows = [given[name] for name in group if name in given]
        if not rows:
            missing.append(group)
        for found in rows:
            if not found.same:
                yield Refusal(
                    cause=f"`{found.wanted}` was not recognised: seen as `{found.seen_as or 'nothing'}`",
                    next_move="review it as `repair`, target `not_recognised`, and say what it was taken for",
                )
    if missing:
        said = [f"`{group[0]}`{f' (or {_some(group[1:])}, one with it)' if group[1:] else ''}" for group in missing]
        rows_wanted = ", ".join(
            f'{{"wanted": "{group[0]}", "seen_as": "…", "same": true or false}}' for group in missing
        )
        yield Refusal(
            cause=f"nothing is said of whether {', '.join(said)} {'was' if len(missing) == 1 else 'were'} recognised",
            next_move=f"add to `recognised`: {rows_wanted}; the description names {'; '.join(sorted(things))}",
        )
    if visual.belief is not None and visual.belief < BELIEVED and not _mended(state):
        yield Refusal(
            cause=f"belief is {visual.belief} of 10: {'; '.join(visual.betrays[:DETAILS])}",
            next_move="review it as `repair`, target `look`: the one change that most of these ask for",
        )


def _plain(words: str) -> str:
    """The words without what does not tell one thing from another: case, and blanks around and between."""
    return " ".join(words.casefold().split())


def _some(names: tuple[str, ...]) -> str:
    return ", ".join(names[:4]) + (f" and {len(names) - 4} more" if len(names) > 4 else "")


def _mended(state: State) -> bool:
    """Whether a repair of the look was ordered in this run before."""
    return any(e.get("action") == "review" and e.get("target") in LOOKS for e in state.journal)

"""What a review may rest on: the references of evidence that exist for this key, and what a verdict gets wrong.

A reference is `kind:name`. Kinds: `expect:<expectation>` (of the same objective), `scan:clean`, `scan:<check>` (code or
name), `visual:summary|<camera>|<object>|objective`, `still:<camera>`, `video:<camera>`, `physics:<fact>` (a fact of the
physics pass's report), `lint:clean`.
"""

from collections.abc import Iterator

from ..model.evidence.reports import ObjectiveResult
from ..model.evidence.verdict import ObjectiveVerdict, Verdict
from . import recognition
from .refusal import Refusal
from .state import State


def references(state: State, index: int) -> dict[str, tuple[str, ...]]:
    """The names that exist for objective `index`, by kind of evidence."""
    expect, scan, visual = state.expect.value, state.scan.value, state.visual.value
    objective = next((o for o in expect.objectives if o.index == index), None) if expect else None
    found: dict[str, list[str]] = {
        "expect": [e.name for e in objective.expectations if e.status != "unknown"] if objective else [],
        "scan": (["clean"] if scan.ok else []) if scan else [],
        "visual": ["summary", *visual.cameras, *visual.objects] if visual else [],
        "still": _media(state, "stills", ".png"),
        "video": _media(state, "video", ".mp4"),
        "physics": _facts(state),
        "lint": ["clean"] if state.lint.value and state.lint.value.ok else [],
    }
    if scan:
        found["scan"] += [name for c in scan.checks if c.status != "skipped" for name in (c.code, c.name)]
    if visual and index in visual.objectives:
        found["visual"].append("objective")
    return {kind: tuple(dict.fromkeys(names)) for kind, names in found.items() if names}


def problems(state: State, verdict: Verdict) -> Iterator[Refusal]:
    """Why a verdict cannot stand, most basic first."""
    plan, expect, scan = state.plan, state.expect.value, state.scan.value
    if plan is None or expect is None or scan is None:
        return
    yield from _coverage(verdict, len(plan.objectives))
    results = {o.index: o for o in expect.objectives}
    for bound in verdict.objectives:
        if bound.index >= len(plan.objectives):
            continue
        yield from _binding(state, bound.index, bound.evidence)
        result = results.get(bound.index)
        if bound.met and result is not None:
            yield from _about(bound, result)
        if bound.met and result is not None and result.status in ("refuted", "unproved"):
            yield Refusal(
                cause=f"objective {bound.index} is called met, but measurement says {result.status}: {_why(result)}",
                next_move="correct the program, or make the claim checkable in the plan and have it approved again",
            )
        if bound.met and result is None:
            yield Refusal(
                cause=f"objective {bound.index} is called met, but expect.json does not mention it",
                next_move=f"worldwright scan expect {state.place}",
            )
    if verdict.outcome == "pass":
        for anomaly in scan.anomalies:
            if anomaly.severity == "blocking":
                yield Refusal(cause=f"a blocking anomaly stands: {anomaly}", next_move="review it as `repair`")
    for check in verdict.cross_checks:
        if check.channel == check.tested_in:
            yield Refusal(
                cause=f"the cross check of '{check.claim[:80]}' tests the {check.channel} channel in itself",
                next_move="test the claim in another channel (numeric, visual, plan), or leave the check out",
            )
    yield from recognition.problems(state, verdict)
    if verdict.outcome == "repair" and not any(c.channel != c.tested_in for c in verdict.cross_checks):
        yield Refusal(
            cause="a repair rests on one channel alone",
            next_move="add a cross check: test the claim in another channel (numeric, visual, plan) and say the result",
        )


def _coverage(verdict: Verdict, count: int) -> Iterator[Refusal]:
    given = [o.index for o in verdict.objectives]
    missing = [i for i in range(count) if i not in given]
    unknown = sorted({i for i in given if not 0 <= i < count})
    twice = sorted({i for i in given if given.count(i) > 1})
    for indices, what in ((missing, "has no verdict"), (unknown, "is not in the plan"), (twice, "is judged twice")):
        for index in indices:
            yield Refusal(
                cause=f"objective {index} {what}", next_move=f"judge each of the objectives 0 to {count - 1} once"
            )


def _binding(state: State, index: int, evidence: tuple[str, ...]) -> Iterator[Refusal]:
    known = references(state, index)
    for reference in evidence:
        kind, _, name = reference.partition(":")
        if name not in known.get(kind, ()):
            listed = ", ".join(f"{k}:{n}" for k, names in known.items() for n in names)
            shown = listed if len(listed) < 1200 else listed[:1200] + " …"
            yield Refusal(
                cause=f"objective {index} rests on '{reference}', which does not exist for this key",
                next_move=f"use one of: {shown}",
            )


SPEAKS_OF_IT = {"proved": ("expect",), "visual_only": ("visual", "still", "video")}
"""Kinds of evidence that are about one objective, by its status; a clean scan or lint says nothing about what is claimed."""


def _about(bound: ObjectiveVerdict, result: ObjectiveResult) -> Iterator[Refusal]:
    """Refuse a verdict that calls an objective met on evidence that has nothing to do with it."""
    kinds = SPEAKS_OF_IT.get(result.status, ())
    if kinds and not any(reference.partition(":")[0] in kinds for reference in bound.evidence):
        yield Refusal(
            cause=f"objective {bound.index} is called met, but {', '.join(bound.evidence)} would be there without it too",
            next_move=f"bind it to what shows it: {' or '.join(f'{kind}:<name>' for kind in kinds)}",
        )


def _media(state: State, stage: str, suffix: str) -> list[str]:
    try:
        return sorted(path.stem for path in (state.folder / stage).glob(f"*{suffix}"))
    except OSError:
        return []


def _facts(state: State) -> list[str]:
    physics = state.passes["physics"].value
    return list(physics.summary) if physics else []


def _why(result: ObjectiveResult) -> str:
    failing = [e for e in result.expectations if e.status != "holds"]
    return result.reason or "; ".join(f"{e.name}: {e.message or e.status}" for e in failing) or result.claim

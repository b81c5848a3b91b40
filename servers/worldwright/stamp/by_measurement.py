"""A description and a review made by measurement alone, for a build that nobody watches.

The description counts segmentation pixels of the stills: it knows which object covers how much of which picture, and
nothing about how anything looks. The review passes a world only if every objective is proved by its expectations, or is
declared visual only and its subject can be seen at all. Both state that nobody looked.
"""

import re
from pathlib import Path
from typing import Any, cast

from worldkit.materials import LIBRARY

from ..model.errors import GateError
from ..model.evidence.reports import MEASURED, ExpectReport, ObjectiveResult, ScanReport, VisualDescription
from ..model.evidence.run import Run
from ..model.evidence.verdict import CrossCheck, ObjectiveVerdict, RepairTarget, Verdict
from ..model.plan.committed import Plan
from . import bindings
from .state import State

AUTHOR = MEASURED
TINY = 0.0002
"""Share of a picture below which an object is called a speck: about 14 x 14 pixels of 1280 x 720."""
DARK, BRIGHT, FLAT = 8.0, 247.0, 3.0
"""Grey values, 0 to 255: a picture with a lower mean is black, with a higher one white; with a smaller deviation it is
one flat tone.
"""

Seen = dict[str, dict[str, dict[str, Any]]]
"""`visibility.json`: camera -> body -> {pixels, fraction, box}."""


def describe(run: Run) -> VisualDescription:
    """What each still shows, from segmentation pixels and tone; needs the stills of the current key."""
    state = State(run)
    seen, sizes, tones = _seen(state), {}, {}
    for camera in seen:
        sizes[camera], tones[camera] = _picture(state.folder / "stills" / f"{camera}.png")
    names = state.plan.object_names() if state.plan else ()
    wanted = [n for n in names if not _hidden_on_purpose(state.plan, n)]
    glasses = _seen_through(state.plan) if state.plan else {}
    for shown in seen.values():  # the pixels of a glass are those of the water in it, which lies behind its wall
        for water, glass in glasses.items():
            if glass in shown:
                shown.setdefault(water, shown[glass])
    bodies = {body for shown in seen.values() for body in shown} - {"world"}
    shares = {name: {c: _share(shown, name) for c, shown in seen.items()} for name in dict.fromkeys(wanted)}
    concerns = [f"{camera}: {text}" for camera, text in tones.items() if text]
    concerns += list(_concerns(shares, seen, sizes))
    return VisualDescription(
        author=AUTHOR,
        summary=f"Counted, not looked at: segmentation pixels of {len(seen)} still(s) at the first recorded state, "
        f"{len(bodies)} bodies in view. Nobody judged how the pictures look or what the videos show.",
        objects={name: _object_text(by_camera) for name, by_camera in shares.items()},
        cameras={camera: _camera_text(shown) for camera, shown in seen.items()} | _film(state),
        objectives={
            i: f"in view: {', '.join(visible)}" if (visible := _visible(o.claim, shares)) else "no subject in view"
            for i, o in enumerate(state.plan.objectives if state.plan else ())
        },
        concerns=tuple(concerns),
    )


def _film(state: State) -> dict[str, str]:
    """What the video pass itself says of the author's film; nothing where there is none."""
    video = state.passes["video"].value
    told = (video.summary.get("film") or {}) if video and video.ok else {}
    if not told:
        return {}
    drawn = ", ".join(told.get("drawn_only", ())) or "nothing"
    return {"film": f"{len(told.get('shots', ()))} shot(s) of the recording; drawn only: {drawn}. Not looked at."}


def review(run: Run) -> Verdict:
    """The verdict that measurement alone supports; needs scan, expectations and a visual description of this key."""
    state = State(run)
    scan, expect, visual, plan = state.scan.value, state.expect.value, state.visual.value, state.plan
    if not (scan and expect and visual and plan):
        raise GateError(
            "a measured review needs the plan, the scan, the expectations and a description of this key",
            place=state.place,
            next_move=f"worldwright stamp status {state.place}",
        )
    objectives = tuple(_judge(state, o, visual) for o in expect.objectives)
    target, repair, checks = _repair(scan, expect, objectives, visual, plan)
    blocking = [a for a in scan.anomalies if a.severity == "blocking"]
    passed = bool(objectives) and all(o.met for o in objectives) and not blocking and target is None
    proved = sum(o.status == "proved" for o in expect.objectives)
    looked = sum(c.status != "skipped" for c in scan.checks)
    return Verdict(
        reviewer=AUTHOR,
        outcome="pass" if passed else "repair",
        numeric=f"{looked} anomaly checks: {len(scan.anomalies)} finding(s), {len(blocking)} blocking. "
        f"{proved} of {len(expect.objectives)} objectives proved by expectations on the recorded state.",
        visual=f"{visual.summary} {len(visual.concerns)} concern(s)"
        + (f": {'; '.join(visual.concerns[:3])}." if visual.concerns else "."),
        plan="Every objective is proved, or is declared visual only and its subject is in view; whether it looks as "
        "claimed was not judged."
        if passed
        else "Not every objective is supported by measurement.",
        objectives=objectives,
        cross_checks=checks,
        repair_target=None if passed else target or "visual_mismatch",
        repair="" if passed else repair or "have a person or an agent look at the pictures and review",
    )


def _judge(state: State, result: ObjectiveResult, visual: VisualDescription) -> ObjectiveVerdict:
    """One objective, bound to the evidence that decided it."""
    held = [f"expect:{e.name}" for e in result.expectations if e.status != "unknown"]
    known = bindings.references(state, result.index)
    pictures = [f"{kind}:{name}" for kind in ("still", "video") for name in known.get(kind, ())]
    fallback = pictures[:1] or [f"physics:{name}" for name in known.get("physics", ())][:1] or ["visual:summary"]
    if result.status == "proved":
        return ObjectiveVerdict(
            index=result.index, met=True, evidence=tuple(dict.fromkeys(held or fallback)), note=result.reason
        )
    if result.status == "visual_only":
        seen = visual.objectives.get(result.index, "").startswith("in view")
        note = (
            "visual only: its subject is in view; whether it looks as claimed was not judged"
            if seen
            else "visual only, and its subject is in no picture"
        )
        return ObjectiveVerdict(index=result.index, met=seen, evidence=("visual:objective", *pictures[:2]), note=note)
    evidence = tuple(dict.fromkeys(held or fallback))
    return ObjectiveVerdict(
        index=result.index, met=False, evidence=evidence, note=f"{result.status}: {result.reason}".rstrip(": ")
    )


def _repair(
    scan: ScanReport,
    expect: ExpectReport,
    objectives: tuple[ObjectiveVerdict, ...],
    visual: VisualDescription,
    plan: Plan,
) -> tuple[RepairTarget | None, str, tuple[CrossCheck, ...]]:
    """One target and one patch for the gravest problem, and the cross checks made: (target, patch, checks)."""
    from ..scan.tools import repair_target

    checks = tuple(
        CrossCheck(
            claim=o.claim,
            channel="plan",
            tested_in="numeric",
            confirmed=o.status == "proved",
            note=o.reason or "; ".join(e.message for e in o.expectations if e.message)[:300],
        )
        for o in expect.objectives
        if o.status != "visual_only"
    )
    for anomaly in scan.anomalies:
        if anomaly.severity == "blocking":
            check = CrossCheck(
                claim=f"{anomaly.body} moves plausibly",
                channel="plan",
                tested_in="numeric",
                confirmed=False,
                note=str(anomaly),
            )
            return cast(RepairTarget, repair_target(anomaly.code)), str(anomaly), (*checks, check)
    for result in expect.objectives:
        if result.status == "refuted":
            said = "; ".join(e.message for e in result.expectations if e.status == "fails")
            return "physical_parameters", f"objective {result.index} is refuted: {said or result.reason}", checks
    for result in expect.objectives:
        if result.status == "unproved":
            return "plan", f"objective {result.index} has nothing that measures it: {result.reason}", checks
    unseen = [o for o in objectives if not o.met]
    names = plan.object_names()
    for concern in visual.concerns:
        name = next((n for n in names if concern.startswith(f"{n} is in no picture")), "")
        if name or unseen:
            check = CrossCheck(claim=concern, channel="visual", tested_in="plan", confirmed=True, note="it is planned")
            return "camera_placement", concern, (*checks, check)
    if unseen:
        check = CrossCheck(
            claim=unseen[0].note, channel="visual", tested_in="plan", confirmed=True, note="it is an objective"
        )
        return "camera_placement", f"objective {unseen[0].index}: {unseen[0].note}", (*checks, check)
    dull = next((c for c in visual.concerns if "is black" in c or "one flat tone" in c), "")
    if dull:
        check = CrossCheck(
            claim=dull, channel="visual", tested_in="plan", confirmed=True, note="every camera is planned"
        )
        return "camera_placement", dull, (*checks, check)
    return None, "", checks


def _seen(state: State) -> Seen:
    import json

    path = state.folder / "stills" / "visibility.json"
    try:
        value = json.loads(path.read_bytes())
        return {str(c): {str(b): dict(v) for b, v in shown.items()} for c, shown in value.items()}
    except (OSError, ValueError, AttributeError, TypeError) as cause:
        raise GateError(
            f"the stills' visibility cannot be read: {cause}",
            place=str(path),
            next_move=f"worldwright stage start {state.place} --stage stills",
        ) from cause


def _picture(path: Path) -> tuple[tuple[int, int], str]:
    """Width and height of a still, and what is wrong with its tone (empty when nothing is)."""
    import cv2

    image = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
    if image is None:
        return (0, 0), "the picture cannot be read"
    mean, deviation = float(image.mean()), float(image.std())
    size = (image.shape[1], image.shape[0])
    if mean < DARK:
        return size, f"the picture is black (mean {mean:.0f} of 255)"
    if mean > BRIGHT:
        return size, f"the picture is white (mean {mean:.0f} of 255)"
    return size, f"the picture is one flat tone (deviation {deviation:.1f} of 255)" if deviation < FLAT else ""


def _share(shown: dict[str, dict[str, Any]], name: str) -> float:
    return float(shown.get(name, {}).get("fraction", 0.0) or 0.0)


def _seen_through(plan: Plan) -> dict[str, str]:
    """What shows a liquid, by name, with the clear container that holds it."""
    rows = [row.solver for row in plan.simulation_parameters.interventions if row.solver is not None]
    looks = {thing.name: LIBRARY.get(thing.look or "") for thing in plan.scene_objects}
    held = {row.shown_by: row.container for row in rows if row.shown_by and row.container}
    return {water: glass for water, glass in held.items() if (look := looks.get(glass)) and look.clear > 0}


def _hidden_on_purpose(plan: Plan | None, name: str) -> bool:
    """Whether a body is a plane: the ground of the scene, which is drawn as part of the world."""
    return plan is not None and any(o.name == name and o.primitive == "plane" for o in plan.scene_objects)


def _concerns(shares: dict[str, dict[str, float]], seen: Seen, sizes: dict[str, tuple[int, int]]) -> list[str]:
    found = []
    for name, by_camera in shares.items():
        best = max(by_camera.values(), default=0.0)
        if best <= 0:
            found.append(f"{name} is in no picture")
        elif best < TINY:
            found.append(f"{name} is a speck: {best:.3%} of its best picture")
        elif all(_cut(seen[c].get(name, {}), sizes[c]) for c, share in by_camera.items() if share > 0):
            found.append(f"{name} is cut by the frame in every picture that shows it")
    return found


def _cut(entry: dict[str, Any], size: tuple[int, int]) -> bool:
    """Whether a body's pixels touch the border of the picture."""
    box = entry.get("box")
    if not box or not all(size):
        return False
    x0, y0, x1, y1 = box
    return bool(x0 <= 0 or y0 <= 0 or x1 >= size[0] - 1 or y1 >= size[1] - 1)


def _object_text(by_camera: dict[str, float]) -> str:
    shown = {c: share for c, share in by_camera.items() if share > 0}
    return ", ".join(f"{share:.2%} of {c}" for c, share in shown.items()) or "in no picture"


def _camera_text(shown: dict[str, dict[str, Any]]) -> str:
    ranked = sorted(((float(v.get("fraction", 0) or 0), body) for body, v in shown.items()), reverse=True)
    named = ((share, "surroundings" if body == "world" else body) for share, body in ranked[:12] if share > 0)
    return ", ".join(f"{body} {share:.2%}" for share, body in named) or "nothing"


def _visible(claim: str, shares: dict[str, dict[str, float]]) -> list[str]:
    """The objects a claim names that are in view; every object when it names none."""
    words = set(re.findall(r"[a-z0-9]+", claim.lower()))
    named = [n for n in shares if any(_same_word(part, words) for part in re.split(r"[_\W]+", n.lower()) if part)]
    subjects = named or list(shares)
    visible = [n for n in subjects if max(shares[n].values(), default=0.0) >= TINY]
    return visible if len(visible) == len(subjects) or named else []


def _same_word(part: str, words: set[str]) -> bool:
    return len(part) > 2 and (part in words or f"{part}s" in words or f"{part}es" in words)

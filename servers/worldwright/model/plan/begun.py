"""A plan to begin with: an accepted world's, with its own words taken out, and marks where the new sentence must decide.

What the resolver writes, what was settled and scenery that nothing in the world needs are left out; numbers, rows and the sums
beside them stay, for they are what an example teaches. `TO_CHANGE` marks what was copied: as long as one stands, `WP133` refuses
the plan.
"""

import re
from collections.abc import Iterator
from typing import Any

from .committed import TO_CHANGE, Plan
from .plan_text import PlanDocument, parse_plan
from .plan_yaml import Node

WRITTEN = ("position", "orientation", "provenance")
"""Keys of a placement row that the resolver writes."""
OF_ITS_FILM = ("size", "fps")
DEFAULTS = {"seed": 0, "integrator": "implicitfast"}
"""What a plan says when it says nothing."""
ASKED = {
    "simulation_parameters": "step and duration with the reason, materials, masses, start, constants with sources; the sums; inferred",
    "objectives": "one claim a verb, each measure false if it did not happen; causes",
    "implementation_steps": "what is built, what may move, two or three cameras",
    "scene_objects": "the things of the sentence and what carries them, real sizes",
    "assets": "what the catalog has of them",
    "topology": "where they stand; joints, ropes, motors",
}
"""What each section owes the sentence."""
INTRODUCTION = "in one paragraph what stands where, what starts it, what happens when, with numbers"


def begun(text: str, sentence: str, origin: str, file: str = "plan.md") -> str:
    """The plan of a world as the start of another.

    Args:
        text: the world's plan.
        sentence: what should happen in the new one.
        origin: the world's name.
        file: where the text is from, for errors.

    Raises:
        PlanError: the text is not a plan.
    """
    document = parse_plan(text, file)
    splices = [*_cuts(document, _scenery(document.plan)), *_marks(document)]
    first = min(section.heading for section in document.sections.values())
    title = re.sub(r"[.\s]+$", "", " ".join(sentence.split()))
    head = f"# {title[:1].upper()}{title[1:]}\n\n<!-- {TO_CHANGE} (from `{origin}`): {INTRODUCTION} -->\n\n"
    splices.append((0, first, head))
    for start, end, new in sorted(splices, reverse=True):
        text = text[:start] + new + text[end:]
    return parse_plan(text).text


def _scenery(plan: Plan) -> set[str]:
    """Fixed objects that no claim, joint, camera or input names and nothing rests on or refers to: setting."""
    data = plan.model_dump(mode="json")
    topology, parameters = data["topology"], data["simulation_parameters"]
    naming = [
        data["objectives"],
        data["geometry_relations"],
        *(topology[key] for key in ("joints", "tendons", "actuators")),
    ]
    naming += [[step["cameras"], step["motion_expectations"]] for step in data["implementation_steps"]]
    naming += [parameters["interventions"], list(parameters["initial_motion"]), data["layout_density"]]
    needed = set(re.findall(r"[\w-]+", " ".join(_texts(naming))))
    needed |= {row.name for row in plan.scene_objects if not row.fixed and row.dynamic and row.visual_only is None}
    needed |= {name for row in plan.assets for name in (row.name, *row.instances)}
    needed |= set(topology["body_positions"])
    while True:
        rows = [row for row in topology["scene_predicates"] if row["subject"] in needed]
        more = {name for row in rows for name in _texts([row["object"], row["params"]])} - needed
        if not more:
            return {row.name for row in plan.scene_objects} - needed
        needed |= more


def _texts(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for key, item in value.items():
            yield from (key, *_texts(item))
    elif isinstance(value, list | tuple):
        for item in value:
            yield from _texts(item)


def _cuts(document: PlanDocument, gone: set[str]) -> Iterator[tuple[int, int, str]]:
    """What is left out, as (start, end, what stands there instead)."""
    text = document.text

    def named(item: Node, key: str) -> bool:
        return item.data().get(key) in gone

    if rows := document.nodes.get("scene_objects"):
        yield from _without(text, rows, lambda row: named(row, "name"))
    for step in steps.items or () if (steps := document.nodes.get("implementation_steps")) else ():
        for key, value in step.pairs():
            if key.scalar == "scene_objects":
                yield from _without(text, value, lambda name: name.scalar in gone)
    parameters = document.nodes["simulation_parameters"]
    for key, value in parameters.pairs():
        if key.scalar == "inferred":  # who chose the old values says nothing of the new ones
            end = _lines(text, value.start, value.end)[1] if value.form == "block" else value.end
            yield key.start, end, "inferred: []" + "\n" * (value.form == "block")
        if key.scalar == "masses":
            yield from _without_keys(text, value, lambda name: name in gone)
    yield from _without_keys(
        text, parameters, lambda name: name in DEFAULTS and parameters[name].scalar == DEFAULTS[name]
    )
    if shown := document.nodes.get("recording_mode"):  # an example is small so that a repository stays so
        yield from _without_keys(text, shown, lambda name: name in OF_ITS_FILM)
    if (topology := document.nodes.get("topology")) is None:
        return
    yield from _without_keys(text, topology, lambda name: name in ("settled", "image_observation"))
    for key, value in topology.pairs():
        if key.scalar == "scene_predicates":
            yield from _without(text, value, lambda row: named(row, "subject"))
            for row in value.items or ():
                if not named(row, "subject"):
                    yield from _without_keys(text, row, lambda name: name in WRITTEN)


def _without(text: str, node: Node, drop: Any) -> Iterator[tuple[int, int, str]]:
    """A list less some of its items; whole lines go, with the comments right above them."""
    items = node.items or []
    if not any(map(drop, items)):
        return
    if node.form == "flow":
        kept = ", ".join(text[item.start : item.end] for item in items if not drop(item))
        yield node.start, node.end, f"[{kept}]"
        return
    for item in items:
        if drop(item):
            yield *_lines(text, item.start, item.end), ""


def _without_keys(text: str, node: Node, drop: Any) -> Iterator[tuple[int, int, str]]:
    """A mapping less some of its keys."""
    pairs = list(node.pairs())
    if not any(drop(key.scalar) for key, _ in pairs):
        return
    if node.form == "flow":
        kept = ", ".join(text[key.start : value.end] for key, value in pairs if not drop(key.scalar))
        yield node.start, node.end, f"{{{kept}}}"
        return
    for key, value in pairs:
        if drop(key.scalar):
            yield *_lines(text, key.start, value.end), ""


def _lines(text: str, start: int, end: int) -> tuple[int, int]:
    """The whole lines of a value, and the comment lines right above."""
    start = text.rfind("\n", 0, start) + 1
    if text[end - 1 : end] != "\n":  # a block value may end behind its last line
        end = len(text) if (at := text.find("\n", end)) < 0 else at + 1
    while (above := text[text.rfind("\n", 0, max(start - 1, 0)) + 1 : start]).strip().startswith("#"):
        start -= len(above)
    return start, end


def _marks(document: PlanDocument) -> Iterator[tuple[int, int, str]]:
    """A line at the head of each section that the sentence decides; prose and questions of the old one are taken out."""
    for name, section in document.sections.items():
        if name in ASKED and section.blocks:
            start = section.blocks[0].start
            yield start, start, f"# {TO_CHANGE}: {ASKED[name]}\n"
        if name in ("layout_density", "clarifications_needed") and not section.blocks:
            line_end = document.text.find("\n", section.heading) + 1 or len(document.text)
            yield line_end, section.end, "\n- none\n\n" if name == "clarifications_needed" else "\n"

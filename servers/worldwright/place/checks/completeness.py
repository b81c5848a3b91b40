"""What the plan speaks about exists: the supports, containers and terrain that its things and claims imply."""

import re

from .. import categories
from .checked_layout import CONTACT_M, CheckedLayout, others

TALL_M = 0.6
"""Higher things may stand on the floor, though their kind usually stands on something (a tall lamp, a tall vase)."""
_PLACES = ("support", "seat", "container", "terrain")
_SPOKEN = re.compile(
    r"\b(?:on|onto|off|from|across|over|under|beneath|beside|in|into|inside|through|against|along)\s+(?:the|a|an|its|each|one)\s+"
    r"(?=((?:[a-z]+[ -]?){1,4}))"
)
_ALWAYS = ("floor", "ground", "lawn", "road")
"""The ground plane of every world counts as these."""


def check(layout: CheckedLayout) -> None:
    """Report WP318 for things on the bare ground that belong on something, WP319 for what is only spoken of."""
    _on_the_ground(layout)
    _spoken_of(layout)
    _fluid(layout)


def _on_the_ground(layout: CheckedLayout) -> None:
    alike: dict[categories.Category, list[str]] = {}
    for placed in layout.scene.objects:
        category = layout.categories.get(placed.name)
        if (
            category is None
            or category.rests_on != "support"
            or placed.name in layout.movers
            or placed.size[2] > TALL_M
        ):
            continue
        if placed.name not in layout.hidden and abs(placed.position[2] - placed.size[2] / 2) <= CONTACT_M:
            alike.setdefault(category, []).append(placed.name)
    for category, names in alike.items():
        layout.problems.add(
            "WP318",
            "implied_support_missing",
            f"`{names[0]}`{others(names)} {'stand' if names[1:] else 'stands'} on the bare ground; a {category.name} usually "
            "rests on something",
            "add what it rests on (a table, a shelf, a bench) and PLACE-ON it, unless it was dropped there",
            layout.path(names[0]),
            severity="warning",
        )


def _spoken_of(layout: CheckedLayout) -> None:
    heads = {c.head for c in layout.categories.values()} | {
        w for n in layout.placed for w in re.split(r"[^a-z]+", n.lower())
    }
    roles = " ".join(row.role.lower() for row in layout.plan.scene_objects)
    told: set[str] = set()
    for index, objective in enumerate(layout.plan.objectives):
        if objective.visual_only:  # what it speaks of may be drawn by the film alone
            continue
        for match in _SPOKEN.finditer(objective.claim.lower()):
            category = _first_category(match.group(1))
            if category is None or category.kind not in _PLACES or category.name in told or category.head in _ALWAYS:
                continue
            if category.head in roles or any(
                head.endswith(category.head) or category.head.endswith(head) for head in heads if head
            ):
                continue
            told.add(category.name)
            layout.problems.add(
                "WP319",
                "spoken_of_but_absent",
                f"the claim {objective.claim!r} speaks of a {category.name}, and no object is one",
                "add it to scene_objects or assets, or name the object that it is",
                ("objectives", index),
                severity="warning",
            )


def _first_category(words: str) -> categories.Category | None:
    """The longest category at the beginning of some words."""
    parts = re.split(r"[ -]+", words.strip())
    found, length = None, 0
    for end in range(1, len(parts) + 1):
        category = categories.table().get(" ".join(parts[:end]))
        found, length = (category, end) if category else (found, length)
    return None if parts[length : length + 1] == ["of"] else found  # the bed of a table is no bed


def _fluid(layout: CheckedLayout) -> None:
    if layout.plan.plan_type != "fsi_in_scene":
        return
    holders = [
        o.name
        for o in layout.scene.objects
        if any(s.name == "inside" for s in layout.resolution.boxes[o.name].surfaces())
    ]
    if layout.scene.objects and not holders:
        layout.problems.add(
            "WP319",
            "spoken_of_but_absent",
            "a plan with a fluid has no container that holds it",
            "add a box_container (construction_source: generated_boundary), or an asset with an inside",
            ("scene_objects",),
            severity="warning",
        )

"""A row of the layout uses a word that is not in the vocabulary.

What it does: compares the `predicate` of every row of `topology.scene_predicates`, and the `relation_name` of every row of
`geometry_relations`, with the shelves of predicates and relations.

Why is this bad: the vocabulary is closed, so the row places nothing. A plan that is approved with it has an object that
nobody can place.

Use instead: a listed word; skill coordinates explains each.
"""

from collections.abc import Iterator
from difflib import get_close_matches
from functools import cache

from ....model.plan.committed import TO_CLARIFY
from ...case import Changes
from ...harm import Argued
from ...plan_view import Place, PlanView
from ...problem import Problem

CODE = "WP129"
SEVERITY = "error"
ROW = {"subject": "crate", "object": "ramp"}
GOOD: Changes = (
    {},
    {"geometry_relations": [{"relation_name": "placed_on_top", "body_a": "crate", "body_b": "ramp"}]},
)
BAD: Changes = (
    {"topology": {"scene_predicates": [ROW | {"predicate": "HOVER-ABOVE"}]}},
    {"topology": {"scene_predicates": [ROW | {"predicate": "place-on"}]}},
    {"geometry_relations": [{"relation_name": "leaning_against", "body_a": "crate", "body_b": "ramp"}]},
)
EVIDENCE = Argued("a row that no resolver knows has no pose to compare with; the object stays where nobody chose")


def check(view: PlanView) -> Iterator[Problem]:
    """Check rows in the order of the plan; what is TO_CLARIFY is another rule's."""
    for index, row in enumerate(view.plan.topology.scene_predicates):
        yield from _compared(view, ("topology", "scene_predicates", index), "predicate", row.predicate)
    for index, relation in enumerate(view.plan.geometry_relations):
        yield from _compared(view, ("geometry_relations", index), "relation", relation.relation_name)


def _compared(view: PlanView, place: Place, word: str, used: str) -> Iterator[Problem]:
    known = vocabulary(f"{word}s")
    if used in known or TO_CLARIFY in used:
        return
    near = get_close_matches(used.upper() if word == "predicate" else used.lower(), known, n=2, cutoff=0.6)
    fix = (f"did you mean {' or '.join(near)}? " if near else "") + f"known: {', '.join(known)}"
    yield view.at(place, f"`{used}` is not a {word}: the vocabulary is closed", fix)


@cache
def vocabulary(shelf: str) -> tuple[str, ...]:
    """The words of a shelf of `place`, those of plug-ins too."""
    from ....place.tools import vocabulary as words

    return words()[shelf]

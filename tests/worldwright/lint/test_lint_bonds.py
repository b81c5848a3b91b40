"""What a program says of its bonds is held against the plan's cut: a stress in another section proves nothing."""

from functools import cache

import pytest

from worldwright.lint import engine
from worldwright.lint.compiled import planned
from worldwright.lint.harm import outcome_of
from worldwright.model.plan.committed import Plan

PLAN = Plan.model_validate(
    {
        "title": "A pane",
        "plan_type": "mbs",
        "simulation_parameters": {
            "time_step": 0.001,
            "simulation_duration": 1.0,
            "materials": {"glass": {"friction": 0.4, "density": 2500, "source": "handbook"}},
            "constants": {"strength": {"value": 45e6, "unit": "Pa", "source": "EN 572-1"}},
            "interventions": [
                {
                    "kind": "constraint",
                    "bodies": ["pane"],
                    "law": "lets go",
                    "trigger": "stress > 45 MPa",
                    "source": "EN",
                }
            ],
        },
        "objectives": [{"claim": "It holds."}],
        "implementation_steps": [{"description": "x", "cameras": ["perspective"], "motion_expectations": ["pane"]}],
        "scene_objects": [
            {"name": "post", "primitive": "box", "size": [0.1, 0.1, 0.6], "fixed": True, "material": "glass"},
            {
                "name": "pane",
                "primitive": "box",
                "size": [0.4, 0.004, 0.3],
                "material": "glass",
                "breaks": {"pieces": 3, "strength": "strength", "held": {"post": [[-1, 0, 0]]}},
            },
        ],
        "topology": {
            "scene_predicates": [
                {"subject": "post", "predicate": "PLACE-ON-BASE", "params": {"x": -0.251, "y": 0}},
                {"subject": "pane", "predicate": "PLACE-ON-BASE", "params": {"x": 0, "y": 0.5, "gap": 0.2}},
            ]
        },
    }
)
TELL = "told = next(n for n in spec.numerics if n.name == 'bonds of pane')"
LIST = "rows = [list(told.data)[k : k + 14] for k in range(0, told.size, 14)]"
SAY = "told.data = sum(rows, [])"


outcome = cache(outcome_of)


def problems(*lines: str) -> list[str]:
    """What is wrong with the ties of the plan's own draft, with these lines before it gives its world away."""
    source = planned.source(PLAN)
    last = source.index("    return spec\n")
    changed = source[:last] + "".join(f"    {line}\n" for line in lines) + source[last:]
    found = engine.check_acting(outcome(changed), outcome(source), PLAN)
    return [one.message for one in found if one.code == "WM167"]


def test_a_draft_says_of_its_bonds_what_the_plan_does() -> None:
    assert problems(TELL, LIST, SAY) == []


OTHERWISE = {
    "area and moduli": ("rows = [r[:9] + [x / 1000 for x in r[9:13]] + r[13:] for r in rows]", ("area", "moduli")),
    "moduli": ("rows = [r[:10] + [2 * x for x in r[10:13]] + r[13:] for r in rows]", ("moduli",)),
    "axes": ("rows = [r[:3] + r[6:9] + r[3:6] + r[9:] for r in rows]", ("moduli",)),
    "strength": ("rows = [r[:13] + [45e3] for r in rows]", ("strength",)),
    "normals": ("rows = [[-x for x in r[:3]] + r[3:] for r in rows]", ("normal",)),
}


@pytest.mark.parametrize("name", OTHERWISE)
def test_a_bond_worth_otherwise_than_by_the_plan_is_found(name: str) -> None:
    """Among them: an area and moduli of a thousandth let a pane break at 45 kPa that is told as 45 MPa."""
    change, words = OTHERWISE[name]
    found = problems(TELL, LIST, change, SAY)
    for word in words:
        assert any(f"the {word}" in message and "by the plan it is" in message for message in found), found


def test_bonds_that_are_hidden_or_cannot_be_read_are_found() -> None:
    gone = problems("for t in [*spec.tuples]: t.delete() if hasattr(t, 'delete') else spec.delete(t)")
    assert gone and all("is no bond, by the plan it is one" in message for message in gone)
    assert any("each has 14" in message for message in problems(TELL, "told.size, told.data = 14, [1.0] * 14"))

"""The shelf entries: each documents itself, and its worked numbers are true."""

import json
from pathlib import Path

import pytest

from worldwright.place.anchors import Box, CannotResolveError, Surface, cos_sin, total, wrap
from worldwright.place.reference import PAGE, page
from worldwright.place.vocabulary import PREDICATES, RELATIONS

PAPER = Path(__file__).parent / "paper_vocabulary.json"
ENTRIES = [*PREDICATES.values(), *RELATIONS.values()]
GOOD = [(e, c) for e in ENTRIES for c in e.GOOD]
BAD = [(e, c) for e in ENTRIES for c in e.BAD]


def printed_in_the_paper() -> tuple[dict[str, list[str]], dict[str, list[str]]]:
    """Families and names of the paper's table: predicates, then relation templates."""
    data = json.loads(PAPER.read_text(encoding="utf-8"))
    return data["predicates"], data["templates"]


def families(shelf) -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}
    for code, entry in shelf.items():
        found.setdefault(entry.FAMILY, set()).add(code)
    return found


def test_the_vocabulary_holds_the_papers_name_for_name():
    """A word that the paper does not have belongs to a family of its own."""
    predicates, templates = printed_in_the_paper()
    assert (sum(map(len, predicates.values())), sum(map(len, templates.values()))) == (27, 31)
    for shelf, printed in ((PREDICATES, predicates), (RELATIONS, templates)):
        ours = families(shelf)
        assert {family: ours.get(family) for family in printed} == {f: set(names) for f, names in printed.items()}


def test_the_plan_rule_knows_the_same_words():
    from worldwright.lint.rules.plan import unknown_predicate

    assert set(unknown_predicate.vocabulary("predicates")) == set(PREDICATES)
    assert set(unknown_predicate.vocabulary("relations")) == set(RELATIONS)


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda e: e.name)
def test_an_entry_is_complete(entry):
    assert entry.GOOD
    assert entry.BAD
    assert entry.UNIT in ("m", "deg")
    assert entry.REFERENCE in ("required", "optional", "none")
    assert all(p.meaning for p in entry.PARAMS.values())
    assert "=" in entry.doc, "the docstring states the formula"
    for name in entry.PARAMS:
        assert name in entry.doc, f"the docstring explains {name}"


@pytest.mark.parametrize(("entry", "case"), GOOD, ids=lambda v: getattr(v, "name", ""))
def test_worked_numbers(entry, case):
    subject, reference, params = case.boxes()
    pins = entry.pins(params)
    assert set(case.gives) <= set(pins)
    for dof in pins:
        derivation = entry.resolve(dof, subject, reference, params)
        setattr(subject, dof, derivation.value)
        assert f"{derivation.value:.3f}".rstrip("0").rstrip(".").lstrip("-") in derivation.formula
    for dof, value in case.gives.items():
        assert getattr(subject, dof) == pytest.approx(value, abs=1e-12)
    for dof in ("x", "y", "z", "yaw"):  # what other rows would set: above the middle of the reference
        if getattr(subject, dof) is None:
            setattr(subject, dof, getattr(reference, dof))
    assert entry.holds(subject, reference, params) >= 0


@pytest.mark.parametrize(("entry", "case"), BAD, ids=lambda v: getattr(v, "name", ""))
def test_layouts_that_do_not_hold(entry, case):
    subject, reference, params = case.boxes()
    for dof in ("x", "y", "z", "yaw"):
        if getattr(subject, dof) is None:
            setattr(subject, dof, 0.0)
    assert entry.holds(subject, reference, params) < 0


def test_a_margin_is_the_distance_to_being_violated():
    entry = PREDICATES["LEFT-OF"]
    table = Box("table", (1, 2, 1), x=0, y=0, z=0.5, yaw=0)
    for y, free in ((1.5, 0.3), (1.1, -0.1)):
        mug = Box("mug", (0.4, 0.4, 0.4), x=0, y=y, z=0.2, yaw=0)
        assert entry.holds(mug, table, {}) == pytest.approx(free + 1e-3)
    on = PREDICATES["PLACE-ON"]
    table.surface = lambda name: Surface("top", 1.0, (1, 2))
    cup = Box("cup", (0.1, 0.1, 0.1), x=0.45, y=0, z=1.05, yaw=0)
    assert on.holds(cup, table, {}) == pytest.approx(1e-3)  # the contact is the tighter of its two demands
    cup.x = 0.7
    assert on.holds(cup, table, {}) == pytest.approx(-0.2 + 1e-3)


def test_facing_needs_a_direction():
    here = Box("a", (1, 1, 1), x=1.0, y=2.0, z=0, yaw=0)
    with pytest.raises(CannotResolveError, match="same centre"):
        PREDICATES["FACING-TO"].resolve("yaw", here, Box("b", (1, 1, 1), x=1.0, y=2.0, z=5, yaw=0), {})


def test_rotated_extents():
    assert Box("b", (1, 2, 3), yaw=90).half("x") == 1.0
    assert Box("b", (1, 2, 3), yaw=45).half("x") == pytest.approx(3 / 2 / 2**0.5)
    assert Box("b", (1, 1, 3), yaw=45, round=True).half("x") == 0.5
    assert cos_sin(-90) == (0.0, -1.0)
    assert [wrap(a) for a in (180, -180, 270, 720.5)] == [180, 180, -90, pytest.approx(0.5)]


def test_an_elliptic_surface_ends_where_the_ellipse_does():
    plate = Surface("well", 0.01, (0.2, 0.1), shape="ellipse")
    assert plate.inset(0.0, 0.0) == pytest.approx(0.05)
    assert plate.inset(0.1, 0.0) == pytest.approx(0.0)
    assert plate.inset(0.09, 0.04) < 0 < Surface("top", 0.01, (0.2, 0.1)).inset(0.09, 0.04)


def test_provenance_shows_the_numbers():
    assert total("y", ("table.max_y", 0.45), ("gap", 0.1), ("-mug.half_y", 0.05)).formula == (
        "y = table.max_y + gap - mug.half_y = 0.45 + 0.1 - 0.05 = 0.5"
    )
    assert total("x", ("params.x", -2.0)).formula == "x = params.x = -2"


def test_modules_are_small():
    for entry in ENTRIES:
        assert len(Path(entry.module.__file__).read_text(encoding="utf-8").splitlines()) < 200


def test_the_page_of_the_vocabulary_is_fresh():
    assert PAGE.read_text(encoding="utf-8") == page(), "run: python -m worldwright.place.reference"
    text = page()
    for entry in ENTRIES:
        assert f"### {entry.code}\n" in text
        assert all(f"| `{name}`" in text for name in entry.PARAMS)

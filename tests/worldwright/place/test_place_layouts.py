"""The six reference layouts resolve, check without a finding, settle, and explain every number."""

import re
from pathlib import Path

import pytest

from worldwright.model.plan.plan_text import read_plan
from worldwright.place import tools
from worldwright.place.checks.checked_layout import CheckedLayout
from worldwright.place.checks.density import kind_of
from worldwright.place.drawing.families import captions, stem
from worldwright.place.engine import resolve
from worldwright.place.statements import Problems

LAYOUTS = Path(__file__).parents[3] / "skills/layouts/references"
PLANS = sorted(LAYOUTS.glob("*/plan.md"))
each = pytest.mark.parametrize("plan", PLANS, ids=lambda p: p.parent.name)


def test_the_six_are_there():
    names = {p.parent.name for p in PLANS}
    assert names == {
        "dining-room", "dining-room-of-assets", "street-grid", "bookshelf-wall", "workshop-bench", "stacks-and-bridges"
    }  # fmt: skip
    assert all((p.parent / "layout.png").stat().st_size < 100_000 for p in PLANS)


@each
def test_it_resolves_and_checks_without_a_finding(plan):
    report = tools.check(plan)
    wrong = [finding for finding in report.findings if finding.severity != "info"]  # such as what is meant to fall
    assert not wrong, "\n".join(map(str, wrong))
    assert report.views, "its cameras were tried"


@each
def test_it_settles(plan):
    report = tools.settle(plan, duration_s=1.0)
    assert report.ok, report.text()
    assert report.deepest_m < 1e-3


@each
def test_every_number_traces_to_a_row(plan):
    """Each coordinate has a formula that ends in the number itself, and each formula names the row that it came from."""
    document = read_plan(plan)
    scene = resolve(document.plan, locate=document.line_of).scene
    rows = {row.subject for row in document.plan.topology.scene_predicates} | {
        relation.body_a for relation in document.plan.geometry_relations
    }
    members = {n for row in document.plan.topology.scene_predicates for n in row.params.get("members", ())}
    for placed in scene.objects:
        assert placed.name in rows | members
        told = [next(f for f in placed.provenance if f.startswith(f"{dof} = ")) for dof in ("x", "y", "z", "deg_z")]
        for formula, value in zip(told, (*placed.position, placed.deg_z), strict=True):
            numbers = re.findall(r"-?\d+(?:\.\d+)?", formula.rsplit("=", 1)[1])
            assert numbers, formula
            assert float(numbers[0]) == pytest.approx(value, abs=2e-6), formula
            assert formula.endswith("]") or "no orientation row" in formula, formula
    rebuilt = tools.explain(plan, scene.objects[-1].name)
    assert rebuilt.chain[-1].formulas == scene.objects[-1].provenance


@pytest.mark.parametrize("name", ["stacks-and-bridges", "workshop-bench"])
def test_it_becomes_a_whole_program(name):
    from worldwright.draft.assembly import draft

    plan = read_plan(LAYOUTS / name / "plan.md").plan
    drafted = draft(plan, resolve(plan).scene)
    assert drafted.complete
    names: dict = {"__name__": "drafted"}
    exec(compile(drafted.source, "simulation.py", "exec"), names)
    model = names["build"]().compile()
    assert model.nbody == len(plan.object_names()) + 1


def counted(name: str) -> tuple[int, int]:
    plan = read_plan(LAYOUTS / name / "plan.md").plan
    layout = CheckedLayout(plan, resolve(plan), Problems("plan.md", lambda *path: None), exact=False)
    return len(layout.placed), len({kind_of(layout, o) for o in layout.scene.objects})


def test_they_are_as_large_as_they_must_be():
    bodies, kinds = counted("dining-room")
    assert bodies >= 58
    assert kinds >= 33
    assert counted("street-grid")[0] >= 130
    bodies, kinds = counted("dining-room-of-assets")
    assert bodies >= 100
    assert kinds >= 45


def test_a_crowd_is_named_by_family():
    names = [f"tree_a_{i}{j}" for i in "123" for j in "123"] + [f"car_{n}" for n in range(40)] + ["bus_1", "kiosk"]
    assert stem("tree_a_11") == "tree"
    assert stem("book_2c") == "book"
    assert captions(names, ["car_3"]) == {
        "tree_a_11": "tree ×9", "car_0": "car ×40", "car_3": "car_3", "bus_1": "bus_1", "kiosk": "kiosk"
    }  # fmt: skip
    assert captions(names[:5], []) == {n: n for n in names[:5]}

"""Additions to a plan leave every other character as it was, in every form that a list may have."""

from pathlib import Path

import pytest

from worldwright.model.errors import PlanError
from worldwright.model.plan.plan_rows import completed
from worldwright.model.plan.plan_text import parse_plan

GOOD = Path(__file__).parent / "good_plan.md"
CRATE = {"name": "crate_two", "primitive": "box", "size": [0.1, 0.2, 0.3]}
REST = "## assets\n\n## asset_dimensions\n\n## layout_density\n\n"


def plan(objects: str, topology: str = "", parameters: str = "") -> str:
    return (
        "# A\n\n## plan_type\n\nscene\n\n## simulation_parameters\n\n```yaml\ntime_step: 0.001\nsimulation_duration: 1\n"
        f"{parameters}```\n\n## objectives\n\n- it stands\n\n## implementation_steps\n\n## scene_objects\n{objects}\n{REST}"
        f"## topology\n{topology}\n## visualization\n\n## recording_mode\n\n## clarifications_needed\n\n## geometry_relations\n"
    )


@pytest.mark.parametrize(
    "objects",
    [
        "\n```yaml\n- {name: one, primitive: box, size: [1, 1, 1]}   # as claimed\n# the end\n```\n",
        "\n```yaml\n- name: one\n  primitive: box\n  size: [1, 1, 1]\n```\n",
        "\n```yaml\nscene_objects:\n  - {name: one, primitive: box, size: [1, 1, 1]}\n```\n",
        "\n```yaml\n[{name: one, primitive: box, size: [1, 1, 1]}]\n```\n",
        "\n```yaml\n```\n",
        "\n",
        "",
    ],
)
def test_a_row_is_added_behind_those_that_are_there(objects):
    text = plan(objects)
    before, after = parse_plan(text), completed(parse_plan(text), {("scene_objects",): [CRATE]}, {})
    assert after.plan.scene_objects[:-1] == before.plan.scene_objects
    assert after.plan.scene_objects[-1].name == "crate_two"
    kept = [line for line in text.splitlines() if line.strip() and not line.startswith("[")]
    assert [line for line in kept if line not in after.text.splitlines()] == []


@pytest.mark.parametrize(
    ("topology", "parameters"),
    [
        ("", ""),
        ("\n```yaml\njoints:\n  - {name: a, type: hinge, child: one}\n```\n", "masses:\n  one: 2   # kg\n"),
        ("\n```yaml\nscene_predicates:\n  - {subject: one, predicate: PLACE-ON-BASE}\n```\n", "masses: {one: 2}\n"),
        ("\n```yaml\njoints: []\n```\n", "inferred: [time_step]\nmasses: {}\n"),
    ],
)
def test_rows_that_refer_to_each_other_are_added_together(topology, parameters):
    text = plan("\n```yaml\n- {name: one, primitive: box, size: [1, 1, 1]}\n```\n", topology, parameters)
    before = parse_plan(text).plan
    after = completed(
        parse_plan(text),
        {
            ("scene_objects",): [CRATE],
            ("topology", "joints"): [{"name": "b", "type": "slide", "child": "crate_two"}],
            ("simulation_parameters", "inferred"): ["masses.crate_two"],
        },
        {("simulation_parameters", "masses"): {"crate_two": 1.5}},
    ).plan
    assert after.topology.joints[:-1] == before.topology.joints and after.topology.joints[-1].child == "crate_two"
    assert after.simulation_parameters.masses == {**before.simulation_parameters.masses, "crate_two": 1.5}
    assert after.simulation_parameters.inferred == (*before.simulation_parameters.inferred, "masses.crate_two")
    assert after.topology.scene_predicates == before.topology.scene_predicates


def test_what_refers_to_nothing_is_refused():
    document = parse_plan(GOOD.read_text(encoding="utf-8"))
    with pytest.raises(PlanError):
        completed(document, {("topology", "joints"): [{"name": "b", "type": "slide", "child": "nobody"}]}, {})


def test_nothing_to_add_changes_nothing():
    document = parse_plan(GOOD.read_text(encoding="utf-8"))
    assert completed(document, {("scene_objects",): []}, {}).text == document.text

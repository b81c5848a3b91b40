"""What belongs together may be inside each other, parts and copies included, as far as the plan says and no farther."""

from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from worldwright.lint.case import plan_with
from worldwright.lint.problem import Problem
from worldwright.lint.rules.model import overlaps_at_start
from worldwright.model.errors import PlanError
from worldwright.model.plan.belonging import Belonging, welded
from worldwright.model.plan.plan_references import reference_problems
from worldwright.model.plan.plan_text import parse_plan

ROW = {"between": ["crate", "ramp"], "up_to_m": 0.004, "why": "a groove holds it"}


def test_parts_and_copies_stand_for_their_object():
    box = {"primitive": "box", "size": [0.1, 0.1, 0.1]}
    plan = plan_with(
        {
            "scene_objects": [{"name": "peg", "count": 2, **box}, {"name": "plate", **box}],
            "topology": {"overlaps": [{"between": ["peg", "plate"], "up_to_m": 0.003, "why": "a tight fit"}]},
        }
    )
    belonging = Belonging(plan, {"peg_2_head": "peg_2", "plate_rim": "plate", "peg_2": "world", "plate": "world"})
    assert belonging.allowed_m("plate_rim", "peg_2_head") == 0.003 == belonging.allowed_m("peg_1", "plate")
    assert belonging.allowed_m("peg_1", "peg_2") == 0.0 == Belonging(None).allowed_m("peg_1", "plate")


@pytest.mark.parametrize(("depth", "count"), [(0.003, 0), (0.005, 1)])
def test_lint_lets_the_start_overlap_as_far(depth, count):
    view = SimpleNamespace(
        contact_geom=[(0, 1)], contact_depth=[depth], geom_rbound=np.array([0.02, 0.02]), geom_bodyid=[1, 2],
        body_parentid=[0, 0, 0], plan=plan_with({"topology": {"overlaps": [ROW]}}),
        geom_aabb=np.array([[0, 0, 0, 0.02, 0.02, 0.02], [0, 0, 0, 0.02, 0.02, 0.01]]),
        name=lambda kind, index: ("world", "ramp", "crate")[index],
        at=lambda kind, index, message, fix: Problem(message, fix, 1),
    )  # fmt: skip
    assert len(list(overlaps_at_start.check(view))) == count
    view.geom_aabb[1, 5] = 0.002  # a disk so thin is half hidden
    assert len(list(overlaps_at_start.check(view))) == 1
    view.plan = plan_with({})
    assert len(list(overlaps_at_start.check(view))) == 1


@pytest.mark.parametrize(
    ("kind", "size"), [("capsule", "0.02 0.001"), ("cylinder", "0.02 0.02"), ("plane", "1 1 0.001")]
)
def test_a_short_capsule_is_as_thick_as_its_ball(kind, size):
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco><worldbody><geom type='{kind}' size='{size}'/></worldbody></mujoco>"
    )
    assert overlaps_at_start._half_m(model, 0) == (np.inf if kind == "plane" else 0.02)


def test_nothing_overlaps_itself_but_copies_do():
    row = {**ROW, "between": ["ramp", "ramp"]}
    data = {"scene_objects": [{"name": "ramp"}], "topology": {"overlaps": [row]}}
    (problem,) = reference_problems(data)
    assert problem.code == "WP012" and "named twice" in problem.message
    data["scene_objects"][0]["count"] = 2
    assert not reference_problems(data)
    assert not reference_problems({"topology": data["topology"]}, ("scene_objects",)), "it may have copies"


def test_who_overlaps_is_an_object_of_the_plan(small_plan):
    text = small_plan.replace(
        "## topology\n\n```yaml\n",
        "## topology\n\n```yaml\noverlaps:\n  - {between: [nobody, ground], up_to_m: 0.004, why: a test}\n",
    )
    assert text != small_plan
    with pytest.raises(PlanError) as refused:
        parse_plan(text)
    assert any("nobody" in str(finding) for finding in refused.value.findings)


def test_things_that_are_welded_to_the_world_are_not_one() -> None:
    weld = [SimpleNamespace(type="weld", parent=p, child=c) for p, c in (("world", "a"), ("world", "b"), ("a", "c"))]
    found = welded(SimpleNamespace(topology=SimpleNamespace(joints=weld)))
    assert "b" not in found and found["a"] == found["c"]

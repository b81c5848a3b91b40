"""A plant is one row of a plan, and drafted whole."""

import mujoco
import pytest
from pydantic import ValidationError

from worldwright.draft import draft
from worldwright.model.plan.committed import Plan
from worldwright.model.plan.imported import all_of
from worldwright.place.engine import resolve


def plan(plant: dict, **row: object) -> Plan:
    return Plan.model_validate(
        {
            "title": "A bough",
            "plan_type": "mbs",
            "simulation_parameters": {
                "time_step": 0.002,
                "simulation_duration": 1.0,
                "medium": {"density": 1.2, "viscosity": 1.8e-5, "wind": [5, 0, 0], "source": "air, a gentle breeze"},
            },
            "objectives": [{"claim": "It sways.", "cause": "wind"}],
            "implementation_steps": [
                {"description": "x", "cameras": ["perspective"], "motion_expectations": ["bough_6"]}
            ],
            "assets": [{"name": "bough", "type": "plant", "plant": plant, **row}],
            "topology": {"body_positions": {"bough": {"x": 1.0, "y": 2.0, "z": 3.0}}},
        }
    )


def test_a_row_is_a_plant_where_the_plan_has_the_box_around_it_and_nothing_is_left_to_an_author():
    made = plan({"kind": "bough", "numbers": {"length_m": 2.0}, "source": "the prompt's long bough"})
    drafted = draft(made, resolve(made).scene)
    assert drafted.complete, drafted.open_places
    space: dict = {"__name__": "drafted"}
    exec(compile(drafted.source, "drafted", "exec"), space)
    model = space["build"]().compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    ((_, row, facts),) = all_of(made)
    assert row.fixed and set(facts.bodies) == {model.body(b).name for b in range(1, model.nbody)}
    assert set(facts.joints) == {model.joint(j).name for j in range(model.njnt)}
    middle = row.plant.made().middle
    assert data.body("bough").xpos == pytest.approx([1 - middle[0], 2 - middle[1], 3 - middle[2]], abs=1e-5)


@pytest.mark.parametrize(
    ("plant", "row", "says"),
    [
        ({"kind": "bough", "numbers": {"length": 2.0}, "source": "x"}, {}, "did you mean `length_m`"),
        ({"kind": "bough", "numbers": {"length_m": 2.0}}, {}, "need a `source`"),
        (
            {"kind": "tree", "numbers": {"height_m": 0}, "source": "x"},
            {},
            "height_m is a number from 0.02 to 120, not 0",
        ),
        ({"kind": "tree", "numbers": {"parts": 2_000_000}, "source": "x"}, {}, "parts from 1 to 120"),
        ({"kind": "bough"}, {"fixed": False}, "root of a plant is held"),
        ({"kind": "bough"}, {"filename": "bough.xml"}, "reads no file"),
        ({"kind": "bough"}, {"type": "mesh", "filename": "chair"}, "go together"),
    ],
)
def test_what_grows_nowhere_is_refused_with_what_would(plant, row, says):
    with pytest.raises(ValidationError, match=says):
        plan(plant, **row)

"""Cloth and jelly as objects of a plan: refused where they cannot be, drafted whole, and as stiff as the formulas say."""

import mujoco
import numpy as np
import pytest
from pydantic import ValidationError

from worldwright.draft import draft
from worldwright.model.plan.committed import Plan
from worldwright.place.engine import resolve

CLOTH = {"name": "cloth", "primitive": "box", "size": [1.008, 1.008, 0.008], "look": "fabric_red"}
JELLY = {"name": "jelly", "primitive": "box", "size": [0.2, 0.2, 0.2], "look": "wax"}


def plan(row: dict, soft: dict, at: list[float], mass: float, integrator: str = "discrete", **parameters) -> Plan:
    return Plan.model_validate(
        {
            "title": "Soft things",
            "plan_type": "scene",
            "simulation_parameters": {
                "time_step": 0.002,
                "simulation_duration": 1.0,
                "integrator": integrator,
                "masses": {row["name"]: mass} if mass else {},
                "constants": {"stiff": {"value": 2.0e5 if soft["kind"] == "cloth" else 2.0e4, "unit": "Pa", "source": "a handbook"}},
                "materials": {"stuff": {"friction": 0.6, "source": "a handbook"}},
                **parameters,
            },
            "objectives": [{"claim": "It gives way."}],
            "scene_objects": [{"material": "stuff", **row, "soft": {"modulus": "stiff", **soft}}],
            "topology": {"scene_predicates": [{"subject": row["name"], "predicate": "PLACE-ON-BASE", "params": {"x": at[0], "y": at[1], "gap": at[2] - row["size"][2] / 2}}]},
        }
    )  # fmt: skip


def built(made: Plan) -> mujoco.MjModel:
    drafted = draft(made, resolve(made).scene)
    assert drafted.complete, drafted.open_places
    space: dict = {"__name__": "drafted"}
    exec(compile(drafted.source, "simulation.py", "exec"), space)
    return space["build"]().compile()


def test_a_cloth_held_along_two_edges_hangs_as_its_stiffness_says():
    model = built(plan(CLOTH, {"kind": "cloth", "thickness_m": 4e-4, "held": ["-x", "+x"]}, [0, 0, 1], 0.2))
    assert model.nflex == 1 and model.flex_friction[0, 0] == pytest.approx(0.6)
    data = mujoco.MjData(model)
    for _ in range(900):
        mujoco.mj_step(model, data)
    expected = (3 * 0.2 * 9.81 / (64 * 2.0e5 * 4e-4)) ** (
        1 / 3
    )  # d^3 = 3 w L^4 / (64 E t), a flat membrane between two edges
    assert 1.0 - data.flexvert_xpos[13 * 6 + 6, 2] == pytest.approx(expected, rel=0.1)


def test_a_jelly_is_squashed_by_its_weight():
    model = built(plan(JELLY, {"kind": "jelly"}, [0, 0, 0.1], 8.0))
    data = mujoco.MjData(model)
    for _ in range(500):
        mujoco.mj_step(model, data)
    assert 0.2 - np.ptp(data.flexvert_xpos[:, 2]) == pytest.approx(1000 * 9.81 * 0.2**2 / (2 * 2.0e4), rel=0.1)


def test_what_holds_a_jelly_stays():
    model = built(plan(JELLY, {"kind": "jelly", "held": ["+z"]}, [0, 0, 0.5], 8.0))
    data = mujoco.MjData(model)
    for _ in range(100):
        mujoco.mj_step(model, data)
    assert data.flexvert_xpos[:, 2].max() == pytest.approx(0.6, abs=1e-6) and data.flexvert_xpos[:, 2].min() < 0.4


@pytest.mark.parametrize(
    ("row", "soft", "more", "told"),
    [
        (CLOTH, {"kind": "cloth", "held": ["+z"]}, {}, "is not held by"),
        (JELLY, {"kind": "jelly", "thickness_m": 0.1}, {}, "remove `thickness_m`"),
        ({**CLOTH, "fixed": True}, {"kind": "cloth"}, {}, "cannot have `fixed`"),
        ({**CLOTH, "primitive": "cylinder"}, {"kind": "cloth"}, {}, "a soft cloth is a box"),
        ({**CLOTH, "size": [1, 1, 1.2]}, {"kind": "cloth"}, {}, "lies flat"),
        (CLOTH, {"kind": "cloth", "modulus": "nothing"}, {}, "is as stiff as `nothing`"),
        (CLOTH, {"kind": "cloth"}, {"mass": 0}, "give its mass"),
        (CLOTH, {"kind": "cloth"}, {"integrator": "implicitfast"}, "write `discrete`"),
    ],
)
def test_what_cannot_be_is_refused_by_its_field(row, soft, more, told):
    with pytest.raises(ValidationError, match=told):
        plan(row, soft, [0, 0, 1], **{"mass": 0.2, **more})

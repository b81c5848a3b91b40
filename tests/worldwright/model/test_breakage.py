"""An object that breaks is one row of a plan, and drafted whole: its pieces, their masses and places, its bonds and their rule."""

import mujoco
import numpy as np
import pytest
from pydantic import ValidationError

from worldkit.breaking import bonds_of
from worldwright.draft import draft
from worldwright.model.plan.committed import Plan
from worldwright.model.plan.trigger import threshold
from worldwright.place.engine import resolve
from worldwright.scan.anomalies.checks import should_move
from worldwright.scan.anomalies.sign import Context
from worldwright.scan.known import analytic

PANE = {
    "name": "pane",
    "primitive": "box",
    "size": [0.4, 0.004, 0.3],
    "material": "glass",
    "breaks": {"pieces": 9, "strength": "glass_strength", "seed": 1, "held": {"post": [[-1, 0, 0]]}},
}
TWIG = {
    "name": "pane",
    "primitive": "cylinder",
    "size": [0.02, 0.02, 0.3],
    "deg_x": 90,
    "material": "glass",
    "breaks": {"pieces": 4, "strength": "glass_strength"},
}


def plan(row: dict, **parameters: object) -> Plan:
    post = {"name": "post", "primitive": "box", "size": [0.1, 0.1, 0.6], "fixed": True, "material": "glass"}
    breaks = {
        "kind": "constraint",
        "bodies": ["pane"],
        "law": "a bond lets go above glass_strength",
        "source": "EN 572-1",
    }
    return Plan.model_validate(
        {
            "title": "A pane",
            "plan_type": "mbs",
            "simulation_parameters": {
                "time_step": 0.001,
                "simulation_duration": 1.0,
                "materials": {"glass": {"friction": 0.4, "density": 2500, "source": "handbook"}},
                "constants": {"glass_strength": {"value": 45e6, "unit": "Pa", "source": "EN 572-1"}},
                "interventions": [{**breaks, "trigger": "stress > 45 MPa"}],
                **parameters,
            },
            "objectives": [{"claim": "It holds."}],
            "implementation_steps": [{"description": "x", "cameras": ["perspective"], "motion_expectations": ["pane"]}],
            "scene_objects": [post, row],
            "topology": {
                "scene_predicates": [
                    {"subject": "post", "predicate": "PLACE-ON-BASE", "params": {"x": -0.251, "y": 0}},
                    {"subject": "pane", "predicate": "PLACE-ON-BASE", "params": {"x": 0, "y": 0.5, "gap": 0.2}},
                ]
            },
        }
    )


def built(made: Plan) -> tuple[str, mujoco.MjModel, mujoco.MjData]:
    drafted = draft(made, resolve(made).scene)
    assert drafted.complete, drafted.open_places
    space: dict = {"__name__": "drafted"}
    exec(compile(drafted.source, "simulation.py", "exec"), space)
    model = space["build"]().compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return drafted.source, model, data


def test_pieces_stand_in_the_place_of_the_object() -> None:
    made = plan(PANE)
    assert made.families["pane"] == tuple(f"pane_{n}" for n in range(1, 10))
    assert made.movers() == made.families["pane"]
    masses = [made.simulation_parameters.masses[name] for name in made.families["pane"]]
    assert sum(masses) == pytest.approx(0.4 * 0.004 * 0.3 * 2500)
    stated = plan(PANE, masses={"pane": 3.0}).simulation_parameters.masses
    assert sum(stated[name] for name in made.families["pane"]) == pytest.approx(3.0)


@pytest.mark.parametrize("row", [PANE, TWIG], ids=["pane", "twig"])
def test_a_draft_is_whole_and_builds_what_the_plan_says(row: dict) -> None:
    made = plan(row)
    source, model, data = built(made)
    assert source.count("breaking.add(") == 1 and "LET_GO(model, data)" in source
    bonds = bonds_of(model)
    assert bonds is not None and (bonds.strength == 45e6).all()
    wanted = {placed.name: placed for placed in resolve(made).scene.objects}
    for piece in made.scene_objects[1:]:
        body = model.body(piece.name)
        assert body.mass[0] == pytest.approx(made.simulation_parameters.masses[piece.name], rel=1e-6)
        shown = [g for g in range(model.ngeom) if model.geom_bodyid[g] == body.id and not model.geom_contype[g]]
        corners = []
        for geom in shown:
            mesh = model.geom_dataid[geom]
            first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
            turn = data.geom_xmat[geom].reshape(3, 3)
            corners.append(model.mesh_vert[first : first + count] @ turn.T + data.geom_xpos[geom])
        cloud = np.concatenate(corners)
        assert np.ptp(cloud, axis=0) == pytest.approx(piece.size, abs=1e-6)
        assert (cloud.min(axis=0) + cloud.max(axis=0)) / 2 == pytest.approx(wanted[piece.name].position, abs=2e-5)


def test_an_intervention_on_it_opens_its_bonds() -> None:
    made = plan(PANE)
    _, model, _ = built(made)
    from worldwright.model.plan.declaration import declaration

    names = [model.equality(n).name for n in range(model.neq)]
    assert names and all(declaration("constraint", name, made.declared()) for name in names)


def test_a_stress_can_be_a_trigger() -> None:
    assert threshold("stress > 45 MPa") == ("stress", "", True, 45e6)
    assert threshold("stress of pane_1/pane_2 exceeds 300 kPa") == ("stress", "pane_1/pane_2", True, 3e5)


def test_what_breaks_moves_where_one_of_its_pieces_does() -> None:
    """The rest may stay in its frame; where none moves, one finding tells it."""
    made = plan(PANE)
    still, falls = analytic.resting(), analytic.falling()
    names = made.families["pane"][:2]

    rows = min(len(still.t), len(falls.t))

    def told(second: str) -> list[str]:
        other = falls if second == "falls" else still
        pos, vel = (np.concatenate([getattr(s, f)[:rows] for s in (still, other)], axis=1) for f in ("pos", "linvel"))
        both = analytic.motion(still.t[:rows], pos, vel, names=names, free=False)
        return [sign.body for sign in should_move.check(both, Context.of(made)) if sign.body in names]

    assert told("falls") == [] and told("stays") == [names[0]]


REFUSED = {
    "no strength": (
        {**PANE, "breaks": {"pieces": 9, "strength": "putty"}},
        "add it to simulation_parameters.constants",
    ),
    "no holder": (
        {**PANE, "breaks": {"pieces": 9, "strength": "glass_strength", "held": {"wall": [[1, 0, 0]]}}},
        "name an object of the plan",
    ),
    "a ball": ({**PANE, "primitive": "sphere", "size": [0.1, 0.1, 0.1]}, "a sphere cannot break"),
    "fixed": ({**PANE, "fixed": True}, "`held` says what holds it"),
    "half a groove": ({**PANE, "breaks": {"pieces": 9, "strength": "glass_strength", "columns": 3}}, "go together"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_break_so_is_refused_with_a_way_out(name: str) -> None:
    row, words = REFUSED[name]
    with pytest.raises(ValidationError, match=words):
        plan(row)

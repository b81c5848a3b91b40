"""Cones, rings, bowls, pipes and hills from a plan: drafted, compiled, and their cavities stay open."""

import math

import mujoco
import numpy as np
import pytest
from pydantic import ValidationError

from worldwright.draft import draft
from worldwright.model.plan.committed import Plan
from worldwright.model.plan.scene_objects import SceneObject
from worldwright.place.engine import resolve

FORMS: dict[str, dict] = {
    "cone": {"size": [0.2, 0.2, 0.3]},
    "stump": {"primitive": "cone", "size": [0.2, 0.2, 0.3], "top_diameter": 0.1},
    "torus": {"size": [0.4, 0.4, 0.1]},
    "wedge": {"size": [0.4, 0.3, 0.2]},
    "rounded_box": {"size": [0.3, 0.2, 0.1], "radius": 0.03},
    "bowl": {"primitive": "lathe", "profile": [[0, 0], [0.08, 0.01], [0.12, 0.07]], "wall_thickness": 0.006, "smooth": 2},
    "pawn": {"primitive": "lathe", "profile": [[0, 0], [0.04, 0], [0.02, 0.03], [0.015, 0.1], [0.03, 0.12], [0, 0.16]]},
    "hill": {"profile": [[0, 0], [0.5, 0.4], [1, 0.1], [1.5, 0.3], [2, 0]], "width": 0.5, "smooth": 6},
    "rod": {"primitive": "tube", "path": [[0, 0, 0], [0.3, 0, 0], [0.3, 0.3, 0]], "diameter": 0.05, "smooth": 4},
}  # fmt: skip
EXACT = {
    "cone": math.pi * 0.1**2 * 0.3 / 3,
    "stump": math.pi * 0.3 / 3 * (0.1**2 + 0.1 * 0.05 + 0.05**2),
    "torus": 2 * math.pi**2 * 0.15 * 0.05**2,
    "wedge": 0.4 * 0.3 * 0.2 / 2,
}
"""Volumes, m^3. Source: solid geometry; Pappus' theorem for the torus."""


def plan(objects, rows, **parameters) -> Plan:
    names = [row["name"] for row in objects]
    return Plan.model_validate(
        {
            "title": "Forms",
            "plan_type": "scene",
            "simulation_parameters": {
                "time_step": 0.002,
                "simulation_duration": 1.0,
                "materials": {"wood": {"friction": 0.5, "density": 600, "source": "handbook"}},
                **parameters,
            },
            "objectives": [{"claim": "They stand."}],
            "scene_objects": [{"primitive": row["name"], "material": "wood", **row} for row in objects],
            "topology": {"scene_predicates": [{"subject": n, **row} for n, row in zip(names, rows, strict=True)]},
        }
    )


def built(made: Plan):
    """The drafted world, compiled, and its program."""
    drafted = draft(made, resolve(made).scene)
    assert drafted.complete, drafted.open_places
    space: dict = {"__name__": "drafted"}
    exec(compile(drafted.source, "simulation.py", "exec"), space)
    model = space["build"]().compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data, drafted.source


def on_base(x, y=0.0, **more):
    return {"predicate": "PLACE-ON-BASE", "params": {"x": x, "y": y}, **more}


@pytest.fixture(scope="module")
def gallery():
    objects = [{"name": name, **numbers} for name, numbers in FORMS.items()]
    made = plan(objects, [on_base(3.0 * k) for k in range(len(objects))])
    return made, *built(made)


def test_every_form_has_the_size_of_the_plan_and_the_weight_of_what_is_drawn(gallery):
    made, model, data, source = gallery
    assert "forms.lathe(profile=((0.0, 0.0), (0.08, 0.01), (0.12, 0.07)), wall=0.006, smooth=2)" in source
    for row in made.scene_objects:
        body = model.body(row.name).id
        look = model.geom(f"{row.name}/look").id
        first, count = model.mesh_vertadr[model.geom_dataid[look]], model.mesh_vertnum[model.geom_dataid[look]]
        points = model.mesh_vert[first : first + count] @ data.geom_xmat[look].reshape(3, 3).T + data.geom_xpos[look]
        assert np.ptp(points, axis=0) == pytest.approx(row.size, abs=1e-6)
        assert points.min(axis=0)[2] == pytest.approx(0.0, abs=1e-3)
        assert model.body_mass[body] == pytest.approx(600 * row.form().volume, rel=1e-6)
        if row.name in EXACT:
            assert row.form().volume == pytest.approx(EXACT[row.name], rel=0.02)


def test_they_stand_where_they_were_put(gallery):
    _, model, _, _ = gallery
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 500)
    start = model.qpos0.reshape(-1, 7)
    ended = data.qpos.reshape(-1, 7)
    assert np.abs(ended[:, :3] - start[:, :3]).max() < 0.01
    assert np.abs(data.qvel).max() < 0.05


def test_the_moments_of_a_ring_are_those_of_the_textbook():
    """m (R^2 + 3 r^2 / 4) about its axis, m (R^2 / 2 + 5 r^2 / 8) across. Source: Beer and Johnston, mass moments."""
    form = SceneObject(name="ring", primitive="torus", size=(0.4, 0.4, 0.1)).form()
    big, small = 0.15, 0.05
    across, _, about = np.diag(form.inertia)
    assert about == pytest.approx(big**2 + 0.75 * small**2, rel=0.005)
    assert across == pytest.approx(big**2 / 2 + 0.625 * small**2, rel=0.005)


def dropped(objects, rows, ball_at, seconds=2.0):
    """Where a small ball ends that is let go at a place of the world."""
    ball = {"name": "ball", "primitive": "sphere", "size": [0.04, 0.04, 0.04]}
    made = plan([*objects, ball], [*rows, on_base(9.0)])
    model, data, _ = built(made)
    at = model.joint("ball").qposadr[0]
    data.qpos[at : at + 3] = ball_at
    mujoco.mj_step(model, data, round(seconds / 0.002))
    return data.body("ball").xpos.copy()


def test_a_ball_falls_through_a_ring_and_stays_in_a_bowl():
    ring = {"name": "torus", "size": [0.4, 0.4, 0.1], "fixed": True}
    through = dropped([ring], [on_base(0)], (0.05, 0, 0.4))
    assert through[2] == pytest.approx(0.02, abs=2e-3) and np.hypot(*through[:2]) < 0.1
    bowl = {"name": "bowl", **FORMS["bowl"], "fixed": True}
    held = dropped([bowl], [on_base(0)], (0.03, 0, 0.2), 4.0)
    assert np.hypot(*held[:2]) < 0.05 and 0.02 < held[2] < 0.05


def test_a_ball_rolls_through_a_bent_pipe_and_out_of_its_other_end():
    path = [[0, 0, 0.5], [0.25, 0, 0.4], [0.5, 0.25, 0.25], [0.5, 0.5, 0.1], [0.5, 0.8, 0.05]]
    pipe = {"name": "tube", "path": path, "diameter": 0.1, "wall_thickness": 0.01, "smooth": 4, "fixed": True}
    made = SceneObject.model_validate({"primitive": "tube", **pipe})
    origin = made.form().shift + np.array([0, 0, made.size[2] / 2])
    start, end = origin + np.array([0.04, 0, 0.48]), origin + np.array(path[-1])
    ball = dropped([pipe], [on_base(0)], start, 1.2)
    assert ball[1] > end[1] + 0.05 and abs(ball[0] - end[0]) < 0.1, (start, end, ball)


def test_a_tilted_wedge_stands_on_its_own_lowest_edge():
    row = SceneObject(name="w", primitive="wedge", size=(0.4, 0.3, 0.2), deg_x=90)
    assert row.extents == pytest.approx((0.4, 0.2, 0.3))
    made = plan([{"name": "wedge", "size": [0.4, 0.3, 0.2], "deg_x": 90}], [on_base(0)])
    _model, data, _ = built(made)
    assert data.body("wedge").xpos == pytest.approx((0, 0, 0.15), abs=1e-3)


def test_things_stand_on_level_tops_and_in_vessels_but_not_on_points():
    stump, egg = {"name": "stump", **FORMS["stump"]}, {"name": "egg", "primitive": "sphere", "size": [0.04] * 3}
    bowl = {"name": "bowl", **FORMS["bowl"]}
    rows = [on_base(0), {"predicate": "PLACE-ON", "object": "stump", "params": {"offset": [0, 0]}}]
    scene = resolve(plan([stump, egg], rows)).scene
    assert scene["egg"].position[2] == pytest.approx(0.32)
    rows[1] = {"predicate": "PLACE-IN", "object": "bowl", "params": {"offset": [0, 0]}}
    inside = resolve(plan([bowl, egg], rows)).scene["egg"].position[2]
    assert inside == pytest.approx(0.006 + 0.02, abs=2e-3)
    rows[1] = {"predicate": "PLACE-ON", "object": "cone", "params": {"offset": [0, 0]}}
    unplaced = resolve(plan([{"name": "cone", **FORMS["cone"]}, egg], rows))
    assert any("no level surface" in problem.message for problem in unplaced.scene.findings)


@pytest.mark.parametrize(
    ("row", "said"),
    [
        ({"primitive": "cone", "size": [0.2, 0.3, 0.3]}, "a cone is round: write \\[d, d, height\\]"),
        ({"primitive": "torus", "size": [0.2, 0.2, 0.15]}, "leaves no hole"),
        ({"primitive": "rounded_box", "size": [0.2, 0.2, 0.1]}, "needs `radius`"),
        ({"primitive": "rounded_box", "size": [0.2, 0.2, 0.1], "radius": 0.06}, "does not fit"),
        ({"primitive": "lathe", "size": [1, 1, 1], "profile": [[0, 0], [1, 0]]}, "at least 3 points"),
        ({"primitive": "lathe", "size": [1, 1, 1], "profile": [[0, 0], [-1, 0], [0, 1]]}, "a radius is below zero"),
        ({"primitive": "lathe", "size": [1, 1, 1], "profile": [[0, 0], [1, 1], [1, 0], [0, 1]]}, "crosses itself"),
        ({"primitive": "hill", "size": [1, 1, 1], "profile": [[0, 0], [0, 1]], "width": 1}, "x must grow"),
        ({"primitive": "tube", "size": [1, 1, 1], "path": [[0, 0, 0], [1, 0, 0], [0, 0, 0]], "diameter": 0.1}, "bends by 180"),
        ({"primitive": "tube", "size": [1, 1, 1], "path": [[0, 0, 0], [1, 0, 0]], "diameter": 0.1}, "leave `size` out"),
        ({"primitive": "box", "size": [1, 1, 1], "radius": 0.1}, "a box has no `radius`"),
        ({"primitive": "wedge", "size": [1, 1, 1], "hollow": True}, "no one surface"),
        ({"primitive": "wedge", "size": [1, 1, 1], "wall_thickness": 0.1}, "of a box_container, a lathe or a tube"),
    ],
)  # fmt: skip
def test_numbers_that_make_no_such_shape_are_refused_with_the_reason(row, said):
    with pytest.raises(ValidationError, match=said):
        SceneObject.model_validate({"name": "it", **row})

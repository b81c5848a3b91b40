import subprocess
import sys

import mujoco
import numpy as np
import pytest

from worldwright.draft import draft
from worldwright.model.plan.committed import Plan
from worldwright.model.plan.weights import weight
from worldwright.place.engine import resolve


def dumbbell(**changes) -> Plan:
    return Plan.model_validate(
        {
            "title": "A dumbbell rolls",
            "plan_type": "scene",
            "simulation_parameters": {
                "time_step": 0.002,
                "simulation_duration": 1.0,
                "masses": {"dumbbell": 11.0},
                "materials": {
                    "rubber": {"friction": 0.9, "density": 1200, "source": "handbook"},
                    "steel": {"friction": 0.2, "density": 7850, "restitution": 0.5, "source": "handbook"},
                },
            },
            "objectives": [{"claim": "It lies."}],
            "scene_objects": [
                {
                    "name": "dumbbell",
                    "primitive": "compound",
                    "material": "steel",
                    "look": "chrome",
                    "parts": [
                        {"name": "handle", "primitive": "cylinder", "size": [0.03, 0.03, 0.2], "deg_y": 90},
                        {
                            "name": "plate",
                            "primitive": "cylinder",
                            "size": [0.2, 0.2, 0.05],
                            "offset": [-0.125, 0, 0],
                            "deg_y": 90,
                            "material": "rubber",
                            "look": "rubber_black",
                            "repeat": {"count": 2, "step": [0.25, 0, 0]},
                        },
                        {
                            "name": "sticker",
                            "primitive": "box",
                            "size": [0.04, 0.0305, 0.0305],
                            "look": "#cc2222",
                            "visual_only": "a label without weight",
                        },
                    ],
                }
            ],
            "topology": {
                "scene_predicates": [
                    {"subject": "dumbbell", "predicate": "PLACE-ON-BASE", "params": {"x": 0.5, "y": 0}},
                    {"subject": "dumbbell", "predicate": "FACING-LEFT"},
                ]
            },
        }
        | changes
    )


def built(plan):
    made = draft(plan, resolve(plan).scene)
    assert made.complete, made.open_places
    names: dict = {"__name__": "drafted"}
    exec(compile(made.source, "drafted", "exec"), names)
    return made.source, names["build"]().compile()


def test_a_compound_is_drafted_whole_and_weighs_what_the_plan_says():
    plan = dumbbell()
    source, model = built(plan)
    told = weight(plan, plan.scene_objects[0])
    body = model.body("dumbbell")
    assert body.mass[0] == pytest.approx(11.0) == told.mass_kg
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    assert np.allclose(body.ipos, told.centre, atol=1e-9) and np.allclose(data.body("dumbbell").xpos, (0.5, 0, 0.1))
    assert np.allclose(data.geom("dumbbell/plate_2").xpos, (0.5, 0.125, 0.1))  # facing left: its x is the world's y
    assert model.geom("dumbbell/plate_1").friction[0] == 0.9 and model.geom("dumbbell/handle").friction[0] == 0.2
    sticker = model.geom("dumbbell/sticker")
    assert (sticker.contype[0], sticker.conaffinity[0]) == (0, 0)
    assert "dumbbell_parts = (" in source and "parts=dumbbell_parts" in source


def test_without_a_mass_each_part_weighs_what_its_material_does():
    plan = dumbbell()
    bare = plan.model_copy(
        update={"simulation_parameters": plan.simulation_parameters.model_copy(update={"masses": {}})}
    )
    _, model = built(bare)
    wanted = np.pi * (7850 * 0.015**2 * 0.2 + 2 * 1200 * 0.1**2 * 0.05)
    assert model.body("dumbbell").mass[0] == pytest.approx(wanted) == weight(bare, bare.scene_objects[0]).mass_kg


def test_the_draft_of_a_compound_is_formatted(tmp_path):
    source, _ = built(dumbbell())
    path = tmp_path / "simulation.py"
    path.write_text(source)
    options = ["--line-length", "120", "--isolated"]
    for command in (["format", "--check", "--diff"], ["check", "--select", "E,F,W"]):
        done = subprocess.run([sys.executable, "-m", "ruff", *command, *options, path], capture_output=True, text=True)
        assert done.returncode == 0, done.stdout

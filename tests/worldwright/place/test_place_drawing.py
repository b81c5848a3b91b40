"""The picture shows what moves and what holds, and no label covers a mark or another label."""

import itertools
import shutil
from pathlib import Path

import cv2
import numpy as np
import pytest

from worldwright.model.plan.committed import Plan
from worldwright.model.plan.plan_text import read_plan
from worldwright.place.drawing import palette, panel, sheet
from worldwright.place.drawing.sheet import _bounds as bounds
from worldwright.place.engine import resolve

MODELS = Path(__file__).parents[1] / "draft" / "models"
BUSY = {
    "title": "Everything at once",
    "plan_type": "mbs",
    "simulation_parameters": {
        "time_step": 0.002,
        "simulation_duration": 1.0,
        "initial_motion": {
            "pivot": {"joint_position": 35, "joint_velocity": 2.0},
            "elbow": {"joint_position": -60},
            "puck": {"linear": [0, 1.5, 0]},
            "top": {"angular": [0, 0, 80]},
            "rise": {"joint_velocity": 0.4},
        },
    },
    "objectives": [{"claim": "it moves"}],
    "scene_objects": [
        {"name": "post", "primitive": "box", "size": [0.1, 0.1, 1.4], "fixed": True},
        {"name": "arm", "primitive": "box", "size": [0.04, 0.04, 0.5]},
        {"name": "hand", "primitive": "box", "size": [0.04, 0.04, 0.4]},
        {"name": "puck", "primitive": "cylinder", "size": [0.15, 0.15, 0.05]},
        {"name": "top", "primitive": "cylinder", "size": [0.1, 0.1, 0.15]},
        {"name": "lift", "primitive": "box", "size": [0.3, 0.3, 0.1]},
        {"name": "lamp", "primitive": "sphere", "size": [0.12, 0.12, 0.12]},
    ],
    "topology": {
        "body_positions": {
            "post": {"x": 0.6, "y": 0, "z": 0.7},
            "arm": {"x": 0, "y": 0, "z": 0.95},
            "hand": {"x": 0, "y": 0, "z": 0.5},
            "puck": {"x": -0.5, "y": 0.4, "z": 0.025},
            "top": {"x": -0.2, "y": -0.5, "z": 0.075},
            "lift": {"x": -0.8, "y": -0.2, "z": 0.3},
            "lamp": {"x": 0.3, "y": 0.5, "z": 0.8},
        },
        "joints": [
            {"name": "pivot", "type": "hinge", "child": "arm", "anchor": [0, 0, 1.2], "axis": [0, 1, 0]},
            {
                "name": "elbow",
                "type": "hinge",
                "parent": "arm",
                "child": "hand",
                "anchor": [0, 0, 0.7],
                "axis": [0, 1, 0],
            },
            {"name": "rise", "type": "slide", "child": "lift", "axis": [0, 0, 1]},
            {"name": "swivel", "type": "ball", "child": "lamp", "anchor": [0.3, 0.5, 1.3]},
        ],
        "tendons": [
            {"name": "leash", "ends": [{"body": "post", "at": "top"}, {"body": "hand", "at": "bottom"}], "length": 1.6},
            {
                "name": "bungee",
                "ends": [{"body": "lift", "at": "top"}, {"offset": [-0.8, -0.2, 1.3]}],
                "length": 0.8,
                "stiffness": 40,
            },
            {"name": "cord", "ends": [{"body": "lamp"}, {"offset": [0.3, 0.5, 1.3]}]},
        ],
    },
    "implementation_steps": [
        {
            "description": "go",
            "motion_expectations": ["arm"],
            "cameras": [
                {"name": "near", "position": [-0.6, 0.6, 0.5], "target": [0, 0, 0.5], "fovy": 50},
                "perspective",
                "side_minus_y",
                "top_down",
                "side_plus_x",
            ],
        }
    ],
}
LABELS = {
    "leash (slack by 0.392 m)",
    "bungee (40 N/m)",
    "cord (taut)",
    "pivot (hinge, starts at 35°)",
    "elbow (hinge, starts at -60°)",
    "rise (slide)",
    "swivel (ball)",
    "2 rad/s",
    "1.5 m/s",
    "spins at 80 rad/s",
}
CAMERAS = {"near 50°", "perspective 40°", "side_minus_y 40°", "side_plus_x 40°"}


@pytest.fixture
def drawn(monkeypatch):
    """Draw a plan; returns the picture (H, W, 3, RGB), and for each view its items, its labels and its ink."""

    def draw(data):
        views = []
        arrange = panel.arrange

        def spied(items, panel, taken):
            labels, left = arrange(items, panel, taken)
            views.append((labels, left, taken))
            return labels, left

        monkeypatch.setattr(panel, "arrange", spied)
        told = []
        text = panel.Canvas.text
        monkeypatch.setattr(
            panel.Canvas, "text", lambda self, words, *more: told.append(words) or text(self, words, *more)
        )
        plan = Plan.model_validate(data)
        png = sheet(plan, resolve(plan), ())
        image = cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR)[:, :, ::-1]
        return image, views, told

    return draw


def overlap(a, b) -> bool:
    return min(a[2], b[2]) - max(a[0], b[0]) > 0 and min(a[3], b[3]) - max(a[1], b[1]) > 0


def test_everything_that_moves_and_holds_is_named_and_nothing_covers_anything(drawn):
    _, views, told = drawn(BUSY)
    assert set(told) >= LABELS | CAMERAS
    assert len(views) == 2
    for labels, left, ink in views:
        assert not left
        assert not [(a, b) for a, b in itertools.combinations(labels, 2) if overlap(a.box, b.box)]
        assert not [(a, b) for a in labels for b in ink if overlap(a.box, b)]


def test_the_start_pose_is_drawn_where_it_is(drawn):
    still = {**BUSY, "simulation_parameters": {**BUSY["simulation_parameters"], "initial_motion": {}}}

    def count(image, colour):
        return int((np.abs(image.astype(int) - np.array(colour)).max(axis=2) < 6).sum())

    swung, laid = drawn(BUSY)[0], drawn(still)[0]
    assert count(swung, palette.SWUNG) > 300
    assert count(laid, palette.SWUNG) < 50
    assert count(laid, palette.ROPE) > 200
    assert count(laid, palette.SPRING) > 200


def test_the_paper_reaches_as_far_as_what_swings_aside():
    aside = {"initial_motion": {"pivot": {"joint_position": -90}}}
    plan = Plan.model_validate({**BUSY, "simulation_parameters": {**BUSY["simulation_parameters"], **aside}})
    scene = resolve(plan).scene
    # The hand, 0.9 m below the pivot, swings to 0.9 m in front of it; the post's edge is at 0.65 m.
    assert bounds(scene)[1][0] == pytest.approx(0.65)
    assert bounds(scene, plan)[1][0] == pytest.approx(0.9)


def test_a_box_that_stands_for_a_model_says_so(monkeypatch, tmp_path):
    shutil.copytree(MODELS, tmp_path, dirs_exist_ok=True)
    shutil.copytree(MODELS, tmp_path / "parts")
    plan = read_plan(tmp_path / "plan.md").plan
    told = []
    text = panel.Canvas.text
    monkeypatch.setattr(panel.Canvas, "text", lambda self, words, *more: told.append(words) or text(self, words, *more))
    sheet(plan, resolve(plan), ())
    assert {"arm (urdf)", "chest_1 (mjcf chest)", "chest_2 (mjcf chest)", "table", "mug"} <= set(told)

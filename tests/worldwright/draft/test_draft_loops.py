"""A plan whose joints close a loop is drafted whole, and moves as its geometry says."""

import re
from pathlib import Path

import mujoco
import numpy as np
import pytest

from worldwright.draft import draft
from worldwright.lint.tools import check_plan
from worldwright.model.plan.committed import Plan
from worldwright.model.plan.plan_text import read_plan
from worldwright.place.engine import resolve

HERE = Path(__file__).parent
CRANK, COUPLER, ROCKER, GROUND = 0.1, 0.3, 0.25, 0.3
PLAN = (HERE / "models" / "four_bar.md").read_text()


def coupler_end(crank: float) -> np.ndarray:
    """(y, z) m of the last pin for the angle of the crank, rad: Norton, Design of Machinery, four-bar position analysis."""
    b, d = CRANK * np.array((np.cos(crank), np.sin(crank))), np.array((GROUND, 0.0))
    between = d - b
    distance = np.linalg.norm(between)
    along = (COUPLER**2 - ROCKER**2 + distance**2) / (2 * distance)
    up = np.sqrt(COUPLER**2 - along**2)
    return b + along * between / distance + up * np.array((-between[1], between[0])) / distance + (0, 1)


def drafted(plan: Plan):
    return draft(plan, resolve(plan).scene)


def test_a_four_bar_linkage_of_a_plan_turns_as_its_coupler_geometry_says():
    made = drafted(read_plan(HERE / "models" / "four_bar.md").plan)
    assert made.complete, made.open_places
    names: dict = {"__name__": "drafted"}
    exec(compile(made.source, "drafted", "exec"), names)
    model = names["build"]().compile()
    data = mujoco.MjData(model)
    worst, turned = 0.0, []
    while data.time < 4:
        mujoco.mj_step1(model, data)
        names["control"](model, data)
        tip = data.geom("rocker").xpos + data.geom("rocker").xmat.reshape(3, 3) @ (0, 0, ROCKER / 2)
        turned.append(data.joint("crank_pin").qpos[0])
        worst = max(worst, float(np.abs(tip[1:] - coupler_end(1.0 + turned[-1])).max()))
        mujoco.mj_step2(model, data)
    assert np.ptp(turned) > 2 * np.pi and worst < 2e-4
    assert [model.equality(e).name for e in range(model.neq)] == ["last_pin", "last_pin_2"]


def changed(tmp_path, *changes):
    text = PLAN
    for before, after in changes:
        assert before in text
        text = text.replace(before, after)
    path = tmp_path / "plan.md"
    path.write_text(text)
    return path


LAST = "{name: last_pin, type: hinge,"


@pytest.mark.parametrize(
    ("kind", "made"), [("ball", 'loops.ball(spec, "last_pin"'), ("weld", 'loops.weld(spec, "last_pin"')]
)
def test_other_kinds_of_loops(kind, made, tmp_path):
    draft_ = drafted(read_plan(changed(tmp_path, (LAST, LAST.replace("hinge", kind)))).plan)
    assert draft_.complete and made in draft_.source


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ((LAST, LAST.replace("hinge", "slide")), "cannot have type: slide"),
        ((LAST, LAST + " range: [-10, 10],"), "cannot have range"),
        (("joint: crank_pin,", "joint: last_pin,"), "cannot have a motor"),
        (
            ("constants:", "initial_motion: {last_pin: {joint_velocity: 1}}\nconstants:"),
            "cannot have an initial motion",
        ),
    ],
)
def test_what_a_loop_cannot_have_is_told_with_the_way_out(change, told, tmp_path):
    path = changed(tmp_path, change)
    (finding,) = [f for f in check_plan(path).findings if f.code == "WP119"]
    assert told in finding.message and "list it before the other joint of rocker, " in finding.fix
    assert re.search(r"rocker, \w+, by which \w+ carries it: then", finding.fix), finding.fix
    if "motor" not in told and "motion" not in told:
        made = drafted(read_plan(path).plan)
        assert not made.complete and "AUTHOR: joint last_pin closes a loop" in made.source

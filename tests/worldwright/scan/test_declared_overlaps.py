"""The scan looks at what the plan lets overlap only where it is deeper, and never lets half of a thing hide."""

from dataclasses import replace

import numpy as np
import pytest

from worldwright.model.plan.committed import Plan
from worldwright.model.recording.records import Contacts
from worldwright.model.recording.trajectory import Trajectory
from worldwright.scan.anomalies.checks import deep_penetration, seen_through
from worldwright.scan.anomalies.sign import Context
from worldwright.scan.known import analytic


def pressed(depth: float) -> Trajectory:
    """Two boxes of 10 cm that lie inside each other by this depth, m."""
    t = analytic.clock(1.0)
    pos = np.zeros((len(t), 2, 3))
    pos[:, 1, 0] = 0.1 - depth
    still = analytic.motion(t, pos, np.zeros_like(pos), names=("peg", "plate"), size_m=0.1)
    rows = np.arange(len(t))
    one, force = np.zeros(len(t), int), np.full(len(t), 3.0)
    touch = Contacts(row=rows, body1=one, body2=one + 1, depth_m=np.full(len(t), depth), normal_force=force)
    seen = {"geoms": ["peg", "plate"], "bodies": ["peg", "plate"], "depth_m": depth, "time_s": 0.5, "why": "contype 0"}
    return replace(still, contacts=touch, contact_force_sum=None, loads=seen_through.carrying([seen]))


def context(up_to_m: float | None) -> Context:
    box = {"primitive": "box", "size": [0.1, 0.1, 0.1]}
    row = {"between": ["plate", "peg"], "up_to_m": up_to_m, "why": "a tight fit"}
    parameters = {"time_step": 0.002, "simulation_duration": 1.0}
    plan = Plan.model_validate(
        {
            "plan_type": "mbs", "simulation_parameters": parameters, "objectives": [{"claim": "It stays."}],
            "scene_objects": [{"name": "peg", **box}, {"name": "plate", **box}],
            "topology": {"overlaps": [] if up_to_m is None else [row]},
        }
    )  # fmt: skip
    return Context.of(plan)


@pytest.mark.parametrize("check", [deep_penetration, seen_through])
@pytest.mark.parametrize(
    ("depth", "up_to_m", "found"),
    [(0.02, None, True), (0.02, 0.025, False), (0.02, 0.015, True), (0.06, 0.09, True)],
)
def test_deeper_than_declared_is_found(check, depth, up_to_m, found):
    assert bool(list(check.check(pressed(depth), context(up_to_m)))) == found


@pytest.mark.parametrize("check", [deep_penetration, seen_through])
@pytest.mark.parametrize(("thin_m", "found"), [(0.05, False), (0.01, True), (np.nan, True)])
def test_half_of_a_thin_part_never_hides_behind_the_size_of_its_whole(check, thin_m, found):
    deep = pressed(0.02)
    half = np.array([[0.05, 0.05, 0.05], [thin_m, 0.05, 0.05]])
    facts = replace(deep.mechanics, geom_names=("peg", "plate"), geom_half_extents=half)
    touch = replace(deep.contacts, geom1=deep.contacts.body1, geom2=deep.contacts.body2)
    told = list(check.check(replace(deep, mechanics=facts, contacts=touch), context(0.025)))
    assert bool(told) == found

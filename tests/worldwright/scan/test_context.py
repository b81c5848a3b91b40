"""What the checks take from a plan."""

import pytest

from worldwright.model.plan.committed import Plan
from worldwright.scan.anomalies.sign import Context


@pytest.mark.parametrize(
    ("expected", "rests"),
    [
        ({"stays": {"body": "box", "max_m": 0.01}}, ("box",)),
        ({"comes_to_rest": {"bodies": ["box", "lid"], "before_s": 1.0}}, ("box", "lid")),
        ({"stays": {"body": "box", "max_m": 0.01, "window_s": [0, 0.9]}}, ()),  # then it is pulled
        ({"stays": {"body": "box", "max_m": 0.01, "window_s": [1.0, 2.0]}}, ("box",)),
        ({"stays": {"body": "box", "max_m": 0.01, "window_s": "soon"}}, ("box",)),
    ],
)
def test_what_stays_for_a_while_only_need_not_rest_at_the_end(expected, rests):
    plan = Plan.model_validate(
        {
            "plan_type": "mbs",
            "simulation_parameters": {"time_step": 0.001, "simulation_duration": 2.0},
            "objectives": [{"claim": "It waits.", "expect": [expected]}],
        }
    )
    assert Context.of(plan).rests == rests

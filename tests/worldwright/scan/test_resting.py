"""What an expectation proves to be at rest, the check of settling does not deny; and nothing else is taken for a proof."""

from dataclasses import replace

import numpy as np
import pytest

from worldwright.model.plan.committed import Plan
from worldwright.scan.anomalies import engine, resting
from worldwright.scan.anomalies.sign import Context
from worldwright.scan.known import analytic
from worldwright.scan.objectives import expecting

REST = {"comes_to_rest": {"bodies": ["body"], "before_s": 3.75}}


def judged(trajectory, *expected):
    """Whether the plan's objective is proved, and whether the check of settling says no."""
    plan = Plan.model_validate(
        {
            "plan_type": "mbs",
            "simulation_parameters": {"time_step": 0.001, "simulation_duration": 4.0},
            "objectives": [{"claim": "It comes to rest.", "expect": list(expected)}],
        }
    )
    context = replace(Context.of(plan), movers=("body",))
    found = [a for a in engine.scan(trajectory, context).anomalies if a.name == "failure_to_settle"]
    return expecting.expect(trajectory, plan).objectives[0].status, bool(found), resting.proved(trajectory, context)


LATE = analytic.sliding(3.7, 1.0, 4.0)
"""At rest after 3.7 of 4 s."""


def test_what_is_proved_is_not_denied():
    assert judged(LATE, REST) == ("proved", False, {"body"})


@pytest.mark.parametrize("before_s", [1.0, 3.0, 3.6])
def test_what_is_refuted_is_denied_as_well(before_s):
    assert judged(LATE, {"comes_to_rest": {"body": "body", "before_s": before_s}}) == ("refuted", True, frozenset())


def test_one_claim_of_rest_that_fails_outweighs_another_that_holds():
    assert judged(LATE, REST, {"stays": {"body": "body", "max_m": 0.01}}) == ("refuted", True, frozenset())


def test_a_claim_that_lets_it_roll_on_is_no_proof_of_rest():
    rolling = analytic.sliding(1.0, 0.0, 4.0)
    lax = {"comes_to_rest": {"body": "body", "before_s": 1.0, "max_speed_m_s": 5.0}}
    assert judged(rolling, lax) == ("proved", True, frozenset())
    assert judged(rolling, {"stays": {"body": "body", "max_m": 100.0}}) == ("proved", True, frozenset())


def test_what_turns_on_the_spot_stays_and_is_not_said_to_move():
    still = analytic.resting(4.0)
    spin = still.angvel.copy()
    spin[:, 0, 2] = 3.0
    turning = replace(still, angvel=spin)
    status, denied, proved = judged(turning, {"stays": {"body": "body", "max_m": 0.01}})
    assert (status, denied, proved) == ("proved", False, {"body"})
    status, denied, _ = judged(turning, {"comes_to_rest": {"body": "body", "before_s": 1.0}})
    assert (status, denied) == ("refuted", True)


def test_a_body_that_the_recording_does_not_hold_is_proved_by_nothing():
    assert judged(LATE, {"comes_to_rest": {"body": "ghost", "before_s": 3.75}})[2] == frozenset()


def test_what_still_moves_is_told_with_the_words_that_ask_it_to_rest_and_with_all_else_that_moves():
    two = analytic.rolling()
    both = {name: np.repeat(getattr(two, name), 2, axis=1) for name in ("pos", "quat", "linvel", "angvel")}
    two = replace(
        two, names=("ball", "tuft"), mechanics=type(two.mechanics)(), contacts=None, contact_force_sum=None, **both
    )
    for claim, advised in (("stays", True), ("comes_to_rest", False)):
        context = Context(planned=True, rests=("ball",), rest_claims=((claim, {"body": "ball"}),))
        (told,) = [a for a in engine.scan(two, context).anomalies if a.code == "WS107" and a.severity == "blocking"]
        assert f"although `{claim}` in the plan's objectives asks it to rest; so do tuft (" in told.message
        assert ("`stays_within`" in told.message) is advised

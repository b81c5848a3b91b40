"""The planner's sums: right, in order, and harmless whatever is written."""

import math
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from worldwright.model.errors import PlanError, WorldwrightError
from worldwright.model.recording.closed_forms import FORMS
from worldwright.place.tools import reckon


def values(*rows, **more):
    return {v.name: v.value for v in reckon(list(rows), **more).values}


def test_later_rows_use_earlier_ones_and_forms_take_the_gravity_of_the_world():
    found = values("h = 0.75", "v = fall_speed(h)", "by_hand = sqrt(2*g*h)", "falls = v > 3")
    assert found["v"] == found["by_hand"] == pytest.approx(math.sqrt(2 * 9.81 * 0.75), rel=1e-5)
    assert found["falls"] == 1
    moon = values("g = 1.62", "t = fall_time(2)", "own = fall_time(2, g=9.81)")
    assert moon["t"] == pytest.approx(math.sqrt(4 / 1.62), rel=1e-5)
    assert moon["own"] == pytest.approx(math.sqrt(4 / 9.81), rel=1e-5)


def test_a_plan_gives_its_gravity_and_its_constants(tmp_path, small_plan):
    text = small_plan.replace("gravity: -9.81", "gravity: -1.62\nconstants:\n  push: {value: 5, unit: N, source: test}")
    (tmp_path / "plan.md").write_text(text, encoding="utf-8")
    assert values("double = 2*push", "t = fall_time(2)", plan=tmp_path) == {
        "double": 10,
        "t": pytest.approx(math.sqrt(4 / 1.62), rel=1e-5),
    }


def test_without_rows_it_lists_every_form():
    listed = reckon([]).forms
    assert [row.split("(")[0] for row in listed] == list(FORMS)
    assert "fall_time(height, g=9.81): Time to fall from rest, s" in listed[0]


@pytest.mark.parametrize(
    ("row", "cause", "move"),
    [
        ("v = fall_tim(2)", "no function `fall_tim`", "did you mean fall_time"),
        ("v = hight", "no name `hight`", "height"),
        ("v = 1/0", "division by zero", "numbers"),
        ("v = fall_time(-1)", "height must not be negative", "numbers"),
        ("v = fall_time(1, 2, 3)", "too many", "fall_time(height, g=9.81)"),
        ("v = fall_time(hight=1)", "height", "fall_time(height, g=9.81)"),
        ("v = 9**9**9", "range", "numbers"),
        ("v = 2 +", "cannot be read", "write e.g."),
        ("v = 'text' * 9", "not arithmetic", "numbers, names"),
        ("v = [1]*9", "not arithmetic", "numbers, names"),
        ("v = (1).real", "not arithmetic", "numbers, names"),
        ("v = __import__('os')", "no function", "known"),
        ("v = (lambda: 1)()", "not arithmetic", "numbers"),
        ("v = max(*[1, 2])", "hand nothing over", "write every argument"),
        ("v = 1 if True else 2", "not arithmetic", "numbers"),
        ("sqrt = 2", "is a function", "another name"),
        ("v = " + "1+" * 300 + "1", "characters long", "several rows"),
        ("v = 1e308*10", "comes to inf", "too large"),
        ("v = sqrt(-1)", "domain", "numbers"),
    ],
)
def test_a_row_that_cannot_be_reckoned_is_named_with_its_cause(row, cause, move):
    with pytest.raises(PlanError) as refused:
        reckon(["height = 2", row])
    assert "expression 2, `" in refused.value.cause
    assert cause in refused.value.cause
    assert move in refused.value.next_move


@given(st.lists(st.text(alphabet="abgh=+-*/().,_ 0123456789e<>'[]{}:!@%~^", max_size=40), max_size=4))
def test_whatever_is_written_ends_soon_in_numbers_or_in_a_refusal(rows):
    began = time.perf_counter()
    try:
        assert all(math.isfinite(v.value) for v in reckon(rows).values)
    except WorldwrightError as refusal:
        assert refusal.next_move
    assert time.perf_counter() - began < 60

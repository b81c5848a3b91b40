"""The end of a client's call: it waits for jobs no longer than lets it be answered, and says what to do when it is over."""

import pytest

from worldwright.model import call_time


@pytest.mark.parametrize(("left", "asked", "waits"), [(100.0, 1000.0, 40.0), (100.0, 5.0, 5.0), (10.0, 5.0, 0.0)])
def test_who_waits_leaves_time_for_an_answer(left, asked, waits):
    assert call_time.SPARE_S == 60.0
    with call_time.limited(left):
        assert waits - 1.0 <= call_time.waiting_s(asked) <= waits


def test_on_the_shell_a_command_waits_as_long_as_it_is_told():
    assert call_time.waiting_s(1e6) == 1e6


def test_its_end_names_the_command_that_waits_longer():
    assert call_time.over("worldwright go RUN").next_move.endswith("which waits longer: `worldwright go RUN`")
    assert call_time.over().next_move.endswith("which waits longer")

"""How a program that ended by itself is told: only a kill may be the machine's doing."""

import pytest

from worldwright.stage import limits


@pytest.mark.parametrize(
    ("status", "code"),
    [(-9, "killed"), (137, "killed"), (-11, "crashed"), (139, "crashed"), (-6, "crashed"), (-40, "crashed"),
     (-24, "out_of_cpu_time"), (-25, "file_too_large"), (3, "crashed"), (0, "no_result")],
)  # fmt: skip
def test_a_signal_is_told_by_who_sends_it(status, code):
    said = limits.failed(status, {}, {}, "worldwright stage log RUN")
    assert said and said["code"] == code and said["next_move"]
    if code == "crashed" and status != 3:
        number = -status if status < 0 else status - 128
        assert f"signal {number}" in said["message"] and ("SIGSEGV" in said["message"]) == (number == 11)

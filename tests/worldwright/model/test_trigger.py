"""A declared trigger that waits for no moment and no state acts always, however that is said."""

import pytest

from worldwright.model.plan.trigger import always


@pytest.mark.parametrize(
    "said",
    ["", "always", "t >= 0 s", "t>=0", "t > 0.0 s", "time ≥ 0 s", "from the start", "From the beginning on", "the whole time",
     "during the whole time", "every step", "from start to the end", "throughout."],
)  # fmt: skip
def test_always(said):
    assert always(said)


@pytest.mark.parametrize(
    "said",
    ["t >= 0.5 s", "t >= 2 s", "at 0.5 s", "from the start until 2 s", "t = 0", "from 1 s", "load > 5 N", "the whole time that it rolls"],
)  # fmt: skip
def test_not_always(said):
    assert not always(said)

"""A film reads the points and sums of a law by name, between the instants at which they were recorded."""

import numpy as np
import pytest

from worldkit.errors import ProgramError
from worldkit.filming.laws_shown import Laws

LAWS = Laws(
    {
        "law_names": np.array(["balloon"]),
        "law0_time": np.array([0.0, 1.0]),
        "law0_points": np.array([[[0.0, 0.0, 0.0]], [[1.0, 0.0, 2.0]]]),
        "law0_at": np.array([0.0, 1.0]),
        **{f"law0_{name}": np.array([4.0, 2.0]) for name in ("mass", "energy", "stored", "volume")},
    }
)


def test_points_lie_between_where_they_were_recorded() -> None:
    assert LAWS.points("balloon", 0.5).tolist() == [[0.5, 0.0, 1.0]]
    assert LAWS.points("balloon", np.array([-1.0, 0.25, 9.0]))[:, 0, 2].tolist() == [0.0, 0.5, 2.0]
    assert LAWS.told("balloon", "volume", np.array([0.0, 0.5])).tolist() == [4.0, 3.0]


@pytest.mark.parametrize(("law", "what"), [("ballon", "volume"), ("balloon", "colour")])
def test_what_is_not_there_names_what_is(law: str, what: str) -> None:
    with pytest.raises(ProgramError, match=f"{law}|{what}"):
        LAWS.told(law, what, 0.0)

"""A file's axes and unit become ours, or it is said what is missing."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldkit.errors import IntakeError
from worldkit.intake import upright

BOWL = {"name": "bowl", "low": 0.04, "high": 0.16}


@settings(max_examples=40)
@given(st.sampled_from(sorted(upright.AXES)), st.sampled_from(sorted(upright.AXES)))
def test_up_becomes_z_and_front_becomes_x_by_a_rotation(up: str, front: str) -> None:
    if up[1] == front[1]:
        if front != upright.OTHERWISE[1]:
            with pytest.raises(IntakeError, match="along one line"):
                upright.turn(".stl", up, front)
        return
    turn, assumed = upright.turn(".stl", up, front)
    assert turn @ upright.AXES[up] == pytest.approx((0, 0, 1)) and turn @ upright.AXES[front] == pytest.approx(
        (1, 0, 0)
    )
    assert np.linalg.det(turn) == pytest.approx(1) and assumed == []


def test_what_nobody_says_is_that_of_the_format_and_is_said() -> None:
    turn, assumed = upright.turn(".glb", "", "")
    assert turn @ (0, 1, 0) == pytest.approx((0, 0, 1)) and turn @ (0, 0, 1) == pytest.approx((1, 0, 0))
    assert assumed == ["up is +y, as GLB files mostly have it"]
    turn, assumed = upright.turn(".obj", "+z", "")
    assert turn @ (0, 0, 1) == pytest.approx((0, 0, 1)) and assumed == []
    with pytest.raises(IntakeError, match="'north' is no axis"):
        upright.turn(".obj", "north", "")


@pytest.mark.parametrize(
    ("suffix", "asked", "factor"),
    [
        (".stl", {"height": 0.06}, 0.001),
        (".stl", {"units": "mm"}, 0.001),
        (".ply", {"units": "in"}, 0.0254),
        (".obj", {"reference": BOWL}, 0.08 / 60),
    ],
)
def test_a_height_a_unit_or_a_category_gives_the_scale(suffix: str, asked: dict, factor: float) -> None:
    assert upright.scale(suffix, np.array([1.0, 1.0, 60.0]), asked)[0] == pytest.approx([factor] * 3)


def test_a_librarys_extents_scale_each_axis() -> None:
    size = np.array([2.0, 4.0, 5.0])
    assert size * upright.scale(".obj", size, {"extents": [0.2, 0.5, 0.4]})[0] == pytest.approx([0.2, 0.5, 0.4])
    assert upright.scale(".obj", size, {"extents": [1, 1, 1], "height": 10})[0] == pytest.approx([2, 2, 2])


def test_glb_is_metric_unless_its_category_says_that_it_cannot_be() -> None:
    size = np.array([0.16, 0.16, 0.07])
    assert upright.scale(".glb", size, {"reference": BOWL})[0] == pytest.approx([1, 1, 1])
    factor, source, assumed = upright.scale(".glb", 100 * size, {"reference": BOWL})
    assert factor == pytest.approx([0.08 / 7] * 3) and "0.04 to 0.16 m" in source and assumed


@pytest.mark.parametrize(("suffix", "asked"), [(".stl", {}), (".obj", {"reference": None})])
def test_without_any_of_them_the_size_is_unknown(suffix: str, asked: dict) -> None:
    with pytest.raises(IntakeError, match="tell no unit") as told:
        upright.scale(suffix, np.ones(3), asked)
    assert told.value.code == "unknown_size" and "--height" in told.value.next_move


@pytest.mark.parametrize("units", ["m", "mm"])
def test_a_size_that_no_thing_has_is_refused(units: str) -> None:
    with pytest.raises(IntakeError) as told:
        upright.scale(".stl", np.ones(3) * {"m": 500.0, "mm": 0.01}[units], {"units": units})
    assert told.value.code == "implausible_size"

"""Holding one motion against another."""

import json
import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from worldwright.stamp.digest import NAME, Motion, compare, stamped_motion


def motion(x: float = 0.0, turn_deg: float = 0.0, travelled: float = 0.0, turned: float = 0.0) -> Motion:
    half = math.radians(turn_deg) / 2
    return Motion(
        bodies=("ball",),
        time_s=(0.0, 1.0),
        position=(((0.0, 0.0, 0.0),), ((x, 0.0, 0.0),)),
        quaternion=(((1.0, 0.0, 0.0, 0.0),), ((math.cos(half), 0.0, 0.0, math.sin(half)),)),
        travelled_m=((0.0,), (travelled,)),
        turned_deg=((0.0,), (turned,)),
    )


def test_identical_motion_is_within() -> None:
    assert compare(motion(), motion()).within


def test_what_is_off_is_named_with_its_numbers() -> None:
    found = compare(motion(), motion(x=0.002))
    assert not found.within
    assert (found.body, found.time_s) == ("ball", 1.0)
    assert abs(found.position_m - 0.002) < 1e-12
    assert "allowed 1.00e-03 m" in found.message


def test_a_body_that_went_far_may_differ_more() -> None:
    assert compare(motion(travelled=1.0), motion(x=0.009, travelled=1.0)).within
    assert not compare(motion(travelled=1.0), motion(x=0.012, travelled=1.0)).within


def test_a_way_that_only_one_of_them_says_allows_nothing() -> None:
    for stamped, now in (({"travelled": 1.0}, {}), ({}, {"travelled": 1.0})):
        assert not compare(motion(**stamped), motion(x=0.009, **now)).within
    assert compare(motion(turned=500.0), motion(turn_deg=5.0, turned=500.0)).within
    assert not compare(motion(turned=500.0), motion(turn_deg=5.0)).within


@given(st.floats(0.01, 179.0))
def test_the_angle_between_rotations_is_measured(angle: float) -> None:
    found = compare(motion(), motion(turn_deg=angle))
    assert abs(found.turn_deg - angle) < 1e-6
    assert found.within == (angle <= 1.0)


def test_other_bodies_or_another_length_never_match() -> None:
    other = motion().model_copy(update={"bodies": ("cube",)})
    assert "other bodies" in compare(motion(), other).message
    longer = motion().model_copy(update={"time_s": (0.0, 2.0)})
    assert not compare(motion(), longer).within


def test_nan_never_matches() -> None:
    assert not compare(motion(), motion(x=math.nan)).within


@pytest.mark.parametrize(
    "change",
    [
        {"position": [[[0, 0, 0]]]},
        {"quaternion": [[], [[1, 0, 0, 0]]]},
        {"travelled_m": [[0.0], [0.0, 1.0]]},
        {"time_s": []},
        None,
    ],
    ids=str,
)
def test_a_strangers_motion_that_is_none_is_no_motion_and_no_crash(
    change: dict[str, Any] | None, tmp_path: Path
) -> None:
    whole = motion()
    content = json.dumps(whole.model_dump(mode="json") | change) if change else "[" * 200_000
    (tmp_path / NAME).write_text(content, encoding="utf-8")
    listed: Any = SimpleNamespace(digest_of=lambda _: "listed")
    assert stamped_motion(tmp_path, listed) is None
    (tmp_path / NAME).write_text(whole.model_dump_json(), encoding="utf-8")
    assert stamped_motion(tmp_path, listed) == whole

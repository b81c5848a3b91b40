"""Hands: their proportions, fingers that touch what they hold, the left as the right's image, poses on the way to others."""

import numpy as np
import pytest

from worldkit import sculpt
from worldkit.sculpt import hand_bones, hand_grips


def fingers_from(held, diameter):
    """How far the skin of each finger is from the bar that a hand holds, m, below 0 inside it; drawn as it is drawn on its way."""
    vertices, bones = held.meshes(fine=False)[0].vertices, held.bones
    away = vertices - held.point
    far = np.linalg.norm(away - (away @ held.axis)[:, None] * held.axis, axis=1) - diameter / 2
    found = []
    for chain, long in zip(bones.fingers, hand_bones.BONES, strict=True):
        mine = np.zeros(len(vertices), dtype=bool)
        for (at, turned), end in zip(chain, long, strict=True):
            local = (vertices - at) @ turned
            mine |= np.linalg.norm(local - np.clip(local, 0, (end, 0, 0)), axis=1) < 0.011
        found.append(float(far[mine].min()))
    return np.array(found), float(far.min())


@pytest.mark.parametrize("diameter", [0.006, 0.025, 0.08])
def test_each_finger_touches_the_bar_and_none_goes_through_it(diameter):
    fingers, deepest = fingers_from(sculpt.hand("grip", diameter), diameter)
    assert np.abs(fingers).max() < 0.002, "all four touch"
    assert deepest > -0.002, "nor does palm or thumb go into it"


def test_a_hand_has_the_proportions_of_one():
    tip = [
        chain[2][0][0] + bone[2] * chain[2][1][0, 0]
        for chain, bone in zip(sculpt.hand("flat").bones.fingers, hand_bones.BONES, strict=True)
    ]
    index, middle, ring, little = tip
    assert middle == pytest.approx(0.19, abs=0.003) and middle > ring > little and middle > index > little
    made = sculpt.made(sculpt.hand("flat").shape, cells=48, triangles=2000, hulls="convex")
    assert made.bits == 1 and 0.0003 < made.volume < 0.0007, "about 0.4 litres with a piece of forearm"


def test_a_pinch_has_its_width_between_the_pads():
    held = sculpt.hand("pinch", 0.02)
    one, other = (hand_grips._pad(held.bones, digit)[0] for digit in (4, 0))
    assert np.linalg.norm(other - one) == pytest.approx(0.02, abs=0.002)


def test_a_rod_lies_against_thumb_index_and_middle_finger():
    held, bones = hand_grips.hold("hold_rod", 0.009), sculpt.hand("hold_rod", 0.009).bones
    for digit in (0, 1, 4):
        skin = np.concatenate(hand_grips._placed(bones, digit))
        assert abs(hand_grips._from_rod(skin, held.point, held.axis, 0.0045).min()) < 0.002


def test_the_left_is_the_image_of_the_right_and_holds_to_its_own_thumb():
    right, left = sculpt.hand("fist"), sculpt.hand("fist", side="left", sleeve="#334455")
    mirror = np.array([1.0, -1.0, 1.0])
    points = np.random.default_rng(1).uniform(-0.05, 0.15, (200, 3))
    assert np.allclose(right.shape(points), left.shape(points * mirror))
    assert np.allclose(left.axis, right.axis * mirror) and [one.name for one in left.meshes(fine=False)] == [
        "skin",
        "nails",
        "sleeve",
    ]
    for one in left.meshes(fine=False):  # turned inside out by nobody
        a, b, c = (one.vertices[one.faces[:, k]] for k in range(3))
        assert np.einsum("fi,fi->", a, np.cross(b, c)) > 0 or one.name == "nails"


def test_a_pose_on_the_way_is_between_and_a_child_is_smaller():
    open_, closed = sculpt.hand("open"), sculpt.hand("fist")
    half = open_.towards(closed, 0.5)
    assert np.allclose(half.pose.numbers(), (open_.pose.numbers() + closed.pose.numbers()) / 2)
    adult, child = sculpt.hand("pinch", 0.019), sculpt.hand("pinch", 0.012, length=0.12)
    assert np.allclose(child.point, adult.point * 0.12 / 0.19) and np.allclose(
        child.pose.numbers(), adult.pose.numbers()
    )


@pytest.mark.parametrize(
    ("how", "says"),
    [
        ({"pose": "wave"}, "take one of: open"),
        ({"pose": "grip", "size": 0.2}, "holds 6 to 80 mm"),
        ({"side": "middle"}, "left or right"),
        ({"length": 3.0}, "long"),
    ],
)
def test_what_no_hand_can_is_refused(how, says):
    with pytest.raises(ValueError, match=says):
        sculpt.hand(**how)

"""The moments of an open shutter follow how far anything goes in the picture."""

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor
from worldengine.film import smear
from worldengine.film.renderers.preview.eye import View
from worldengine.film.smear import Drawn

FRONT = np.array([[1.0, 0, 0], [0, 0, -1.0], [0, 1.0, 0]])  # right is x, up is z, it looks along y


def view(x: float = 0.0, turn: float = 0.0) -> View:
    c, s = np.cos(turn), np.sin(turn)
    return View(np.array([x, -2.0, 0.0]), np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ FRONT, (0.8, 0.45))


def shown(places=(), turns=None, halves=()) -> Drawn:
    """Boxes, or points where there are no halves."""
    places = np.asarray(places, dtype=float).reshape(-1, 3)
    count = len(places) if len(halves) else 0
    turned = np.tile(np.eye(3), (count, 1, 1)) if turns is None else np.asarray(turns)
    return Drawn(places[:count], turned, np.asarray(halves, dtype=float).reshape(-1, 3), places[count:])


def travel(*moments: Drawn, views=None, height: int = 90) -> float:
    return smear.travel_px(views or [view()] * len(moments), moments, height)


def test_a_point_goes_as_far_as_the_lens_says_and_none_behind_or_far_beside_counts():
    start = np.zeros((1, 3))
    for gone in ((0.1, 0, 0), (0, 0, 0.1)):  # a tenth of a metre, two metres away
        assert travel(shown(start), shown(start + gone)) == pytest.approx(0.05 / 0.45 * 45)
    assert travel(shown(start - (0, 5, 0)), shown(start - (1, 5, 0))) == 0.0
    beside = np.array([[9.0, 0, 0]])
    assert travel(shown(beside), shown(beside * 1.5)) == 0.0
    assert travel(shown(), shown()) == 0.0


def test_a_camera_that_pans_or_goes_along_counts_too():
    still = shown(np.zeros((1, 3)))
    assert travel(still, still, views=(view(), view(turn=0.02))) == pytest.approx(2.0, rel=0.6)
    assert travel(still, still, views=(view(), view(x=0.1))) == pytest.approx(5.0, rel=0.3)
    assert travel(shown(), shown(), views=(view(), view(x=0.1))) > 1.0, "over bare ground"


def test_what_is_larger_than_the_picture_goes_as_far_as_its_side_does():
    wagon, gone = [(10, 0.5, 2.0)], 0.4  # its near side is two metres away
    for way, far in (((gone, 0, 0), gone / 2 / 0.45 * 360), ((0, 0, 0), 0.0)):
        found = travel(shown([(0, 0.5, 0)], halves=wagon), shown([np.add((0, 0.5, 0), way)], halves=wagon), height=720)
        assert found == pytest.approx(far, rel=1e-6)
    around = [(10, 10, 10)]  # the camera is within
    assert travel(shown([(0, 0, 0)], halves=around), shown([(gone, 0, 0)], halves=around)) > 0.5


def test_a_beam_across_the_picture_counts_though_both_its_ends_are_beside_it():
    beam = [(20, 0.02, 0.02)]
    for low in (0.0, 0.3):
        found = travel(shown([(0, 0, low)], halves=beam), shown([(0, 0, low + 0.1)], halves=beam))
        assert found == pytest.approx(0.1 / 2 / 0.45 * 45, rel=0.05)
    below = [(20, 0.02, 0.02)]
    assert travel(shown([(0, 0, -2)], halves=below), shown([(0, 0, -2.1)], halves=below)) == 0.0


@pytest.mark.parametrize("turn", [90, 180, 270, 360, 720])
def test_what_turns_goes_far_even_where_it_ends_as_it_began(turn):
    def fan(angle):
        c, s = np.cos(angle), np.sin(angle)
        return shown([(0, 0, 0)], [[(c, 0, s), (0, 1, 0), (-s, 0, c)]], [(0.5, 0.01, 0.01)])

    moments = [fan(np.radians(turn) * share) for share in smear.LOOKS]
    assert travel(*moments) > 1.3 * 0.5 / 2 / 0.45 * 45, "further than its own radius"


@pytest.mark.parametrize(("pixels", "found"), [(0.0, 1), (0.99, 1), (1.0, 2), (3.9, 2), (9.0, 5), (100.0, 8)])
def test_more_moments_for_what_is_faster_and_never_more_than_the_film_says(pixels, found):
    assert smear.moments(pixels, 8) == found and smear.moments(pixels, 1) == 1


def test_all_but_endless_planes_has_a_box_around_it():
    spec = empty()
    floor(spec)
    ball(spec, "one", (0, 0, 0.5), radius=0.1)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    there = smear.drawn(model, data)
    assert len(there.halves) == 1 and np.allclose(there.middles, [(0, 0, 0.5)]) and np.allclose(there.halves, 0.1)
    assert np.allclose(there.at(np.array([0]), np.array([[0.1, 0, 0]])), [(0.1, 0, 0.5)])

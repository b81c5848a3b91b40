"""The moments of an open shutter follow how far anything goes in the picture."""

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor
from worldengine.film import smear
from worldengine.film.renderers.preview.eye import View

FRONT = np.array([[1.0, 0, 0], [0, 0, -1.0], [0, 1.0, 0]])  # right is x, up is z, it looks along y


def view(x: float = 0.0, turn: float = 0.0) -> View:
    c, s = np.cos(turn), np.sin(turn)
    return View(np.array([x, -2.0, 0.0]), np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ FRONT, (0.8, 0.45))


def test_a_point_goes_as_far_as_the_lens_says_and_none_behind_or_far_beside_counts():
    eye, start = view(), np.zeros((1, 3))
    for gone in ((0.1, 0, 0), (0, 0, 0.1)):  # a tenth of a metre, two metres away
        assert smear.travel_px(eye, eye, start, start + gone, 90) == pytest.approx(0.05 / 0.45 * 45)
    assert smear.travel_px(eye, eye, start - (0, 5, 0), start - (1, 5, 0), 90) == 0.0
    beside = np.array([[9.0, 0, 0]])
    assert smear.travel_px(eye, eye, beside, beside * 1.5, 90) == 0.0
    assert smear.travel_px(eye, eye, np.zeros((0, 3)), np.zeros((0, 3)), 90) == 0.0


def test_a_camera_that_pans_or_goes_along_counts_too():
    still = np.zeros((1, 3))
    assert smear.travel_px(view(), view(turn=0.02), still, still, 90) == pytest.approx(2.0, rel=0.6)
    assert smear.travel_px(view(), view(x=0.1), still, still, 90) == pytest.approx(5.0, rel=0.3)
    assert smear.travel_px(view(), view(x=0.1), np.zeros((0, 3)), np.zeros((0, 3)), 90) > 1.0, "over bare ground"


@pytest.mark.parametrize(("pixels", "found"), [(0.0, 1), (0.99, 1), (1.0, 2), (3.9, 2), (9.0, 5), (100.0, 8)])
def test_more_moments_for_what_is_faster_and_never_more_than_the_film_says(pixels, found):
    assert smear.moments(pixels, 8) == found and smear.moments(pixels, 1) == 1


def test_all_but_endless_planes_has_corners_around_it():
    spec = empty()
    floor(spec)
    ball(spec, "one", (0, 0, 0.5), radius=0.1)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    corners = smear.points(model, data)
    assert corners.shape == (8, 3)
    assert np.allclose(corners.min(axis=0), (-0.1, -0.1, 0.4)) and np.allclose(corners.max(axis=0), (0.1, 0.1, 0.6))

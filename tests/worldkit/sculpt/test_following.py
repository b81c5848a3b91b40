"""Places along a curve, on the skin of a shape, and nets."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldkit import sculpt
from worldkit.sculpt import brushes

BEND = [(0.0, 0.0, 0.0), (0.1, 0.0, 0.02), (0.2, 0.05, 0.0), (0.2, 0.15, 0.05)]


@settings(deadline=None, max_examples=30)
@given(st.integers(2, 40), st.floats(0, 0.4), st.floats(0.6, 1))
def test_places_stand_at_equal_distances_on_the_curve(count, start, end):
    places = sculpt.along(BEND, count, start=start, end=end)
    assert len(places) == count
    line = sculpt.tube(BEND, 0.01)
    assert np.abs(line(np.array([place.pos for place in places])) + 0.005).max() < 1e-3
    assert np.allclose([np.linalg.norm(place.forward) for place in places], 1)
    shares = sculpt.share_along(np.array([place.pos for place in places]), BEND)
    assert np.allclose(shares, [place.share for place in places], atol=0.01)


def test_one_place_stands_in_the_middle():
    (place,) = sculpt.along([(0, 0, 0), (1, 0, 0)], 1)
    assert np.allclose(place.pos, (0.5, 0, 0)) and np.allclose(place.forward, (1, 0, 0))


@settings(deadline=None, max_examples=30)
@given(st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1))
def test_the_skin_is_where_the_distance_is_zero(way):
    egg = sculpt.ellipsoid((0.3, 0.2, 0.4)).translate(0.1, 0, 0)
    place = sculpt.skin(egg, (0.1, 0, 0), (0.1 + way[0], way[1], way[2]))
    assert abs(egg(np.array([place]))[0]) < 1e-6
    assert (np.array(place) - (0.1, 0, 0)) @ np.array(way) > 0


def test_what_is_nowhere_is_refused():
    with pytest.raises(ValueError, match="nothing of the shape"):
        sculpt.skin(sculpt.sphere(0.1), (1, 0, 0), (2, 0, 0))
    with pytest.raises(ValueError, match="are none"):
        sculpt.along(BEND, 3, start=-1)
    with pytest.raises(ValueError, match="leave nothing"):
        brushes.net(np.zeros((1, 3)), 0.1, 0.1)


def test_a_net_covers_a_part_and_is_the_same_each_time():
    points = np.random.default_rng(1).uniform(-1, 1, (4000, 3))
    mask = brushes.net(points, 0.3, 0.06, seed=2)
    assert 0.1 < mask.mean() < 0.6 and mask.min() >= 0 and mask.max() <= 1
    assert (mask == brushes.net(points, 0.3, 0.06, seed=2)).all()


@pytest.mark.parametrize("turn", [1, -1])
def test_an_outline_may_run_either_way_round(turn):
    outline = [(0, 0), (0.1, 0), (0.1, 0.05), (0, 0.05)][::turn]
    made = sculpt.made(sculpt.extruded(outline, 0.02, rounded=0.002), cells=32)
    assert made.volume == pytest.approx(1e-4, rel=0.04)

"""Of very many round things each is drawn about as finely as it is seen: one before the lens does not make all of them dear."""

import numpy as np
import pytest

from worldengine.film.renderers.preview import swarms
from worldengine.film.renderers.preview.eye import View
from worldengine.film.renderers.preview.supplies import sectors


def triangles(pixels: np.ndarray) -> int:
    """Triangles of balls of such radii, pixels, as they are drawn."""
    drawn = ((sectors(px, swarms.least_sectors(len(pixels))), count) for _, count, px in swarms.stretches(pixels))
    return sum(around * (around // 2) * 2 * count for around, count in drawn)


def test_one_flake_before_the_lens_does_not_make_five_thousand_dear():
    pixels = np.append(np.random.default_rng(1).uniform(0.3, 3.0, 4999), 800.0)
    as_before = sectors(800.0) ** 2 * len(pixels)
    assert triangles(pixels) < 0.05 * as_before


def test_each_is_as_fine_as_it_is_seen_and_drawn_once():
    pixels = np.random.default_rng(2).pareto(1.2, 3000)
    found = list(swarms.stretches(pixels))
    assert [first for first, *_ in found] == [0, *np.cumsum([count for _, count, _ in found])[:-1]]
    assert sum(count for _, count, _ in found) == 3000 and len(found) <= 2 * swarms.NEAREST + 1
    assert all(px >= pixels[first : first + count].max() for first, count, px in found)


@pytest.mark.parametrize("count", [1, swarms.MANY - 1])
def test_few_are_drawn_together_and_as_before(count):
    pixels = np.linspace(1.0, 90.0, count)
    assert list(swarms.stretches(pixels)) == [(0, count, pixels[-1])]
    assert swarms.least_sectors(count) == 16 and swarms.least_sectors(swarms.MANY) < 16
    assert list(swarms.stretches(np.full(swarms.MANY, 2.0))) == [(0, swarms.MANY, 2.0)]


def test_what_is_behind_the_eye_counts_for_nothing():
    rows = np.zeros((swarms.MANY, 40), np.float32)
    rows[:, 12:15], rows[:, 7] = 0.01, -3.0
    rows[0, 7] = 3.0
    view = View(np.zeros(3), np.array([[1.0, 0, 0], [0, 0, -1.0], [0, 1.0, 0]]), (0.5, 0.5))
    assert view.forward == pytest.approx((0, 1, 0))
    pixels = swarms.seen_px(rows, view, 100)
    assert pixels[0] == pytest.approx(0.01 / 3 * 100) and (pixels[1:] == 0).all()

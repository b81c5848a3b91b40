"""Masks and colours by position."""

import numpy as np
import pytest

from worldkit import sculpt
from worldkit.sculpt import brushes

LINE = np.column_stack([np.linspace(0, 1, 1001), np.zeros((1001, 2))])


def test_stripes_cover_their_share():
    assert brushes.stripes(LINE[:, 0], 0.1, share=0.3, soft=0.0).mean() == pytest.approx(0.3, abs=0.01)


def test_a_gradient_meets_its_stops():
    rgb = brushes.gradient(np.array([0.0, 0.5, 1.0]), {0.0: "#000000", 1.0: "#ff8000"})
    assert rgb[1] == pytest.approx([0.5, 128 / 510, 0.0])


def test_spots_are_there_and_apart():
    points = np.random.default_rng(1).uniform(0, 1, (20000, 3))
    share = brushes.spots(points, 0.2, 0.1, seed=4).mean()
    assert 0.02 < share < 0.2
    assert not np.array_equal(brushes.spots(points, 0.2, 0.1, seed=4), brushes.spots(points, 0.2, 0.1, seed=5))


def test_within_another_shape():
    mask = brushes.within(sculpt.sphere(0.4), soft=0.0)(LINE)
    assert mask.sum() == pytest.approx(200, abs=1)


@pytest.mark.parametrize(
    ("facing", "right"), [("-y", (1, 0, 0)), ("+x", (0, 1, 0)), ("+z", (1, 0, 0)), ("-x", (0, -1, 0))]
)
def test_words_read_from_left_to_right_for_who_looks_at_them(facing, right):
    across, up = np.meshgrid(np.linspace(-0.1, 0.1, 201), np.linspace(-0.1, 0.1, 201))
    above = (0, 1, 0) if facing == "+z" else (0, 0, 1)
    points = across.reshape(-1, 1) * np.array(right) + up.reshape(-1, 1) * np.array(above)
    mask = brushes.label(points, "L", centre=(0, 0, 0), width=0.2, facing=facing).reshape(201, 201)
    assert mask[:, :100].sum() > 1.3 * mask[:, 101:].sum() > 0  # its stem is on the left, its foot below
    assert mask[:100].sum() > 1.1 * mask[101:].sum() > 0


def test_words_stay_on_their_side():
    normals = np.tile((0.0, 1.0, 0.0), (len(LINE), 1))
    assert not brushes.label(LINE - 0.5, "MMM", centre=(0, -0.5, -0.5), width=0.9, facing="-y", normals=normals).any()


@pytest.mark.parametrize("wrong", [lambda: brushes.colour("red"), lambda: brushes.label(LINE, "a", centre=(0, 0, 0), width=1, facing="up"), lambda: brushes.spots(LINE, 0.1, 0.3)])  # fmt: skip
def test_what_cannot_be_is_refused_with_words(wrong):
    with pytest.raises(ValueError, match=r".{15}"):
        wrong()


def test_a_dial_has_its_ticks_where_the_hours_are():
    turns = np.radians(np.arange(0, 360, 1.0))
    on = np.stack([np.zeros(360), 0.04 * np.sin(turns), 0.04 * np.cos(turns)], axis=1)
    mask = brushes.dial(on, 12, 0.07, 0.09, 0.001)
    assert np.flatnonzero(mask).tolist() == list(range(0, 360, 30))
    assert not brushes.dial(1.2 * on, 12, 0.07, 0.09, 0.001).any()

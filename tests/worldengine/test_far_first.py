"""See-through things are drawn the farthest first, and what is within another before that."""

import numpy as np

from worldengine.film.renderers.preview.far_first import far_first

EYE, FORWARD = np.zeros(3), np.array([0.0, 1.0, 0.0])


def order(*things):
    """Of things (distance before the eye, half their size), each in the middle of its box."""
    frames = np.array([np.column_stack([np.eye(3), (0, away, 0)]) for away, _ in things])
    boxes = np.array([(0, 0, 0, *half) for _, half in things], float)
    return far_first(frames, boxes, np.linalg.norm(boxes[:, 3:], axis=1), EYE, FORWARD)


BOTTLE, PANE, WINE = (0.05, 0.05, 0.15), (1.0, 0.01, 1.0), (0.04, 0.04, 0.1)


def test_a_wide_pane_behind_a_small_bottle_is_drawn_first():
    assert order((1.0, BOTTLE), (1.5, PANE)) == [1, 0]
    assert order((2.0, BOTTLE), (1.5, PANE)) == [0, 1]


def test_wine_is_drawn_before_its_bottle_wherever_its_middle_is():
    for nearer in (-0.02, 0.0, 0.02):
        assert order((2.0, BOTTLE), (2.0 + nearer, WINE), (3.0, PANE)) == [2, 1, 0]


def test_many_go_by_their_distance_only():
    assert order(*((float(k), BOTTLE) for k in range(400))) == list(range(400))[::-1]

"""A picture's coarser copies, by which far things are painted, keep its light."""

import numpy as np
import pytest

from worldengine.film.renderers.preview.gl import coarser


def light(pixels: np.ndarray) -> np.ndarray:
    value = pixels[..., :3] / 255.0
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


@pytest.mark.parametrize("shape", [(8, 8), (4, 32), (16, 1), (1, 1)])
def test_each_level_halves_the_sides_and_keeps_the_mean_light(shape: tuple[int, int]) -> None:
    pixels = np.random.default_rng(1).integers(0, 256, (*shape, 4), dtype=np.uint8)
    levels = list(coarser(pixels))
    assert levels[0] is pixels
    assert [level.shape[:2] for level in levels] == [
        tuple(max(1, side >> n) for side in shape) for n in range(max(shape).bit_length())
    ]
    for level in levels:
        assert level.dtype == np.uint8
        # Half of one of 255 steps, where they are widest apart in light.
        np.testing.assert_allclose(light(level).mean((0, 1)), light(pixels).mean((0, 1)), atol=0.005)
        np.testing.assert_allclose(level[..., 3].mean(), pixels[..., 3].mean(), atol=0.6)


def test_black_and_white_make_the_grey_of_half_the_light_and_one_colour_stays_itself() -> None:
    board = np.zeros((2, 2, 4), np.uint8)
    board[0, 0] = board[1, 1] = 255
    assert list(coarser(board))[-1].tolist() == [[[188, 188, 188, 128]]]
    for value in range(256):
        assert (list(coarser(np.full((4, 4, 4), value, np.uint8)))[-1] == value).all()


def test_a_picture_that_cannot_be_halved_evenly_is_left_to_the_driver() -> None:
    assert len(list(coarser(np.zeros((6, 8, 4), np.uint8)))) == 1

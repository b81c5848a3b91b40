"""Words are written where they stand, with the shadow around them, and the rest of a picture is not read for them."""

import cv2
import numpy as np
import pytest

from worldengine.film import lettering

SIZE = (270, 480)


def over_all(image, text, at, size, weight, colour, strength):
    """The letters and their shadow, reckoned for every pixel."""
    mask = np.zeros(image.shape[:2], np.uint8)
    cv2.putText(mask, text, at, 255, lettering._font(), size, weight)
    shade = cv2.GaussianBlur(mask, (0, 0), max(size * 0.12, 0.8)).astype(np.float32) / 255 * 0.75 * strength
    letters = mask.astype(np.float32) / 255 * strength
    light = image.astype(np.float32) * (1 - shade[..., None])
    light = light * (1 - letters[..., None]) + np.asarray(colour, np.float32) * letters[..., None]
    return np.clip(light + 0.5, 0, 255).astype(np.uint8)


@pytest.mark.parametrize("at", [(200, 140), (-6, 12), (420, 268), (60, 4), (5000, 100)])
@pytest.mark.parametrize(("size", "weight"), [(11, 450), (23, 600)])
def test_they_look_as_if_every_pixel_had_been_reckoned(at, size, weight):
    image = np.random.default_rng(size).integers(0, 256, (*SIZE, 3), dtype=np.uint8)
    wanted = over_all(image, "drawn: gÄj", at, size, weight, (250, 248, 244), 0.9)
    lettering._write(image, "drawn: gÄj", at, size, weight, (250, 248, 244), 0.9)
    assert np.array_equal(image, wanted)


def test_only_what_is_around_them_is_blurred(monkeypatch):
    blurred, blur = [], cv2.GaussianBlur
    monkeypatch.setattr(cv2, "GaussianBlur", lambda mask, *rest: blurred.append(mask.size) or blur(mask, *rest))
    picture = np.full((*SIZE, 3), 90, np.uint8)
    shown = lettering.letter(picture, 1.0, (), 0.25, False, "drawn: steam")
    assert (shown != picture).any() and (picture == 90).all() and sum(blurred) < picture.size / 3 / 8

"""A caption in strokes too thin for the mosaic is seen in a still, and what another driver smooths otherwise is no caption."""

import cv2
import numpy as np
import pytest

from worldwright.stamp.redrawn import Shown


def scene(smooth: int, wide: int = 640) -> np.ndarray:
    """A ball, a fence of thin bars and a shaded ground, with edges as smooth as a driver likes."""
    high, more = wide * 9 // 16, 4
    large = np.zeros((high * more, wide * more, 3), np.uint8)
    large[:] = np.linspace(60, 190, high * more, dtype=np.uint8)[:, None, None]
    cv2.circle(large, (wide * more // 3, high * more // 2), 90 * more * wide // 640, (40, 60, 200), -1)
    for n in range(12):
        x = wide * more // 2 + n * 20 * more * wide // 640
        cv2.line(large, (x, high * more // 4), (x + 40, high * more * 3 // 4), (235, 235, 235), 2 * more)
    picture = cv2.resize(large, (wide, high), interpolation=cv2.INTER_AREA if smooth else cv2.INTER_NEAREST)
    return cv2.GaussianBlur(picture, (0, 0), 0.6) if smooth > 1 else picture


def said(picture: np.ndarray, again: np.ndarray, folder) -> str:
    path = folder / "side.png"
    cv2.imwrite(str(path), picture)
    return Shown.of(picture, path.name, path.name, 0.0, "side", path).against(cv2.imencode(".png", again)[1].tobytes())


@pytest.mark.parametrize("wide", [480, 640, 1280])
def test_edges_that_another_driver_draws_otherwise_are_no_strokes(tmp_path, wide) -> None:
    moved = np.roll(scene(1, wide), 1, axis=1)  # a pixel aside
    for again in (scene(1, wide), scene(0, wide), scene(2, wide), moved):
        assert said(scene(1, wide), again, tmp_path) == ""
    brighter = np.clip(scene(1, wide).astype(int) + 12, 0, 255).astype(np.uint8)
    assert said(brighter, scene(1, wide), tmp_path) == ""


@pytest.mark.parametrize("thick", [1, 2])
@pytest.mark.parametrize("wide", [640, 1280])
def test_a_caption_in_thin_strokes_is_seen_in_and_out(tmp_path, thick, wide) -> None:
    plain = scene(1, wide)
    painted = plain.copy()
    cv2.putText(
        painted, "slides 9 m", (wide // 20, wide // 10), cv2.FONT_HERSHEY_SIMPLEX, wide / 900, (255, 255, 255), thick
    )
    for one, other in ((painted, plain), (plain, painted)):
        assert "does not show this world" in said(one, other, tmp_path)
    if thick == 1:  # which the mosaic does not see
        assert Shown.of(painted, "", "", 0.0, "side").against(cv2.imencode(".png", plain)[1].tobytes()) == ""
        assert "strokes over" in said(painted, plain, tmp_path)

"""Take the noise out of what is drawn over a plate, and leave everything else as the plate has it: there nothing flickers."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .walked import Rays, spread

AROUND_PX = 64
"""So far around what differs a denoiser sees what stands."""
FULL_PX, NONE_PX = 8.0, 40.0
"""So near to what differs a picture is the patch, and from so far away on it is the plate: it cannot be told where that begins."""
FINE = 0.25
"""Patches of at most this share of a picture are denoised with care."""
MIDDLE = 0.18
"""To this the mean brightness of a picture is brought while it is denoised, so that light means the same in all patches."""

Box = tuple[slice, slice]


def boxes(differs: np.ndarray, height: int, width: int) -> list[Box]:
    """The rows and columns of a picture (height, width) around the places of a coarser mask (h, w), which do not overlap."""
    import cv2

    rows, columns = differs.shape
    reach = -(-AROUND_PX * rows // height)
    mask = cv2.dilate(differs.astype(np.uint8), np.ones((2 * reach + 1,) * 2, np.uint8))
    while True:
        _, _, found, _ = cv2.connectedComponentsWithStats(mask, connectivity=8)
        whole = np.zeros_like(mask)
        for x, y, wide, high, _ in found[1:]:
            whole[y : y + high, x : x + wide] = 1
        if np.array_equal(whole, mask):
            break
        mask = whole
    return [
        (
            slice(int(y) * height // rows, int(y + high) * height // rows),
            slice(int(x) * width // columns, int(x + wide) * width // columns),
        )
        for x, y, wide, high, _ in found[1:]
    ]


def brightening(light: np.ndarray) -> float:
    """By how much light (H, W, 3) is to be multiplied so that the mean of its brightness, by its logarithm, is `MIDDLE`."""
    bright = light[::4, ::4] @ np.array([0.2126, 0.7152, 0.0722], np.float32)
    return float(MIDDLE / np.exp(np.log(np.maximum(bright, 1e-6)).mean()))


def mended(
    clean: np.ndarray, rays: Rays, differs: np.ndarray, denoise: Callable[[Rays, float, bool], np.ndarray]
) -> np.ndarray:
    """Light without noise (H, W, 3): that of a plate, `clean`, and in patches that of `rays` where a mask (h, w) says it differs.

    Args:
        clean: of the plate.
        rays: of the picture; where the mask does not have it they are those of the plate.
        differs: the mask, of any size.
        denoise: takes the noise out of a patch; it is told by how much to brighten it, and whether to do it with care.
    """
    import cv2

    height, width = clean.shape[:2]
    mask, scale = spread(differs, height, width), brightening(clean)
    found, out = boxes(differs, height, width), clean.copy()
    fine = sum(mask[box].size for box in found) <= FINE * mask.size
    for box in found:
        away = cv2.distanceTransform((~mask[box]).astype(np.uint8), cv2.DIST_L2, 3)
        share = np.clip((NONE_PX - away) / (NONE_PX - FULL_PX), 0.0, 1.0)[..., None]
        patch = denoise(Rays(*(part[box] for part in rays)), scale, fine)
        out[box] += share * share * (3.0 - 2.0 * share) * (patch - out[box])
    return out

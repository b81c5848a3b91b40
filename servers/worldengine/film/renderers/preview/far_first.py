"""In which order see-through things are drawn: the farthest first, but what is within another before that."""

from __future__ import annotations

import numpy as np

MOST = 256
"""Of more things than this, which are small then, only the distance counts."""


def far_first(
    frames: np.ndarray, boxes: np.ndarray, reach: np.ndarray, eye: np.ndarray, forward: np.ndarray
) -> list[int]:
    """The numbers of N things in the order to draw them.

    Args:
        frames: (N, 3, 4) rotation and place of each, m.
        boxes: (N, 6) middle and half the size of the box around it, in its own frame, m.
        reach: (N,) radius of the ball around it, m; 0 of what is endless.
        eye: (3,) m.
        forward: (3,) where the eye looks, of length 1.
    """
    places = frames[:, :, 3].astype(float)
    depth = (places - eye) @ forward
    if 1 < len(depth) <= MOST:
        # Where each middle is in each other's frame: a wide pane holds nothing of what stands before it, so no balls do here.
        local = np.einsum("nij,mni->mnj", frames[:, :, :3], places[:, None] - places[None])
        held = (np.abs(local - boxes[:, :3]) <= boxes[:, 3:]).all(axis=2)
        held &= (reach[:, None] < reach[None]) & (reach[:, None] > 0)  # (M, N): M within N
        depth = np.minimum(depth, np.where(held, depth[:, None], np.inf).min(axis=0))
    return [int(number) for number in np.lexsort((reach, -depth))]

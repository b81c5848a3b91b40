"""Small motions as screws: a turn about an axis and a step along it, taken in part or many times over."""

from __future__ import annotations

import numpy as np

SHAPED = 1e-3
"""By so much no two edges of a thing are out of the square that only turns."""


def screwed(turn: np.ndarray, step: np.ndarray, times: float) -> tuple[np.ndarray, np.ndarray]:
    """A small motion (N, 3, 3) and (N, 3), m, so many times over: on along its screw, and straight on where a thing changes its shape."""
    rigid = np.abs(turn @ np.swapaxes(turn, 1, 2) - np.eye(3)).max(axis=(1, 2)) < SHAPED
    over = turn - np.eye(3)
    axis, angle = turning(turn)
    square, still = axis @ axis, np.abs(angle) < 1e-9

    def swept(by: np.ndarray) -> np.ndarray:
        """By which a step along a screw that turns by some angles (N,) becomes what its end goes, and which is the sum of the turns."""
        wide = np.where(still, 1.0, by)
        first, second = (1.0 - np.cos(wide)) / wide, 1.0 - np.sin(wide) / wide
        return np.where(
            still[:, None, None], np.eye(3), np.eye(3) + first[:, None, None] * axis + second[:, None, None] * square
        )

    by = times * angle
    turned = np.eye(3) + np.sin(by)[:, None, None] * axis + (1.0 - np.cos(by))[:, None, None] * square
    along = np.linalg.solve(swept(angle), step[..., None])
    carried = times * (swept(by) @ along)[..., 0]
    return (
        np.where(rigid[:, None, None], turned, np.eye(3) + times * over),
        np.where(rigid[:, None], carried, times * step),
    )


def turning(turn: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """By which unit vectors, as cross products (N, 3, 3), and how far, rad (N,), some turns (N, 3, 3) turn.

    Half a turn is the same either way around, and so is its streak, as long before the middle as after it.
    """
    back = np.swapaxes(turn, 1, 2)
    skew, cosine = 0.5 * (turn - back), 0.5 * (np.trace(turn, axis1=1, axis2=2) - 1.0)
    around = np.stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]], axis=1)
    sine = np.linalg.norm(around, axis=1)
    # Of far turns the skew part fades: the other one has the axis, but for its sign.
    least = np.maximum(1.0 - cosine, 1e-12)[:, None, None]
    outer = (0.5 * (turn + back) - cosine[:, None, None] * np.eye(3)) / least
    longest = np.diagonal(outer, axis1=1, axis2=2).argmax(axis=1)
    far = np.take_along_axis(outer, longest[:, None, None], axis=2)[:, :, 0]
    far = far / np.maximum(np.linalg.norm(far, axis=1), 1e-12)[:, None]
    far = np.where(((far * around).sum(axis=1) < 0)[:, None], -far, far)
    x, y, z = np.where((cosine < 0)[:, None], far, around / np.maximum(sine, 1e-12)[:, None]).T
    rest = np.zeros_like(x)
    axis = np.stack([rest, -z, y, z, rest, -x, -y, x, rest], axis=1).reshape(-1, 3, 3)
    return axis, np.arctan2(sine, cosine)

"""The corners of a hull that has too many are chosen evenly, so that a thing stands on the whole of its floor."""

import numpy as np

from worldkit.sculpt import crisp
from worldkit.sculpt.hulls import CORNERS, corners_of


def test_what_is_finely_turned_keeps_corners_all_round_its_floor_and_its_top():
    foot = crisp.lathe([(0.042, 0), (0.044, 0.003), (0.044, 0.007), (0.036, 0.012), (0.010, 0.030)])
    chosen = corners_of(foot.skin().vertices)
    assert CORNERS < len(chosen) <= 2 * CORNERS
    for level, radius in ((0.0, 0.042), (0.030, 0.010)):
        ring = chosen[np.abs(chosen[:, 2] - level) < 1e-6]
        turns = np.sort(np.arctan2(ring[:, 1], ring[:, 0]))
        gaps = np.diff(np.r_[turns, turns[0] + 2 * np.pi])
        assert np.allclose(np.hypot(*ring[:, :2].T), radius, atol=1e-6)
        assert gaps.max() < np.radians(90), f"a side is missing at {level} m"
    assert np.ptp(chosen, axis=0).max() > 0.0879

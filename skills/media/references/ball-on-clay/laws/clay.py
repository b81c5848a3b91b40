"""A block of modelling clay on a board: it yields where the ball comes down, and keeps the dent."""

import numpy as np

from worldkit import sculpt
from worldkit.matter import Moulded, clay
from worldkit.sculpt.deformed import noise

BLOCK = sculpt.box((0.16, 0.16, 0.08), rounded=0.014)  # m
TOP = 0.018  # m: the board's


def worn(corners, depth):  # noqa: ARG001
    """Grey-brown, a little lighter and darker by places as clay is that hands have kneaded."""
    mottled = noise(corners, 0.02, seed=4, octaves=3)[:, None]
    return np.array((0.62, 0.45, 0.35)) * (1 + 0.09 * mottled)


class Clay(Moulded):
    """The block: it lies on the board and is free from the start."""

    name, bodies, shown_by = "clay", ("board", "ball"), "clay"

    def __init__(self, clay_density, clay_young, clay_yields):
        super().__init__(
            clay(clay_density, clay_young, clay_yields), BLOCK, (0, 0, TOP + 0.04), 0.0135,
            skin=sculpt.rough(BLOCK, 0.0008, 0.012, seed=2), grain=0.003, paint=worn,
        )  # fmt: skip

"""A glazed vase with dried berries on thin stalks, drawn only: what stands in a still life beside what happens. Metres; true size."""

from typing import TYPE_CHECKING

import numpy as np

from ..drawn_only import Surface
from ..trees import Mesh, limb
from . import Place
from .furniture import put
from .pieces import ball, placed, turned

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDE = 0.14
"""So far around its foot most of the stalks reach, m."""
PROFILE = (
    (0.0, 0.0), (0.042, 0.0), (0.047, 0.006), (0.066, 0.06), (0.072, 0.1), (0.058, 0.145), (0.03, 0.178), (0.024, 0.195),
    (0.031, 0.212), (0.027, 0.213), (0.02, 0.196), (0.0, 0.18),
)  # fmt: skip
"""Radius and height of the vase, m, from the foot over the lip to its inside."""
STALKS, BERRIES, MOUTH = 9, 13, 0.2


def stand(film: "Dressing", place: Place, at: tuple[float, float, float]) -> None:
    """Draw it with its foot at a place."""
    random, stalks, berries = place.random, [], []
    round_one = ball(1)
    for number in range(STALKS):
        yaw = 2 * np.pi * (number + random.uniform(-0.3, 0.3)) / STALKS
        out, tall = random.uniform(0.03, 0.15), random.uniform(0.2, 0.34)
        t = np.linspace(0.0, 1.0, 9)[:, None]
        aside = np.array([np.cos(yaw), np.sin(yaw), 0.0])
        line = (0.012 + out * t**1.6) * aside + np.array([0, 0, 1]) * (MOUTH - 0.08 + (tall + 0.08) * t)
        stalks.append(limb(line, list(np.linspace(0.0028, 0.0014, len(line))), sides=5))
        for share in np.linspace(0.42, 1.0, BERRIES):
            twig, size = random.uniform(-1, 1, 3) * (0.018, 0.018, 0.008), random.uniform(0.0055, 0.0085)
            foot = line[int(share * 8)] + (share * 8 % 1) * (line[min(int(share * 8) + 1, 8)] - line[int(share * 8)])
            stalks.append(limb(np.array([foot, foot + twig]), [0.0010, 0.0008], sides=3))
            berries.append(_moved(round_one, foot + twig, size))
    put(film, place, "vase", [turned(list(PROFILE))], at, Surface(colour="#2f6f6c", roughness=0.18))
    put(film, place, "dry stalks", stalks, at, Surface(colour="#7a5a34", roughness=0.8))
    put(film, place, "dry berries", berries, at, Surface(colour="#d8a45c", roughness=0.55))


def _moved(mesh: Mesh, to: np.ndarray, size: float) -> Mesh:
    x, y, z = (float(v) for v in to)
    return placed(mesh, (x, y, z), scale=size)

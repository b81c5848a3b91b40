"""Fork, knife and spoon of one service. Metres; each lies flat on z = 0, its tip along +x."""

import numpy as np

from worldkit import sculpt
from worldkit.sculpt import Part, crisp

ACROSS = np.linspace(-1, 1, 9)


def strip(rows, y=0.0):
    """A thin band along x by rows of (x, underside, half width, thickness, how far its edges rise above its middle)."""
    sections = []
    for x, low, half, thick, dish in rows:
        edge = low + dish * ACROSS**2
        under = [(x, y + half * a, z) for a, z in zip(ACROSS, edge, strict=True)]
        over = [(x, y + 0.9 * half * a, z + thick) for a, z in zip(ACROSS[::-1], edge[::-1], strict=True)]
        sections.append(under + over)
    return crisp.loft(sections)


def slab(low, high):
    """A flat piece from corner to corner: what lies on it lies still, as it would not on the many corners of a bent hull."""
    middle = [(a + b) / 2 for a, b in zip(low, high, strict=True)]
    return sculpt.box(tuple(b - a for a, b in zip(low, high, strict=True))).translate(*middle)


TAIL, NECK = slab((-0.100, -0.009, 0.0), (-0.068, 0.009, 0.004)), slab((-0.070, -0.005, 0.002), (0.045, 0.005, 0.0105))
HANDLE = [
    (-0.100, 0.0000, 0.006, 0.0026, 0.0004),
    (-0.096, 0.0000, 0.010, 0.0030, 0.0006),
    (-0.070, 0.0012, 0.0095, 0.0032, 0.0005),
    (-0.020, 0.0050, 0.0052, 0.0036, 0.0002),
    (0.015, 0.0078, 0.0034, 0.0038, 0.0),
    (0.032, 0.0070, 0.0040, 0.0034, 0.0002),
]
ROOT = [
    (0.042, 0.0030, 0.0105, 0.0026, 0.0008),
    (0.052, 0.0006, 0.0125, 0.0024, 0.0006),
    (0.060, 0.0, 0.0125, 0.0024, 0.0002),
]
TINE = [
    (0.057, 0.0001, 0.0021, 0.0023, 0.0),
    (0.075, 0.0008, 0.0019, 0.0021, 0.0),
    (0.098, 0.0042, 0.0010, 0.0014, 0.0),
]
FORK = Part(
    "fork", crisp.together(strip(HANDLE + ROOT), *(strip(TINE, y) for y in (-0.0102, -0.0034, 0.0034, 0.0102))),
    look="silver", density=7850,
    make={"hulls": [TAIL, NECK, slab((0.044, -0.0125, 0.0), (0.098, 0.0125, 0.0045))], "triangles": 4000},
)  # fmt: skip

BOWL = [
    (0.040, 0.0048, 0.008, 0.0024, 0.0010),
    (0.048, 0.0018, 0.015, 0.0020, 0.0036),
    (0.060, 0.0002, 0.0205, 0.0018, 0.0062),
    (0.074, 0.0, 0.0215, 0.0018, 0.0066),
    (0.088, 0.0008, 0.0175, 0.0018, 0.0056),
    (0.098, 0.0034, 0.009, 0.0018, 0.0030),
    (0.101, 0.0050, 0.003, 0.0018, 0.0010),
]
SPOON = Part(
    "spoon", strip(HANDLE + BOWL), look="silver", density=7850,
    make={"hulls": [TAIL, NECK, slab((0.050, -0.0175, 0.0), (0.094, 0.0175, 0.008))], "triangles": 4000},
)  # fmt: skip

GRIP = crisp.slab(
    [(-0.112, -0.007), (-0.106, -0.0105), (-0.060, -0.0085), (0.000, -0.0065), (0.000, 0.0065), (-0.060, 0.0085),
     (-0.106, 0.0105), (-0.112, 0.007)], 0.0062, bevel=0.0022, smooth=False,
)  # fmt: skip
BLADE = crisp.slab(
    [(-0.004, -0.0055), (0.010, -0.0090), (0.085, -0.0105), (0.106, -0.0075), (0.116, 0.004), (0.114, 0.0078),
     (0.100, 0.0088), (0.010, 0.0075), (-0.004, 0.0055)], 0.0022, bevel=0.0006, smooth=False,
)  # fmt: skip
KNIFE = Part(
    "knife", GRIP | BLADE, look="silver", density=7850,
    make={"hulls": [slab((-0.111, -0.0085, 0.0), (0.0, 0.0085, 0.0062)), slab((0.0, -0.009, 0.0), (0.113, 0.008, 0.0022))],
          "triangles": 4000},
)  # fmt: skip

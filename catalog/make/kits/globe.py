"""A globe on a stand, turning on its tilted axis."""

import math

import numpy as np

from worldkit.joints import Hinge
from worldkit.sculpt import brushes, crisp

from ..kit import Kit, part
from ..stands import disc_foot

R, Z, TILT = 0.125, 0.215, 23.4
AXIS = (0.0, math.sin(math.radians(TILT)), math.cos(math.radians(TILT)))
ARC = (
    crisp.turned([(R + 0.008, -0.006), (R + 0.014, -0.006), (R + 0.014, 0.006), (R + 0.008, 0.006)], 180)
    .rotate(-90)
    .rotate(90, "y")
    .rotate(90, "x")
)
LAND = {  # rough outlines: latitude and longitude of circles that make the continents, with their radius, degrees
    "north america": ((55, -105, 22), (42, -98, 17), (63, -140, 11), (68, -100, 16), (50, -75, 11), (25, -102, 8), (16, -92, 5), (73, -42, 11), (64, -45, 6)),
    "south america": ((-5, -60, 15), (-15, -55, 14), (-28, -60, 10), (-40, -67, 6), (-50, -71, 4), (4, -70, 8)),
    "africa": ((15, 0, 15), (18, 20, 16), (5, 25, 14), (-10, 25, 13), (-24, 24, 10), (8, 43, 6), (-19, 47, 4), (28, 5, 9)),
    "europe": ((50, 15, 12), (40, -4, 5), (62, 15, 8), (55, 35, 14), (43, 12, 4), (53, -2, 4), (65, 27, 7)),
    "asia": ((60, 60, 16), (62, 90, 18), (65, 120, 16), (65, 150, 12), (48, 100, 18), (35, 105, 14), (23, 78, 9), (13, 78, 5), (30, 55, 9), (24, 45, 9), (20, 102, 8), (38, 127, 4), (37, 138, 4), (0, 102, 4), (0, 114, 6), (-5, 141, 5)),
    "australia": ((-24, 125, 9), (-25, 137, 11), (-28, 147, 7), (-42, 172, 4)),
}  # fmt: skip


def paint(points, normals):
    """Sea, land, white poles, a grid."""
    up = np.array(AXIS)
    side, front = np.array([0.0, up[2], -up[1]]), np.array([1.0, 0.0, 0.0])
    away = (points - (0, 0, Z)) / R
    lat, lon = np.degrees(np.arcsin(np.clip(away @ up, -1, 1))), np.degrees(np.arctan2(away @ side, away @ front)) + 5.0
    rgb = brushes.plain(points, "#2f74b5")
    rough = 3.0 * brushes.noise(points, 0.02, seed=4)
    land = np.zeros(len(points), bool)
    for circles in LAND.values():
        for a, o, r in circles:
            dot = np.sin(np.radians(lat)) * math.sin(math.radians(a)) + np.cos(np.radians(lat)) * math.cos(
                math.radians(a)
            ) * np.cos(np.radians(lon - o))
            land |= np.degrees(np.arccos(np.clip(dot, -1, 1))) < r + rough
    rgb = brushes.over(rgb, "#6f9a4a", land)
    rgb = brushes.over(rgb, "#c9ac6a", land & (abs(abs(lat) - 24 + rough) < 8))
    grid = np.minimum(np.abs((lat + 15) % 30 - 15), np.abs((lon + 15) % 30 - 15) * np.cos(np.radians(lat))) < 0.35
    rgb = brushes.over(rgb, "#e9f0f5", 0.5 * grid)
    return brushes.over(rgb, "#f7fafc", (lat < -68 + rough) | (lat > 80 + rough)), 0.3


KIT = Kit(
    "household",
    "Globe of the Earth on a stand, turning on its tilted axis",
    "typical desk globe: 25 cm across, 36 cm high",
    "wood",
    (
        part(
            "stand",
            disc_foot(0.18, 0.016, 0.014, Z - R - 0.008)
            | ARC.rotate(-TILT, "x").translate(z=Z)
            | crisp.wire(
                [(0, -AXIS[1] * 0.136, Z - AXIS[2] * 0.136), (0, AXIS[1] * 0.136, Z + AXIS[2] * 0.136)],
                0.005,
                smooth=False,
            ),
            "brass",
        ),
        part(
            "earth",
            crisp.ball(2 * R).translate(z=Z),
            "plastic",
            "stand",
            Hinge("axis", (0, 0, Z), AXIS, damping=2e-4, frictionloss=5e-4),
            paint=paint,
            hulls="convex",
            density=90.0,
            texels=512,
        ),
    ),
)

"""A toy duck of painted wood, 0.31 m long, looking along +x: a drake, its paint rubbed where hands hold it."""

import numpy as np

from worldkit import sculpt
from worldkit.sculpt import brushes

# Three masses flow into each other; the tail curls up, the head looks a little aside.
BREAST = sculpt.union(
    sculpt.ellipsoid((0.225, 0.145, 0.125)).rotate(4, "y").translate(-0.015, 0, 0.075),
    sculpt.ellipsoid((0.11, 0.115, 0.115)).translate(0.055, 0, 0.085),
    sculpt.round_cone((-0.09, 0, 0.085), (-0.150, 0, 0.128), 0.075, 0.016),
    radius=0.04,
)
NECK = sculpt.tube([(0.055, 0, 0.105), (0.082, 0, 0.150), (0.088, 0.003, 0.182)], [0.080, 0.054, 0.056])
HEAD = sculpt.union(
    sculpt.ellipsoid((0.092, 0.076, 0.078)).translate(0.100, 0.003, 0.192),
    sculpt.ellipsoid((0.05, 0.062, 0.046)).translate(0.117, 0.005, 0.178),
    radius=0.02,
)
BEAK = sculpt.union(
    sculpt.ellipsoid((0.054, 0.040, 0.018)).rotate(8, "y").translate(0.150, 0.008, 0.181),
    sculpt.ellipsoid((0.040, 0.030, 0.012)).rotate(14, "y").translate(0.144, 0.007, 0.170),
    radius=0.003,
)
WING = sculpt.union(
    sculpt.ellipsoid((0.135, 0.034, 0.078)).rotate(10, "y").translate(-0.018, 0.061, 0.088),
    sculpt.round_cone((-0.06, 0.062, 0.096), (-0.118, 0.050, 0.114), 0.034, 0.010),
    radius=0.012,
).mirror("y")
EYES = sculpt.sphere(0.015).translate(0.119, 0.0335, 0.203) | sculpt.sphere(0.015).translate(0.121, -0.0275, 0.203)
WOOD = sculpt.union(BREAST, NECK, HEAD, radius=0.022).blend(WING, radius=0.005).blend(BEAK, radius=0.004)
SHAPE = (sculpt.rough(WOOD, height=0.0004, grain=0.02, seed=4) | EYES) - sculpt.half_space((0, 0, 1), 0.016)


def paint(points, normals):
    """Grey flanks, brown breast, white ring, green head, yellow beak; wood shows where it is rubbed."""
    x, _, z = points.T
    rgb = np.tile(brushes.colour("#b9b2a4"), (len(points), 1))
    rgb = brushes.over(rgb, "#5b3524", brushes.step(x + 0.35 * z, 0.078, 0.012) * brushes.step(-z, -0.150, 0.006))
    rgb = brushes.over(rgb, "#35302c", brushes.step(-x, 0.098, 0.014))
    wing = brushes.within(WING.grow(0.001), 0.004)(points)
    rgb = brushes.over(rgb, "#8b7a66", wing)
    rgb = brushes.over(rgb, "#23478a", wing * brushes.step(-x, 0.030, 0.004) * brushes.step(x, -0.068, 0.004))
    rgb = brushes.over(rgb, "#efe9da", brushes.step(z + 0.25 * x, 0.163, 0.003))
    rgb = brushes.over(rgb, "#174f38", brushes.step(z + 0.25 * x, 0.172, 0.003))
    rgb = brushes.over(rgb, "#d9a227", brushes.within(BEAK.grow(0.0015), 0.003)(points))
    grain = brushes.mottled(points * (1, 6, 6), 0.03, seed=2)
    rubbed = brushes.step(brushes.mottled(points, 0.012, seed=5), 0.70, 0.05) * brushes.step(normals[:, 2], 0.35, 0.5)
    wood = brushes.over(np.tile(brushes.colour("#c79a62"), (len(points), 1)), "#9c6f42", 0.6 * grain)
    rgb = rgb * (1 - 0.75 * rubbed[:, None]) + wood * 0.75 * rubbed[:, None]
    eye = brushes.within(EYES.grow(0.0008), 0.001)(points)
    return brushes.over(rgb, "#0d0b0a", eye), 0.42 - 0.32 * eye + 0.25 * rubbed


DUCK = sculpt.Part("duck", SHAPE, paint=paint, density=620.0, make={"cells": 72, "triangles": 9000, "texels": 512})

"""A brown hare, sitting, 0.54 m to the tips of its ears, looking along +x: one body of 3.6 kg, painted by position.

See it: `worldwright sculpt sheet skills/sculpting/references/hare.py`. In a world: `sculpt.add(spec, HARE, name="hare", pos=…,
mass=3.6, paint=paint, cells=110)`.
"""

import numpy as np

from worldkit import sculpt
from worldkit.sculpt import brushes

# The big masses first: haunches, back, chest, blended widely, so that no joint shows.
haunches = sculpt.ellipsoid((0.25, 0.19, 0.22)).rotate(-14, "y").translate(-0.07, 0, 0.125)
chest = sculpt.round_cone((0.01, 0, 0.17), (0.075, 0, 0.255), 0.165, 0.115)
neck = sculpt.round_cone((0.075, 0, 0.26), (0.105, 0, 0.335), 0.10, 0.075)
trunk = sculpt.union(haunches, chest, neck, radius=0.09)

# A head is an egg, a muzzle and cheeks; long and narrow, held a little down.
skull = sculpt.ellipsoid((0.125, 0.082, 0.088)).translate(0.125, 0, 0.365)
muzzle = sculpt.round_cone((0.15, 0, 0.355), (0.196, 0, 0.337), 0.064, 0.040)
cheeks = sculpt.ellipsoid((0.055, 0.03, 0.046)).translate(0.155, 0.024, 0.343).mirror("y")
head = sculpt.union(skull, muzzle, cheeks, radius=0.025)

# Ears are thin and hollow in front, longer than the head, apart at their tips.
ear = sculpt.ellipsoid((0.026, 0.056, 0.200)).translate(0, 0, 0.088)
hollow = sculpt.ellipsoid((0.030, 0.040, 0.165)).translate(0.013, 0, 0.092)
ear = ear.carve(hollow, radius=0.006).rotate(-10, "x").rotate(-16, "y").translate(0.098, 0.022, 0.385)
hollow = hollow.rotate(-10, "x").rotate(-16, "y").translate(0.098, 0.022, 0.385)

# Limbs taper and bend. Thighs are flat discs on the flanks; hind feet are long.
thigh = sculpt.ellipsoid((0.170, 0.066, 0.150)).rotate(-25, "y").translate(-0.050, 0.088, 0.096)
hind_foot = sculpt.tube([(-0.085, 0.088, 0.024), (0.0, 0.092, 0.020), (0.072, 0.094, 0.018)], [0.046, 0.038, 0.036])
foreleg = sculpt.tube(
    [(0.050, 0.040, 0.205), (0.092, 0.046, 0.130), (0.098, 0.042, 0.065), (0.110, 0.042, 0.020)],
    [0.075, 0.046, 0.034, 0.034],
)
paw = sculpt.ellipsoid((0.062, 0.038, 0.032)).translate(0.124, 0.042, 0.016)
limbs = sculpt.union(thigh, hind_foot, foreleg, paw, radius=0.02).mirror("y")
tail = sculpt.rough(sculpt.ellipsoid((0.075, 0.055, 0.065)).translate(-0.200, 0, 0.085), 0.003, 0.012)

eye = sculpt.sphere(0.029).translate(0.143, 0.0315, 0.378).mirror("y")
lids = sculpt.torus(0.036, 0.007).rotate(90, "x").rotate(-18, "z").translate(0.143, 0.0370, 0.378).mirror("y")
fur = sculpt.union(trunk, head, radius=0.03)
fur = sculpt.union(fur, limbs, ear.mirror("y"), tail, radius=0.012)
fur = sculpt.rough(fur.blend(lids, 0.006), height=0.0012, grain=0.012, seed=7)
HARE = (fur | eye) - sculpt.half_space((0, 0, 1), 0.002)  # it sits flat


def paint(points, normals):
    """Agouti brown, paler below, dark along the back; black ear tips, pink in the ears; shining eyes."""
    x, y, z = points.T
    patch = brushes.mottled(points, 0.035, seed=1)[:, None]
    rgb = (1 - patch) * brushes.colour("#7d5636") + patch * brushes.colour("#a87d4f")
    ticks = brushes.mottled(points * (1, 1, 2.5), 0.006, seed=2)
    rgb = brushes.over(rgb, "#4a3322", 0.55 * brushes.step(ticks, 0.62, 0.2))
    rgb = brushes.over(rgb, "#5f3f28", 0.5 * brushes.step(normals[:, 2], 0.6, 0.7) * (z < 0.33))
    rgb = brushes.over(rgb, "#efe4d0", 0.9 * brushes.step(-normals[:, 2], 0.25, 0.6) * (z > 0.03) * (z < 0.36))
    rgb = brushes.over(
        rgb,
        "#e9dcc4",
        0.85 * brushes.step(x + 0.6 * z, 0.205, 0.05) * brushes.step(-z, -0.235, 0.05) * (np.abs(y) < 0.035),
    )
    rgb = brushes.over(rgb, "#f2eadb", brushes.within(tail.grow(0.004), 0.01)(points))
    inside = brushes.within(hollow.mirror("y").grow(0.002), 0.004)(points) * brushes.step(normals[:, 0], 0.0, 0.6)
    rgb = brushes.over(rgb, "#d8a391", 0.9 * inside)
    rgb = brushes.over(rgb, "#1d1612", brushes.step(z, 0.535, 0.02))
    nose = sculpt.ellipsoid((0.016, 0.022, 0.014)).translate(0.214, 0, 0.343)
    rgb = brushes.over(rgb, "#a8695c", brushes.within(nose, 0.003)(points))
    mouth = np.abs(z - 0.327 - 0.25 * np.abs(y)) + 10 * (x < 0.185)
    rgb = brushes.over(rgb, "#3a261b", 0.8 * (1 - brushes.step(mouth, 0.0018, 0.0015)))
    rim = brushes.within(eye.grow(0.005), 0.003)(points)
    rgb = brushes.over(rgb, "#cdb48e", 0.6 * rim)
    pupil = brushes.within(eye.grow(0.0006), 0.0006)(points)
    rgb = brushes.over(rgb, "#120b08", pupil)
    return rgb, np.where(pupil > 0.5, 0.1, 0.9)


FIGURE = sculpt.Part("hare", HARE, paint=paint, mass=3.6, make={"cells": 110, "triangles": 20_000, "texels": 1024})

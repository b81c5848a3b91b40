"""A shape bent, twisted or roughened (about the distance: fine within a few cells of the surface)."""

import math

import numpy as np

from .signatures import signature
from .signed import Array, Shape, boxed


def bend(shape: Shape, deg: float) -> Shape:
    """A shape that is long in z, bent about y: its lower end stays, its upper end turns by `deg` towards +x."""
    angle = math.radians(deg)
    if not 1e-6 < abs(angle) < 2 * math.pi:
        raise ValueError(f"bend: an angle of {deg} degrees; give one within a turn, not 0")
    z0, length = float(shape.low[2]), float(shape.size[2])
    radius, way = length / abs(angle), math.copysign(1.0, angle)
    if radius <= max(-shape.low[0], shape.high[0]):
        raise ValueError(f"bend: {deg} degrees fold it into itself: it is too thick for its length")
    end = abs(angle)

    def back(p: Array) -> tuple[Array, Array]:
        x, z = way * p[:, 0], p[:, 2] - z0
        turned = np.arctan2(z, radius - x)
        turned = np.where(turned < -(2 * np.pi - end) / 2, turned + 2 * np.pi, turned)
        r = np.hypot(radius - x, z)
        cx, cz = x - radius, z
        beyond_x = radius + cx * math.cos(end) - cz * math.sin(end)
        beyond_z = length + cz * math.cos(end) + cx * math.sin(end)
        first, last = turned < 0, turned > end
        source_x = np.where(first, x, np.where(last, beyond_x, radius - r))
        source_z = np.where(first, z, np.where(last, beyond_z, radius * turned))
        q = np.column_stack([way * source_x, p[:, 1], z0 + source_z])
        return q, np.where(first | last, 1.0, np.minimum(r / radius, 1.0))

    def measure(p: Array) -> Array:
        q, slack = back(p)
        return shape.measure(q) * np.maximum(slack, 0.1)

    lattice = np.stack(np.meshgrid(*(np.linspace(shape.low[k], shape.high[k], 17) for k in range(3))), -1).reshape(
        -1, 3
    )
    theta = (lattice[:, 2] - z0) / radius
    r = radius - way * lattice[:, 0]
    low, high = boxed(np.column_stack([way * (radius - r * np.cos(theta)), lattice[:, 1], z0 + r * np.sin(theta)]))
    pad = 0.01 * float((high - low).max())
    return Shape(measure, low - pad, high + pad, signature("bend", shape, deg))


def twist(shape: Shape, deg: float) -> Shape:
    """A shape twisted about z: its lower end stays, its upper end turns by `deg`."""
    rate = math.radians(deg) / float(shape.size[2])
    reach = float(np.hypot(*np.maximum(np.abs(shape.low[:2]), np.abs(shape.high[:2]))))
    slack = 1.0 / math.hypot(1.0, rate * reach)

    def measure(p: Array) -> Array:
        angle = -rate * (np.clip(p[:, 2], shape.low[2], shape.high[2]) - shape.low[2])
        cos, sin = np.cos(angle), np.sin(angle)
        q = np.column_stack([cos * p[:, 0] - sin * p[:, 1], sin * p[:, 0] + cos * p[:, 1], p[:, 2]])
        return shape.measure(q) * slack

    low, high = np.array([-reach, -reach, shape.low[2]]), np.array([reach, reach, shape.high[2]])
    return Shape(measure, low, high, signature("twist", shape, deg))


def rough(shape: Shape, height: float, grain: float, seed: int = 0, octaves: int = 3) -> Shape:
    """A shape with noise: bumps up to `height` (m) out and in, the largest about `grain` (m) across; one seed, one shape."""
    if not (height > 0 and grain > 0):
        raise ValueError("rough: height and grain are positive metres")
    slack = 1.0 / (1.0 + 1.5 * height / grain)

    def measure(p: Array) -> Array:
        found = shape.measure(p)
        near = np.abs(found) < 4 * height + grain
        found[near] += height * noise(p[near], grain, seed, octaves)
        return found * slack

    return Shape(
        measure, shape.low - height, shape.high + height, signature("rough", shape, height, grain, seed, octaves)
    )


def noise(points: Array, grain: float, seed: int = 0, octaves: int = 3) -> Array:
    """Smooth noise (N,) between about -1 and 1 at points (N, 3), m; the same on every machine.

    Source: K. Perlin, "Improving noise" (2002), gradients from an integer hash.
    """
    total, weight = np.zeros(len(points)), 0.0
    for octave in range(octaves):
        share = 0.5**octave
        total += share * _gradient_noise(np.asarray(points, dtype=float) / (grain * share), seed + 101 * octave)
        weight += share
    return np.asarray(np.clip(1.6 * total / weight, -1.0, 1.0))


def _gradient_noise(q: Array, seed: int) -> Array:
    cell = np.floor(q)
    f = q - cell
    corner = cell.astype(np.int64).astype(np.uint32)
    fade = f * f * f * (f * (f * 6 - 15) + 10)
    found = np.zeros(len(q))
    with np.errstate(over="ignore"):
        for k in range(8):
            bit = np.array([k & 1, k >> 1 & 1, k >> 2 & 1])
            at = corner + bit.astype(np.uint32)
            h = at[:, 0] * np.uint32(0x8DA6B343) ^ at[:, 1] * np.uint32(0xD8163841) ^ at[:, 2] * np.uint32(0xCB1AB31F)
            h = (h + np.uint32(seed & 0xFFFFFFFF)) * np.uint32(0x9E3779B1)
            h = (h ^ h >> np.uint32(15)) * np.uint32(0x85EBCA77)
            h ^= h >> np.uint32(13)
            away = f - bit
            tilt = [((h >> np.uint32(8 * i)) & np.uint32(255)).astype(float) / 127.5 - 1.0 for i in range(3)]
            lean = tilt[0] * away[:, 0] + tilt[1] * away[:, 1] + tilt[2] * away[:, 2]
            weight = np.where(bit, fade, 1 - fade)
            found += lean * weight[:, 0] * weight[:, 1] * weight[:, 2]
    return found

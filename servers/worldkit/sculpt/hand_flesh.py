"""The flesh on the bones of a hand: one distance function for a pose, with knuckles, webs, creases, tendons and the pads of the palm.

Each finger is a part of its own that flows into the palm at its root only, so that a fist keeps its clefts.
"""

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np

from .hand_bones import BONES, KNUCKLES, THICK, THUMB_BONES, THUMB_THICK, Bones, Pose, posed
from .signatures import signature
from .signed import Array, Shape, smallest

Frame = tuple[Array, Array]
MM = 1e-3
FAR = 0.02
"""Further away than this a part is told by the ball around it, m."""


class Flesh:
    """Cones and ellipsoids that flow into each other, in frames of their own."""

    def __init__(self) -> None:
        self.pieces: list[tuple[str, Array, Array, tuple[Any, ...], float]] = []
        self.creases: list[tuple[Array, Array, float, float, float]] = []
        self.balls: list[tuple[Array, float]] = []

    def cone(self, frame: Frame, a: Any, b: Any, r1: float, r2: float, blend: float, squash: float = 1.0) -> None:
        """A round cone between two points of a frame, its thickness out of the back `squash` times its width."""
        at, turned = frame
        p, q = np.array(a, dtype=float), np.array(b, dtype=float)
        self.pieces.append(("cone", at, turned, (p, q, r1, r2, squash), blend))
        middle = at + turned @ (p + q) / 2
        self.balls.append((middle, float(np.linalg.norm(q - p)) / 2 + max(r1, r2) * max(squash, 1.0)))

    def lump(self, frame: Frame, at: Any, half: Any, blend: float) -> None:
        """An ellipsoid by its middle and half extents in a frame."""
        place, turned = frame
        self.pieces.append(("lump", place, turned, (np.array(at, dtype=float), np.array(half, dtype=float)), blend))
        self.balls.append((place + turned @ np.array(at, dtype=float), float(max(half))))

    def crease(self, frame: Frame, x: float, deep: float, wide: float, side: float) -> None:
        """A fold across a frame at x, on its palm side (-1) or back (1)."""
        self.creases.append((frame[0] + frame[1][:, 0] * x, frame[1], deep, wide, side))

    def ball(self) -> tuple[Array, float]:
        """Middle and radius of a ball that holds all of it."""
        middles = np.array([middle for middle, _ in self.balls])
        middle = (middles.min(axis=0) + middles.max(axis=0)) / 2
        return middle, max(float(np.linalg.norm(m - middle)) + r for m, r in self.balls)

    def measure(self, points: Array) -> Array:
        """(N,) m."""
        found: Array | None = None
        for kind, at, turned, numbers, blend in self.pieces:
            local = (points - at) @ turned
            one = _cone(local, *numbers) if kind == "cone" else _lump(local, *numbers)
            found = one if found is None else smallest(found, one, blend)
        assert found is not None
        for at, turned, deep, wide, side in self.creases:
            local = (points - at) @ turned
            on = np.clip(side * local[:, 2] / (3 * MM) - 0.2, 0.0, 1.0) * (np.abs(local[:, 1]) < 0.02)
            found = found + deep * on * np.exp(-((local[:, 0] / wide) ** 2)) * (np.abs(local[:, 2]) < 0.018)
        return found


def _cone(p: Array, a: Array, b: Array, r1: float, r2: float, squash: float) -> Array:
    """About the distance to a round cone, flattened along z: nearest on its middle line, as a rod whose radius changes."""
    flat = np.array([1.0, 1.0, 1.0 / squash])
    q, way = (p - a) * flat, (b - a) * flat
    t = np.clip(q @ way / max(float(way @ way), 1e-18), 0.0, 1.0)
    away = q - t[:, None] * way
    return np.asarray((np.sqrt(np.einsum("ij,ij->i", away, away)) - (r1 + t * (r2 - r1))) * min(squash, 1.0))


def _lump(p: Array, at: Array, half: Array) -> Array:
    scaled = (p - at) / half
    k0 = np.sqrt(np.einsum("ij,ij->i", scaled, scaled))
    k1 = np.sqrt(np.einsum("ij,ij->i", scaled / half, scaled / half))
    return np.asarray(np.where(k1 > 1e-9, k0 * (k0 - 1.0) / np.maximum(k1, 1e-9), -half.min()))


def digit(chain: Sequence[Frame], bones: Array, thick: Array, s: float, root: int = 0) -> Flesh:
    """One finger, or the thumb, whose three pieces begin at the frames of `chain`; from the piece `root` on."""
    part = Flesh()
    r = thick * s
    for k in range(root, 3):
        long = float(bones[k]) * s
        end = long if k < 2 else long - r[3] * 1.02
        part.cone(
            chain[k],
            (0, 0, 0.2 * MM * s),
            (end, 0, (0.2 if k < 2 else -0.8) * MM * s),
            0.95 * r[k],
            (0.90 if k < 2 else 0.95) * r[k + 1],
            4 * MM * s,
            0.9,
        )
        if k < 2:  # the pad between two joints, on the palm's side
            part.lump(chain[k], (0.50 * long, 0, -0.34 * r[k]), (0.44 * long, 0.93 * r[k], 0.68 * r[k]), 5 * MM * s)
    for k in range(root + 1, 3):  # knuckles: wider, and they stand out of the back
        bent = (chain[k][0], _between(chain[k - 1][1], chain[k][1]))
        part.lump(bent, (-0.5 * MM * s, 0, 0.10 * r[k]), (1.0 * r[k], 0.92 * r[k], 0.80 * r[k]), 5 * MM * s)
        part.crease(bent, 0.0, 0.55 * MM * s, 0.9 * MM * s, -1.0)
        if k == 1:
            for x in (-2.6, 0.0, 2.6):
                part.crease(bent, x * MM * s, 0.22 * MM * s, 0.7 * MM * s, 1.0)
        else:
            part.crease(bent, -0.8 * MM * s, 0.18 * MM * s, 0.7 * MM * s, 1.0)
    long = float(bones[2]) * s
    part.lump(chain[2], (0.56 * long, 0, -0.30 * r[3]), (0.42 * long, 0.93 * r[3], 0.80 * r[3]), 4 * MM * s)  # the pulp
    return part


def palm(bones: Bones, stub: float = 0.42) -> Flesh:
    """The palm with the roots of the fingers, so long a share of their first pieces, and of the thumb; the wrist."""
    s = bones.scale
    mm = MM * s
    hand: Frame = (np.zeros(3), np.eye(3))
    part = Flesh()
    carpus = [(8, 13, -1), (7, 4, 1), (7, -6, 0.5), (8, -15, -2.5)]
    for k in range(4):
        x, y, z = KNUCKLES[k] / MM
        cx, cy, cz = carpus[k]
        part.cone(
            hand,
            np.array((cx, cy, cz)) * mm,
            np.array((x - 3, y, z - 2.5)) * mm,
            14.2 * mm,
            (11.2, 11.4, 10.8, 9.8)[k] * mm,
            13 * mm,
            0.92,
        )
    # Muscles: the ball of the thumb, the little finger's side, the pads under the knuckles.
    thumb = bones.thumb[0]
    far = float(THUMB_BONES[0]) * s
    part.cone(thumb, (-3 * mm, 0, 0), (far, 0, 0), 14.0 * mm, 11.2 * mm, 12 * mm, 0.95)
    part.lump(thumb, (0.40 * far, 5 * mm, -6.0 * mm), (25 * mm, 13.5 * mm, 11.5 * mm), 12 * mm)
    part.cone(hand, (14 * mm, -20 * mm, -7 * mm), (60 * mm, -33 * mm, -6.5 * mm), 13.0 * mm, 10.5 * mm, 12 * mm)
    part.lump(hand, (79 * mm, 16 * mm, -7.5 * mm), (11 * mm, 14 * mm, 7.5 * mm), 8 * mm)
    part.lump(hand, (77 * mm, -6 * mm, -7.0 * mm), (11 * mm, 14 * mm, 7.5 * mm), 8 * mm)
    part.lump(hand, (70 * mm, -26 * mm, -8.0 * mm), (11 * mm, 13 * mm, 7.5 * mm), 8 * mm)
    # The web between thumb and index, and the muscle that bulges there.
    root, tip = thumb[0] + thumb[1][:, 0] * 0.62 * far, KNUCKLES[0] * s
    part.cone(
        hand,
        tip * 0.72 + (0, 3 * mm, -2 * mm),
        0.5 * (root + 0.66 * tip) + (0, 1 * mm, -2 * mm),
        8.5 * mm,
        9.0 * mm,
        13 * mm,
        0.9,
    )
    part.cone(hand, root, 0.5 * (root + 0.74 * tip), 8.0 * mm, 7.0 * mm, 13 * mm, 0.9)
    # Roots of the fingers, which carry the webs; knuckles and tendons on the back.
    for k, chain in enumerate(bones.fingers):
        r, long = THICK[k] * s, float(BONES[k, 0]) * s
        part.cone(
            chain[0], (0, 0, -0.6 * mm), (stub * long, 0, 0), 1.0 * r[0], (1.0 - 0.17 * stub) * r[0], 6.5 * mm, 0.9
        )
        bent = (chain[0][0], _between(np.eye(3), chain[0][1]))
        part.lump(bent, (-1.0 * mm, 0, 3.2 * mm), (8.5 * mm, 7.6 * mm, 7.6 * mm), 5 * mm)
    for k, chain in enumerate(bones.fingers):
        top = chain[0][0] + np.array((-6, 0, 9.4)) * mm
        heel = np.array([(16, 5, 11.6), (14, 2, 12.2), (14, -3, 12.0), (16, -8, 10.2)][k]) * mm
        part.cone(hand, heel - (0, 0, 1.0 * mm), top - (0, 0, 0.7 * mm), 1.2 * mm, 1.9 * mm, 5.5 * mm)
    return part


def arm(bones: Bones, long: float) -> Flesh:
    """The wrist and so much of the forearm, m."""
    s = bones.scale
    mm = MM * s
    fore = bones.forearm
    part = Flesh()
    part.cone(fore, (-4 * mm, 0, -1 * mm), (-45 * mm, 0, -1 * mm), 26.5 * mm, 28.5 * mm, 1 * mm, 0.70)
    part.cone(
        fore,
        (-45 * mm, 0, -1 * mm),
        (-max(long, 0.05), 0, -2 * mm),
        28.5 * mm,
        28.5 * mm + 0.10 * max(long - 45 * mm, 0.0),
        10 * mm,
        0.74,
    )
    part.lump(fore, (-13 * mm, -19 * mm, 10 * mm), (11 * mm, 8 * mm, 8.5 * mm), 7 * mm)  # the head of the ulna
    for y in (-4.5, 4.5):
        part.cone(fore, (-4 * mm, y * mm, -16.5 * mm), (-60 * mm, y * mm, -20 * mm), 1.6 * mm, 1.8 * mm, 5 * mm)
    part.crease(fore, 1.5 * mm, 0.5 * mm, 1.2 * mm, -1.0)
    part.crease(fore, -4.5 * mm, 0.4 * mm, 1.1 * mm, -1.0)
    return part


def _between(one: Array, other: Array) -> Array:
    """The frame halfway between two that share, about, their y."""
    x = one[:, 0] + other[:, 0]
    if np.linalg.norm(x) < 1e-6:
        return other
    x = x / np.linalg.norm(x)
    z = one[:, 2] + other[:, 2]
    z = z - (z @ x) * x
    z = z / np.linalg.norm(z)
    return np.stack([x, np.cross(z, x), z], axis=1)


def shape_of(part: Flesh, recipe: str) -> Shape:
    """A part as a shape by itself."""
    low = np.min([middle - r for middle, r in part.balls], axis=0) - 2 * MM
    high = np.max([middle + r for middle, r in part.balls], axis=0) + 2 * MM
    return Shape(part.measure, low, high, recipe)


PALM_LINES = (
    [(84, 38), (78, 20), (73, 2), (70, -12)],
    [(62, -44), (68, -26), (75, -10), (83, 8), (91, 14)],
    [(82, 37), (66, 22), (48, 8), (28, 2), (12, 1)],
)
"""The three great folds of the palm, mm from the wrist, in its plane."""


def flesh(pose: Pose, length: float, forearm: float) -> Shape:
    """A right hand in a pose, in its own frame; see `hand_bones`.

    Args:
        pose: its angles.
        length: from the wrist to the tip of the middle finger, m.
        forearm: how much of it is there, m.
    """
    bones = posed(pose, length)
    s = bones.scale
    digits = [digit(bones.fingers[k], BONES[k], THICK[k], s) for k in range(4)]
    digits.append(digit(bones.thumb, THUMB_BONES, THUMB_THICK, s))
    whole, below = palm(bones), arm(bones, forearm)
    balls = [part.ball() for part in (*digits, whole, below)]
    low = np.min([m - r for part in (*digits, whole, below) for m, r in part.balls], axis=0) - 2 * MM
    high = np.max([m + r for part in (*digits, whole, below) for m, r in part.balls], axis=0) + 2 * MM
    lines = [np.array(line, dtype=float) * MM * s for line in PALM_LINES]

    def near(part: Flesh, ball: tuple[Array, float], points: Array) -> Array:
        middle, radius = ball
        away = np.linalg.norm(points - middle, axis=1) - radius
        some = away < FAR
        found = np.maximum(away, FAR)
        if some.any():
            found[some] = part.measure(points[some])
        return found

    def measure(points: Array) -> Array:
        found = smallest(near(whole, balls[5], points), near(below, balls[6], points), 16 * MM * s)
        for line in lines:
            on = (points[:, 2] < -4 * MM * s) & (found < 4 * MM)
            if on.any():
                away = from_line(points[on, :2], line)
                found[on] += 0.55 * MM * s * np.exp(-((away / (1.1 * MM * s)) ** 2))
        for k, part in enumerate(digits):
            found = smallest(found, near(part, balls[k], points), (1.5 if k < 4 else 5.0) * MM * s)
        return found

    recipe = signature("hand", pose.numbers(), length, forearm)
    return Shape(measure, low, high, recipe)


def from_line(points: Array, line: Array) -> Array:
    """Distances (N,) of points (N, 2) from a bent line (M, 2)."""
    found = np.full(len(points), np.inf)
    for a, b in itertools.pairwise(line):
        t = np.clip((points - a) @ (b - a) / float((b - a) @ (b - a)), 0, 1)
        found = np.minimum(found, np.linalg.norm(points - a - t[:, None] * (b - a), axis=1))
    return found

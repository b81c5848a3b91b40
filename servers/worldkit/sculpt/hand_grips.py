"""Poses by what a hand does: fingers close until their flesh touches the thing that they hold, and no further.

A finger is told by points of its own surface; each of its joints bends until they meet the round thing or the palm. The thumb, and what
two or three fingers hold between their tips, is found by least squares from a pose that people take.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from .hand_bones import (
    BONES,
    FINGER_LIMITS,
    KNUCKLES,
    LENGTH,
    THICK,
    THUMB_BONES,
    THUMB_LIMITS,
    THUMB_THICK,
    Bones,
    Pose,
    posed,
    turn,
)
from .hand_flesh import digit, palm
from .signed import Array

POSES = ("open", "relaxed", "flat", "grip", "pinch", "hold_rod", "fist", "point")
SIZED = {"grip": (0.006, 0.08), "pinch": (0.001, 0.05), "hold_rod": (0.003, 0.02)}
"""The poses that hold something, with the least and the most it may measure, m."""
STILL = {
    "open": Pose(((2, 2, 4, 3), (0, 3, 5, 3), (-1, 4, 6, 4), (-3, 5, 7, 4)), (44, 14, 0, 2, 2)),
    "relaxed": Pose(((0, 16, 24, 12), (0, 22, 29, 15), (0, 27, 33, 16), (0, 30, 34, 16)), (30, 28, 10, 12, 15)),
    "flat": Pose(((1, 0, 1, 1), (0, 0, 1, 1), (0, 0, 1, 1), (-1, 0, 1, 1)), (24, -2, -28, 4, 2)),
    "fist": Pose(((-1, 80, 100, 62), (0, 84, 103, 62), (1, 86, 102, 60), (3, 86, 98, 58)), (14, 46, 34, 38, 52)),
    "point": Pose(((0, 4, 6, 4), (0, 76, 98, 56), (1, 82, 100, 58), (3, 84, 98, 58)), (16, 44, 34, 34, 48)),
}
"""In each the wrist is straight. The thumb of `flat` lies in the palm's plane."""
AXIS = np.array([0.18, 0.98, 0.0]) / np.linalg.norm([0.18, 0.98, 0.0])
"""A bar lies across the palm as the knuckles do."""
PALM_Z = -15.5e-3
"""Where fingers meet the palm, m."""


@dataclass(frozen=True)
class Hold:
    """A pose, and the thing that it is around, in the frame of a right hand."""

    pose: Pose
    point: Array
    """(3,) m: the middle of what is held; where nothing is, of the palm's skin."""
    axis: Array
    """(3,): along a bar that is held; across the palm, towards the thumb, where nothing is."""
    into: Array
    """(3,): from the held thing into the hand, at right angles to `axis`."""


def hold(name: str, size: float, length: float = LENGTH) -> Hold:
    """A pose by its name, around a thing of a size, m: its diameter, or how thick it is between two fingers.

    Raises:
        ValueError: there is no such pose, or the hand cannot hold what is so thick.
    """
    if name not in POSES:
        raise ValueError(f"hand: there is no pose {name!r}; take one of: {', '.join(POSES)}")
    scale = length / LENGTH
    if name in SIZED:
        low, high = (round(scale * v, 4) for v in SIZED[name])
        if not low <= size <= high:
            raise ValueError(f"hand: {name} holds {low * 1e3:g} to {high * 1e3:g} mm, not {size * 1e3:g}")
        found = _sized(name, round(size / scale, 6))
    else:
        flat = np.array([48e-3, -3e-3, -14e-3])
        found = Hold(STILL[name], flat, np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0]))
    return Hold(found.pose, found.point * scale, found.axis, found.into)


@cache
def _sized(name: str, size: float) -> Hold:
    return {"grip": _grip, "pinch": _pinch, "hold_rod": _rod}[name](size)


# -- surfaces of the fingers -------------------------------------------------------------------------------------------


@cache
def skins() -> tuple[tuple[Array, ...], ...]:
    """Points (N, 3), m, of the skin of each piece of index, middle, ring, little finger and thumb, in that piece's frame."""
    found = []
    for k in range(5):
        bones, thick = (BONES[k], THICK[k]) if k < 4 else (THUMB_BONES, THUMB_THICK)
        starts = np.concatenate([[0.0], np.cumsum(bones)[:2]])
        part = digit([(np.array([x, 0.0, 0.0]), np.eye(3)) for x in starts], bones, thick, 1.0)
        pieces = []
        for start, long, last in zip(starts, bones, (False, False, True), strict=True):
            x, turn = np.meshgrid(
                np.linspace(0.12, 0.97 if last else 0.95, 9) * long, np.linspace(0, 2 * np.pi, 16, endpoint=False)
            )
            way = np.stack([0 * x, np.sin(turn), np.cos(turn)], axis=-1).reshape(-1, 3)
            at = np.stack([start + x, 0 * x, 0 * x], axis=-1).reshape(-1, 3)
            low, high = np.zeros(len(at)), np.full(len(at), 0.025)
            for _ in range(18):
                middle = (low + high) / 2
                inside = part.measure(at + middle[:, None] * way) < 0
                low, high = np.where(inside, middle, low), np.where(inside, high, middle)
            pieces.append(at + low[:, None] * way - (start, 0, 0))
        found.append(tuple(pieces))
    return tuple(found)


def _placed(bones: Bones, digit_number: int) -> list[Array]:
    """The skin of a digit's three pieces where they are."""
    chain = bones.thumb if digit_number == 4 else bones.fingers[digit_number]
    return [at + skin @ turned.T for skin, (at, turned) in zip(skins()[digit_number], chain, strict=True)]


def _from_rod(points: Array, along: Array, direction: Array, radius: float) -> Array:
    """Distances (...,) of points (..., 3) from a long round bar, m."""
    away = points - along
    away = away - (away @ direction)[..., None] * direction
    return np.asarray(np.linalg.norm(away, axis=-1) - radius)


def _from_segment(points: Array, a: Array, b: Array, ra: float, rb: float) -> Array:
    way = b - a
    t = np.clip((points - a) @ way / float(way @ way), 0, 1)
    away = points - a - t[..., None] * way
    return np.asarray(np.linalg.norm(away, axis=-1) - (ra + t * (rb - ra)))


def _from_palm(points: Array) -> Array:
    """About the distance of points from the palm, which fingers do not go through."""
    beyond = np.maximum(points[..., 0] - 84e-3, 0.0)
    ball = _from_segment(points, np.array([14e-3, -20e-3, -7e-3]), np.array([60e-3, -33e-3, -6.5e-3]), 13e-3, 10.5e-3)
    return np.minimum(np.hypot(PALM_Z - points[..., 2], beyond) * np.sign(PALM_Z - points[..., 2] + 1e-9), ball)


# -- a bar across the palm ---------------------------------------------------------------------------------------------


def _closed(finger: int, away: Callable[[Array], Array]) -> tuple[tuple[float, float, float, float], float]:
    """A finger closed around something: its angles, and how badly it lies: gaps and depths, mm, and bends that nobody likes.

    Of the ways to bend its root short of the thing, that is taken from which all three pieces come to lie best.
    """
    at, frame = posed(Pose()).fingers[finger][0]
    first, _ = _bends(finger, 0, at, frame, away)
    best: tuple[float, tuple[float, float, float, float]] | None = None
    for root in np.linspace(first, max(first - 45.0, FINGER_LIMITS[1, 0]), 8):
        angles, cost, here, turned = [0.0, float(root)], 0.0, at, frame @ turn(1, np.radians(root))
        cost += 0.4 * _lies(away(here + skins()[finger][0] @ turned.T))
        for piece in (1, 2):
            here = here + BONES[finger, piece - 1] * turned[:, 0]
            bend, _ = _bends(finger, piece, here, turned, away)
            turned = turned @ turn(1, np.radians(bend))
            angles.append(bend)
            cost += _lies(away(here + skins()[finger][piece] @ turned.T))
        cost += 0.03 * max(angles[3] - 0.8 * angles[2] - 5.0, 0.0) + 0.02 * max(angles[1] - 75.0, 0.0)
        if best is None or cost < best[0]:
            best = (cost, tuple(angles))  # type: ignore[assignment]
    assert best is not None
    return best[1], best[0]


def _lies(far: Array) -> float:
    """How badly a piece lies at distances of its points: the gap, mm, up to 6, and four times how deep it is in what it holds."""
    nearest = 1e3 * float(far.min())
    return min(nearest, 6.0) if nearest > 0 else -4.0 * nearest


def _bends(finger: int, piece: int, at: Array, frame: Array, away: Callable[[Array], Array]) -> tuple[float, float]:
    """How far a joint bends until its piece meets something, degrees, and how near it is then, m."""
    low, high = FINGER_LIMITS[piece + 1]
    tried = np.linspace(low if piece == 0 else 0.0, high, 48)
    c, s = np.cos(np.radians(tried)), np.sin(np.radians(tried))
    skin = skins()[finger][piece]
    x, z = np.outer(c, skin[:, 0]) + np.outer(s, skin[:, 2]), np.outer(c, skin[:, 2]) - np.outer(s, skin[:, 0])
    points = at + np.stack([x, np.broadcast_to(skin[:, 1], x.shape), z], axis=-1) @ frame.T
    found = away(points).min(axis=1)
    if piece:
        found = np.minimum(found, _from_palm(points).min(axis=1))
    met = np.flatnonzero(found <= 0)
    if not len(met):
        nearest = int(np.argmin(found)) if piece else len(tried) - 1
        return float(tried[nearest]), float(found[nearest])
    n = int(met[0])
    if n == 0:
        return float(tried[0]), float(found[0])
    share = found[n - 1] / (found[n - 1] - found[n])
    return float(tried[n - 1] + share * (tried[n] - tried[n - 1])), 0.0


def _grip(size: float) -> Hold:
    """Around a bar: it lies in the palm, or, if thin, in the bent fingers; where it lies best is looked for."""
    radius = size / 2
    whole = palm(posed(Pose(thumb=(40, 46, 20, 15, 15))))
    turns = np.linspace(0, 2 * np.pi, 28, endpoint=False)
    side = np.cross(AXIS, (0.0, 0.0, 1.0))
    rim = radius * (np.cos(turns)[:, None] * side + np.sin(turns)[:, None] * np.array([0.0, 0.0, 1.0]))
    bar = (rim[:, None] + np.linspace(-0.034, 0.032, 12)[None, :, None] * AXIS).reshape(-1, 3)
    best: tuple[float, Array, list[tuple[float, float, float, float]]] | None = None
    for x in np.linspace(0.068, 0.100, 5):
        low, high = -0.07 - radius, 0.0
        for _ in range(12):
            middle = (low + high) / 2
            low, high = (middle, high) if whole.measure(bar + np.array([x, 0, middle])).min() > 0 else (low, middle)
        for lift in (0.0, 0.010):
            at = np.array([x, 0.0, low - lift])
            fingers, cost = [], 60.0 * lift
            for k in range(4):
                angles, badly = _closed(k, lambda p, at=at: _from_rod(p, at, AXIS, radius))  # type: ignore[misc]
                fingers.append(angles)
                cost += badly
            if best is None or cost < best[0]:
                best = (cost, at, fingers)
    assert best is not None
    _, at, fingers = best
    pose = Pose(tuple(fingers))
    share = np.clip((size - 0.012) / 0.05, 0, 1)
    start = (1 - share) * np.array([18, 46, 34, 24, 30.0]) + share * np.array([38, 50, 24, 14, 26.0])
    thumb = _thumb(pose, start, lambda p: _from_rod(p, at, AXIS, radius))
    return Hold(Pose(pose.fingers, thumb), at, AXIS, _squared(np.array([-0.35, 0.0, 1.0]), AXIS))


def _thumb(pose: Pose, start: Array, away: Callable[[Array], Array]) -> tuple[float, float, float, float, float]:
    """The thumb laid against what is held, or over the fingers that are around it."""
    from scipy.optimize import least_squares

    bones = posed(pose)
    ends = []
    for k, chain in enumerate(bones.fingers):
        for n, (at, turned) in enumerate(chain):
            ends.append(
                (
                    at,
                    at + turned[:, 0] * (BONES[k, n] - (THICK[k, 3] if n == 2 else 0.0)),
                    0.93 * THICK[k, n],
                    0.93 * THICK[k, n + 1],
                )
            )

    def lacking(angles: Array) -> Array:
        skin = _placed(posed(Pose(pose.fingers, tuple(angles))), 4)
        points = np.concatenate(skin[1:])
        held = away(points)
        others = np.min([_from_segment(points, *end) for end in ends], axis=0)
        both = np.minimum(held, others)
        pads = both[len(skin[1]) :]
        deep = np.minimum(both, 0.0)
        nearest = float(np.minimum(pads.min(), 0.02))
        return np.concatenate([[300.0 * nearest], 700.0 * np.sort(deep)[:12], 0.008 * (angles - start)])

    low, high = THUMB_LIMITS.T
    found = least_squares(
        lacking, np.clip(start, low + 0.1, high - 0.1), bounds=(low, high), diff_step=2e-3, max_nfev=25, x_scale=10.0
    )
    return tuple(float(v) for v in found.x)  # type: ignore[return-value]


# -- between the tips --------------------------------------------------------------------------------------------------


def _pad(bones: Bones, digit_number: int, share: float = 0.56) -> tuple[Array, Array]:
    """The middle of a pulp (3,), m, and where it looks (3,)."""
    chain = bones.thumb if digit_number == 4 else bones.fingers[digit_number]
    at, turned = chain[2]
    skin = skins()[digit_number][2]
    long = THUMB_BONES[2] if digit_number == 4 else BONES[digit_number, 2]
    under = skin[np.argmin(np.linalg.norm(skin - (share * long, 0, -0.02), axis=1))]
    return at + turned @ np.array([share * long, 0.0, under[2]]), -turned[:, 2]


def _pinch(size: float) -> Hold:
    """Between the pulps of thumb and index; the other fingers stay half open."""
    from scipy.optimize import least_squares

    start = np.array([44.0, 48.0, 18.0, 30.0, 44.0, 32.0, 14.0, 18.0])

    def pose(numbers: Array) -> Pose:
        rest = ((-1, 34, 40, 20), (-2, 30, 36, 18), (-3, 26, 30, 16))
        return Pose(((0, *numbers[:3]), *rest), tuple(numbers[3:]))

    def lacking(numbers: Array) -> Array:
        bones = posed(pose(numbers))
        (one, looks), (other, back) = _pad(bones, 4), _pad(bones, 0)
        across = looks - back
        across = across / max(float(np.linalg.norm(across)), 1e-9)
        return np.concatenate([1e3 * (other - one - size * across), 0.8 * (looks + back), 0.03 * (numbers - start)])

    low, high = np.concatenate([FINGER_LIMITS[1:], THUMB_LIMITS]).T
    numbers = least_squares(lacking, start, bounds=(low, high), x_scale=10.0, max_nfev=60).x
    bones = posed(pose(numbers))
    (one, _), (other, _) = _pad(bones, 4), _pad(bones, 0)
    across = (other - one) / max(float(np.linalg.norm(other - one)), 1e-9)
    middle = (one + other) / 2
    return Hold(pose(numbers), middle, across, _squared(KNUCKLES[:2].mean(axis=0) - middle, across))


def _rod(size: float) -> Hold:
    """A pen or spoon between the pulps of thumb and index, laid on the side of the middle finger and the root of the index."""
    from scipy.optimize import least_squares

    radius = size / 2
    start = np.array([40.0, 46.0, 16.0, 46.0, 56.0, 22.0, 30.0, 40.0, 26.0, 16.0, 30.0])

    def pose(numbers: Array) -> Pose:
        rest = ((-1, 56, 66, 30), (-2, 62, 70, 32))
        return Pose(((-2, *numbers[:3]), (2, *numbers[3:6]), *rest), tuple(numbers[6:11]))

    def rod(numbers: Array) -> tuple[Array, Array]:
        one, other = numbers[11:14] / 1e3, numbers[14:17] / 1e3
        return one, (other - one) / max(float(np.linalg.norm(other - one)), 1e-9)

    def lacking(numbers: Array) -> Array:
        bones = posed(pose(numbers))
        at, way = rod(numbers)
        touch, deep = [], []
        for k in (0, 1, 4):
            skin = _placed(bones, k)
            far = _from_rod(skin[2], at, way, radius)
            touch.append(far.min())
            deep.append(np.minimum(_from_rod(np.concatenate(skin), at, way, radius), 0.0))
        root = (
            _from_segment(KNUCKLES[0], numbers[11:14] / 1e3, numbers[14:17] / 1e3, radius, radius) - 1.02 * THICK[0, 0]
        )
        pads = [_from_rod(_pad(bones, k)[0], at, way, radius) for k in (0, 4)]
        ends = np.concatenate(
            [(numbers[11:14] / 1e3 - (_pad(bones, 0)[0] + _pad(bones, 4)[0]) / 2) * 30.0, numbers[14:17] / 1e3 - held]
        )
        return np.concatenate(
            [
                700 * np.array(touch),
                500 * np.array(pads),
                [500 * root],
                500 * np.sort(np.concatenate(deep))[:10],
                20 * ends,
                0.01 * (numbers[:11] - start),
            ]
        )

    held = KNUCKLES[0] + (-0.012, 0.014, 0.010)
    bones = posed(pose(np.concatenate([start, np.zeros(6)])))
    begin = (_pad(bones, 0)[0] + _pad(bones, 4)[0]) / 2
    first = np.concatenate([start, begin * 1e3, held * 1e3])
    limits = np.concatenate([FINGER_LIMITS[1:], FINGER_LIMITS[1:], THUMB_LIMITS, np.tile([-300.0, 300.0], (6, 1))])
    found = least_squares(lacking, first, bounds=tuple(limits.T), x_scale=10.0, diff_step=1e-4, max_nfev=80).x
    at, way = rod(found)
    return Hold(pose(found), at, way, _squared(np.array([0.0, -1.0, 0.3]), way))


def _squared(vector: Array, axis: Array) -> Array:
    """The part of a vector at right angles to an axis, of length 1."""
    rest = vector - (vector @ axis) * axis
    return np.asarray(rest / np.linalg.norm(rest))

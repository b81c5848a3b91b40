"""The bones of a hand: lengths, joints and limits of an adult, and where each bone is in a pose.

The hand's frame: its origin at the wrist, +x towards the fingers, +y where the thumb of a right hand is, +z out of the back of the
hand; the palm looks along -z. All numbers are of a right hand of 0.19 m from wrist to the tip of the middle finger, and grow with it.

Source: A. Buryanov and V. Kotiuk, "Proportions of hand segments" (2010), for the lengths; a clinical goniometry table for the limits.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .signed import Array

LENGTH = 0.19
"""From the wrist to the tip of the middle finger, m: an adult's."""
FINGERS = ("index", "middle", "ring", "little")
KNUCKLES = np.array([(88.0, 27.0, 0.0), (90.5, 4.5, 2.0), (85.5, -16.5, 0.5), (76.5, -35.0, -4.0)]) / 1e3
"""(4, 3) m: the middles of the joints at which the fingers begin."""
BONES = np.array([(43.0, 25.5, 22.0), (47.0, 29.0, 23.0), (43.5, 27.5, 22.5), (34.0, 19.5, 19.5)]) / 1e3
"""(4, 3) m: how long each finger's three pieces are, the last with the flesh at its tip."""
THICK = np.array([(10.8, 9.8, 8.6, 7.3), (11.0, 10.0, 8.8, 7.5), (10.4, 9.4, 8.3, 7.0), (9.4, 8.3, 7.3, 6.2)]) / 1e3
"""(4, 4) m: half the width of each finger at its three joints and near its tip."""
ROLL = np.radians((-4.0, 0.0, 5.0, 10.0))
"""How the fingers lean, so that all bend towards the ball of the thumb."""
SPLAY = np.radians((3.0, 0.5, -2.5, -7.0))
"""How they spread where nothing is said."""
THUMB_ROOT = np.array([20.0, 23.0, -9.0]) / 1e3
THUMB_BONES = np.array([44.0, 33.0, 29.0]) / 1e3
THUMB_THICK = np.array([14.0, 11.6, 10.8, 8.8]) / 1e3
FINGER_LIMITS = np.array([(-14, 14), (-12, 94), (0, 112), (-4, 80)], dtype=float)
"""(4, 2) degrees: how far a finger spreads, and bends at its three joints."""
THUMB_LIMITS = np.array([(0, 62), (0, 62), (-40, 75), (-15, 62), (-12, 80)], dtype=float)
"""(5, 2) degrees: what `Pose.thumb` may be."""


@dataclass(frozen=True)
class Pose:
    """The angles of a hand, in degrees."""

    fingers: tuple[tuple[float, float, float, float], ...] = ((0.0, 0.0, 0.0, 0.0),) * 4
    """Of each finger how far it spreads, more than in a hand at rest and towards the thumb, and bends at its three joints."""
    thumb: tuple[float, float, float, float, float] = (35.0, 20.0, 0.0, 8.0, 8.0)
    """Its root away from the index in the palm's plane, out of that plane, and turned to oppose; its two other joints."""
    wrist: tuple[float, float] = (0.0, 0.0)
    """How far the forearm leans back: the hand bent towards the palm, and towards the thumb."""

    @classmethod
    def of(cls, numbers: Any) -> "Pose":
        """A pose of 23 numbers, as `numbers` gives them."""
        row = [float(v) for v in numbers]
        four = tuple(tuple(row[4 * k : 4 * k + 4]) for k in range(4))
        return cls(four, tuple(row[16:21]), tuple(row[21:23]))  # type: ignore[arg-type]

    def numbers(self) -> Array:
        """(23,) degrees."""
        return np.concatenate([np.ravel(self.fingers), self.thumb, self.wrist])

    def towards(self, other: "Pose", share: float) -> "Pose":
        """The pose on the way to another: 0 is this, 1 the other."""
        return Pose.of((1 - share) * self.numbers() + share * other.numbers())

    def bent(self, flexion: float, deviation: float = 0.0) -> "Pose":
        """The same with the wrist bent towards the palm, and towards the thumb, degrees."""
        return replace(self, wrist=(float(flexion), float(deviation)))


@dataclass(frozen=True)
class Bones:
    """Where the bones of a posed hand are: of each where it begins (3,), m, and its frame (3, 3), x along it and z out of its back."""

    fingers: tuple[tuple[tuple[Array, Array], ...], ...]
    """Of index, middle, ring and little finger three each."""
    thumb: tuple[tuple[Array, Array], ...]
    forearm: tuple[Array, Array]
    """Its x points to the wrist."""
    scale: float


def turn(axis: int, angle: float) -> Array:
    """(3, 3): by an angle, radians, about an axis."""
    c, s = np.cos(angle), np.sin(angle)
    found = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    found[i, i], found[i, j], found[j, i], found[j, j] = c, -s, s, c
    return found


def posed(pose: Pose, length: float = LENGTH) -> Bones:
    """The bones of a right hand of a length, m, in a pose."""
    scale = length / LENGTH
    fingers = []
    for k in range(4):
        spread, *bends = np.radians(pose.fingers[k])
        fingers.append(
            _chain(KNUCKLES[k] * scale, turn(2, SPLAY[k] + spread) @ turn(0, ROLL[k]), bends, BONES[k] * scale)
        )
    away, out, opposed, *bends = np.radians(pose.thumb)
    # At rest the nail of the thumb looks half sideways; opposing turns it to look away from the fingers.
    root = turn(2, away) @ turn(1, out) @ turn(0, -np.radians(62.0) - opposed)
    thumb = _chain(THUMB_ROOT * scale, root, [0.0, *bends], THUMB_BONES * scale)
    bent, aside = np.radians(pose.wrist)
    forearm = turn(1, -bent) @ turn(2, -aside)
    return Bones(tuple(fingers), thumb, (np.zeros(3), forearm), scale)


def _chain(at: Array, frame: Array, bends: Any, long: Array) -> tuple[tuple[Array, Array], ...]:
    found = []
    for bend, far in zip(bends, long, strict=True):
        frame = frame @ turn(1, float(bend))
        found.append((at, frame))
        at = at + far * frame[:, 0]
    return tuple(found)

"""A hand as a body of the world: a palm, and five digits on hinges at the knuckles, for a plan's motors to close.

    HAND = sculpt.hand_parts("relaxed", palm=(0, 0, 1), sleeve="#33475b")   # in sculpt/hand.py, an asset of type sculpt

What moves it is the plan's: a joint of the whole, and motors of its hinges `hand_index` … `hand_thumb`, each a declared
intervention. It presses by convex pieces: three of each finger, two of the thumb, eight of palm and wrist.
"""

from functools import partial
from typing import Any

import numpy as np

from ..joints import Hinge
from . import brushes, hand_flesh, hand_paint
from .figure import Part
from .hand_bones import BONES, FINGERS, LENGTH, THICK, THUMB_BONES, THUMB_THICK, Bones
from .hands import hand
from .primitives import half_space, round_cone
from .signatures import signature
from .signed import Array, Shape, Vec3, boxed, difference

DENSITY = 1080.0
"""kg/m^3, of flesh and bone together."""
BENDS, THUMB_BENDS = 85.0, 55.0
"""Degrees that a knuckle, and the thumb's, bend at most from straight, and `OPENS` from where they are made back."""
OPENS = 12.0
STIFF, DAMPS = 0.12, 0.25
"""N·m/rad and N·m·s/rad of a knuckle of an adult's hand: it opens again what nobody closes, and muscle gives way with speed, so that
a finger pulled with 0.25 N·m closes by a radian a second."""
STUB = 0.10


def hand_parts(
    pose: str = "relaxed",
    size: float = 0.0,
    *,
    side: str = "right",
    palm: Vec3 = (0.0, 0.0, -1.0),
    fingers: Vec3 = (1.0, 0.0, 0.0),
    length: float = LENGTH,
    forearm: float = 0.12,
    skin: str = hand_paint.SKIN,
    sleeve: str = "",
    cells: int = 72,
) -> tuple[Part, ...]:
    """The parts of a hand that presses: `palm`, to which `index`, `middle`, `ring`, `little`, `thumb` hang on a hinge each.

    `pose` and `size` are as of `hand`: how it is made, joints at zero; each hinge bends on from there, towards the palm with positive
    angles, by up to 85° from straight. The palm looks to `palm`, the fingers of a flat hand point to `fingers`; the thumb lies so that
    it is a right or a left hand. It is drawn as it is made, a piece each, and weighs some 0.5 kg with its forearm.

    Raises:
        ValueError: what `hand` refuses, or two directions that are none, or one.
    """
    made = hand(pose, size, side=side, length=length, forearm=forearm, skin=skin, sleeve=sleeve)
    bones, turned = made.bones, _turned(palm, fingers, made.left)
    key = (made.pose.numbers(), length, forearm, made.left, turned)

    def part(name: str, flesh: hand_flesh.Flesh, hulls: list[Shape], **more: Any) -> Part:
        shape = _placed(hand_flesh.shape_of(flesh, signature("part of a hand", name, *key)), turned)
        paint = more.pop("paint", partial(_paint, turned=turned, bones=bones, skin=skin))
        small = cells if name == "palm" else max(cells // 2, 32)
        make = {
            "cells": small,
            "triangles": 9000 if name == "palm" else 4000,
            "texels": 256,
            "hulls": [_placed(one, turned) for one in hulls],
        }
        return Part(name, shape, paint=paint, density=DENSITY, make=make, **more)

    whole = hand_flesh.palm(bones, STUB)
    below = hand_flesh.arm(bones, forearm)
    for kind in ("pieces", "creases", "balls"):
        getattr(whole, kind).extend(getattr(below, kind))
    found = [part("palm", whole, _palm_hulls(bones, forearm))]
    for number, name in enumerate((*FINGERS, "thumb")):
        chain, long, thick = (
            (bones.fingers[number], BONES[number], THICK[number])
            if number < 4
            else (bones.thumb, THUMB_BONES, THUMB_THICK)
        )
        root = 0 if number < 4 else 1
        at, frame = chain[root]
        start = made.pose.fingers[number][1] if number < 4 else made.pose.thumb[3]
        # A turn about an axis is mirrored as its plane is: the axis itself keeps its way along y.
        axis = turned @ frame[:, 1]
        hinge = Hinge(
            name, anchor=_three(turned @ at), axis=_three(axis * (np.linalg.det(turned))),
            range_deg=(-OPENS, max((BENDS if number < 4 else THUMB_BENDS) - start, 5.0)),
            stiffness=STIFF * bones.scale**3, damping=DAMPS * bones.scale**3,
        )  # fmt: skip
        flesh = hand_flesh.digit(chain, long, thick, bones.scale, root)
        found.append(
            part(
                name,
                flesh,
                _digit_hulls(chain, long * bones.scale, thick * bones.scale, root),
                parent="palm",
                joint=hinge,
            )
        )
    if sleeve:
        cloth = hand_flesh.Flesh()
        mm = 1e-3 * bones.scale
        end = max(forearm, 0.06 * bones.scale)
        cloth.cone(bones.forearm, (-20 * mm, 0, -mm), (-end, 0, -2 * mm), 32 * mm, 33 * mm + 0.1 * end, mm, 0.80)
        hem = half_space((1.0, 0.0, 0.0), -36 * mm)
        cut = difference(
            hand_flesh.shape_of(cloth, signature("sleeve of a hand", *key)),
            _beyond(hem, bones.forearm[1]),
            radius=2 * mm,
        )
        make = {"cells": 96, "triangles": 8000, "texels": 128, "hulls": "convex"}
        shape = _placed(cut, turned)
        found.append(
            Part("sleeve", shape, parent="palm", paint=partial(_cloth, colour=sleeve), density=150.0, make=make)
        )
    return tuple(found)


def _turned(palm: Vec3, fingers: Vec3, left: bool) -> Array:
    """(3, 3): the columns are where a hand's x, y and z come to lie; of a left one it is its mirror image at once."""
    out, along = -np.asarray(palm, dtype=float), np.asarray(fingers, dtype=float)
    if out.shape != (3,) or along.shape != (3,) or not np.linalg.norm(np.cross(out, along)) > 1e-6:
        raise ValueError(
            f"hand_parts: the palm looks to {palm}, the fingers point to {fingers}: give two directions at right angles"
        )
    out = out / np.linalg.norm(out)
    along = along - (along @ out) * out
    along = along / np.linalg.norm(along)
    return np.stack([along, (-1.0 if left else 1.0) * np.cross(out, along), out], axis=1)


def _placed(shape: Shape, turned: Array) -> Shape:
    """A shape of the hand's frame where it comes to lie."""
    low, high = boxed(shape.corners() @ turned.T)
    return Shape(lambda p: shape.measure(p @ turned), low, high, signature("placed", shape, turned))


def _paint(points: Array, normals: Array, turned: Array, bones: Bones, skin: str) -> tuple[Array, Array]:
    rgb, rough = hand_paint.paint(bones, False, skin)(points @ turned, normals @ turned)
    return rgb, rough


def _beyond(hem: Shape, fore: Array) -> Shape:
    """What of a forearm lies before the hem of its sleeve."""
    return Shape(lambda p: -hem.measure(p @ fore), hem.low, hem.high, signature("before", hem, fore))


def _cloth(points: Array, _normals: Array, colour: str) -> tuple[Array, Array]:
    weave = 0.92 + 0.16 * brushes.mottled(points, 0.004, seed=1) - 0.05 * brushes.mottled(points, 0.03, seed=2)
    return np.clip(brushes.plain(points, colour) * weave[:, None], 0, 1), np.full(len(points), 0.9)


def _three(vector: Array) -> Vec3:
    x, y, z = (round(float(v), 9) for v in vector)
    return (x, y, z)


def _digit_hulls(chain: Any, long: Array, thick: Array, root: int) -> list[Shape]:
    """Rods, of which the first begins where it is clear of the palm's at any bend: nothing keeps neighbours of a fixed palm apart."""
    found = []
    for k in range(root, 3):
        at, frame = chain[k]
        end = at + frame[:, 0] * (long[k] - (thick[3] if k == 2 else 0.0))
        begin = at + frame[:, 0] * ((2.0 * thick[k] if root == 0 else 1.1 * thick[k]) if k == root else 0.0)
        found.append(round_cone(_three(begin), _three(end), 1.84 * thick[k], 1.84 * thick[k + 1]))
    return found


def _palm_hulls(bones: Bones, forearm: float) -> list[Shape]:
    s = bones.scale
    heel = np.array([(10, 12, -2), (9, 4, -1), (9, -6, -1), (10, -14, -3)]) * 1e-3 * s
    found = [
        round_cone(
            _three(heel[k]),
            _three(bones.fingers[k][0][0] - np.array((2, 0, 3)) * 1e-3 * s),
            25e-3 * s,
            (22e-3, 22e-3, 21e-3, 19e-3)[k] * s,
        )
        for k in range(4)
    ]
    at, frame = bones.thumb[0]
    found.append(round_cone(_three(at), _three(at + frame[:, 0] * 0.62 * THUMB_BONES[0] * s), 27e-3 * s, 22e-3 * s))
    found.append(
        round_cone(
            _three(np.array((14, -20, -7)) * 1e-3 * s),
            _three(np.array((50, -31, -6.5)) * 1e-3 * s),
            25e-3 * s,
            20e-3 * s,
        )
    )
    fore = bones.forearm[1]
    for y in (-11e-3, 11e-3):
        start, end = (fore @ np.array((x, y * s, -1e-3 * s)) for x in (0.0, -forearm))
        found.append(round_cone(_three(start), _three(end), 36e-3 * s, 42e-3 * s))
    return found

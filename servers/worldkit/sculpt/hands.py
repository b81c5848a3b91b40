"""A hand as a ready figure: `hand("grip", 0.025)` is the shape, its paint, and where it holds; drawn or as a body.

    held = sculpt.hand("grip", 0.025, side="left", sleeve="#33475b")
    sculpt.add(spec, held.shape, name="hand", pos=(0, 0, 1), paint=held.paint, density=1100)

See `hand_bones` for the frame of a hand: +x along the fingers, the palm looks along -z.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .. import kept_shapes
from . import hand_flesh, hand_grips, hand_paint
from .brushes import Paint
from .hand_bones import LENGTH, Bones, Pose, posed
from .marching import bare
from .minting import code
from .signatures import signature
from .signed import Array, Shape

STEP, TRIANGLES = 1.4e-3, 30_000
"""How fine a hand of an adult is drawn: its cells, m, and triangles at most."""
COARSE = 2.4e-3
"""Of one that is seen for a moment, on its way from one pose to another."""
IN_SLEEVE = 0.075
"""So much of a forearm is there in a sleeve, m."""
LEAST, MOST = 0.05, 0.5
"""Lengths that a hand may have, m: an infant's is 0.06, a statue's 0.5."""


@dataclass(frozen=True)
class HandMesh:
    """One piece of a hand as it is drawn."""

    name: str
    """`skin`, `nails` or `sleeve`."""
    vertices: Array
    """(V, 3) m, in the hand's frame."""
    faces: Array
    """(F, 3)."""
    uv: Array | None
    picture: Array | None
    """uint8 (H, W, 3), which `uv` lies on."""
    colour: str
    roughness: float


@dataclass(frozen=True)
class Hand:
    """A hand in a pose; `hand` makes one."""

    pose: Pose
    point: Array
    """(3,) m, in its frame: the middle of what it holds."""
    axis: Array
    """(3,): along a bar that it holds, from the little finger to the thumb; across the palm where it holds none."""
    into: Array
    """(3,): from what it holds into the hand, at right angles to `axis`."""
    left: bool
    length: float
    skin: str
    forearm: float
    sleeve: str

    @cached_property
    def bones(self) -> Bones:
        """Those of the right hand of which this is one, or the mirror image."""
        return posed(self.pose, self.length)

    @property
    def shape(self) -> Shape:
        """Its distance function, bare."""
        whole = hand_flesh.flesh(self.pose, self.length, self.forearm)
        return whole.mirrored("y") if self.left else whole

    @property
    def paint(self) -> Paint:
        """Skin and nails, for `sculpt.add` and `sculpt.made`."""
        return hand_paint.paint(self.bones, self.left, self.skin)

    def towards(self, other: "Hand", share: float) -> "Hand":
        """The hand on its way to another one's pose; it holds what the other does."""
        return replace(other, pose=self.pose.towards(other.pose, share))

    def meshes(self, fine: bool = True) -> tuple[HandMesh, ...]:
        """Skin, nails and sleeve, as a film draws them; coarser if not `fine`."""
        scale = self.bones.scale
        step = (STEP if fine else COARSE) * scale
        vertices, faces = self._skin(step)
        tones = hand_paint.tones(vertices, self.bones)
        found = [HandMesh("skin", vertices, faces, tones, hand_paint.palette(self.skin), "#ffffff", 0.66)]
        points, triangles, uv = hand_paint.nails(self.bones)
        picture = np.repeat(hand_paint.NAIL[:, None], 4, axis=1).astype(np.uint8)
        found.append(HandMesh("nails", points, triangles, uv, picture, "#ffffff", 0.35))
        if self.sleeve:
            found.append(HandMesh("sleeve", *_sleeve(self.bones, self.forearm), None, None, self.sleeve, 0.9))
        return tuple(_mirrored(one) for one in found) if self.left else tuple(found)

    def _skin(self, step: float) -> tuple[Array, Array]:
        long = min(self.forearm, IN_SLEEVE * self.bones.scale) if self.sleeve else self.forearm
        key = signature(code(), "skin of a hand", self.pose.numbers(), self.length, long, step)
        held = kept_shapes.kept(key)
        if held is not None and {"vertices", "faces"} <= set(held):
            return held["vertices"], held["faces"]
        shape = hand_flesh.flesh(self.pose, self.length, long)
        vertices, faces, _ = bare(shape, int(np.clip(float(shape.size.max()) / step, 8, 400)))
        if len(faces) > TRIANGLES:
            import fast_simplification

            points, faces = fast_simplification.simplify(
                vertices.astype(np.float32), faces.astype(np.int32), target_count=TRIANGLES
            )
            vertices = points.astype(float)
        kept_shapes.keep(key, {"vertices": vertices, "faces": faces})
        return vertices, faces


def hand(
    pose: str = "relaxed",
    size: float = 0.0,
    *,
    side: str = "right",
    length: float = LENGTH,
    wrist: tuple[float, float] = (0.0, 0.0),
    forearm: float = 0.12,
    skin: str = hand_paint.SKIN,
    sleeve: str = "",
) -> Hand:
    """A hand with a piece of forearm: drawn by `film.hand`, or a body by its `shape` and `paint`.

    `pose` is `open`, `relaxed`, `flat`, `fist` or `point`; or `grip` around a bar of the diameter `size`, m (6 to 80 mm), `pinch` of
    what is `size` thick, `hold_rod` of a pen or spoon. Fingers bend until their flesh touches it. `length` is from wrist to fingertip, m;
    `wrist` is bent towards the palm and towards the thumb, degrees; `sleeve` is a colour, and none leaves the arm bare.

    Raises:
        ValueError: there is no such pose or side, or a size that it cannot have.
    """
    if side not in ("left", "right"):
        raise ValueError(f"hand: side is left or right, not {side!r}")
    if not LEAST <= length <= MOST or not 0.05 <= forearm / length * LENGTH <= 1.5:
        raise ValueError(
            f"hand: it is {LEAST:g} to {MOST:g} m long, with a forearm of 0.05 to 1.5 m; not {length:g} and {forearm:g} m"
        )
    held = hand_grips.hold(pose, float(size), length)
    flip = np.array([1.0, -1.0 if side == "left" else 1.0, 1.0])
    # A mirrored hand holds the mirrored bar: its axis still points to its thumb.
    return Hand(
        held.pose.bent(*wrist),
        held.point * flip,
        held.axis * flip,
        held.into * flip,
        side == "left",
        length,
        skin,
        forearm,
        sleeve,
    )


def _mirrored(one: HandMesh) -> HandMesh:
    return replace(one, vertices=one.vertices * (1.0, -1.0, 1.0), faces=one.faces[:, ::-1])


def _sleeve(bones: Bones, forearm: float) -> tuple[Array, Array]:
    """A sleeve from a little behind the wrist to the end of the forearm: a hem, folds that die away, and a round end."""
    s = bones.scale
    at, turned = bones.forearm
    mm = 1e-3 * s
    end = max(forearm, 0.08 * s)
    # Along it: from inside the hem, around its edge, over a band with a seam, then the sleeve.
    rows: list[tuple[float, float]] = [
        (70, -2.0),
        (50, -1.4),
        (37, -0.6),
        (34.6, 0.3),
        (34, 1.2),
        (34.6, 2.1),
        (37, 2.6),
        (46, 2.7),
        (56, 2.6),
        (57.3, 1.7),
        (58.6, 2.3),
    ]
    far = np.linspace(62, end / mm, max(int((end / mm - 62) / 5), 3))
    rows += [(float(x), 2.6) for x in far]
    around = np.linspace(0, 2 * np.pi, 49)[:-1]
    rings = []
    for x, out in rows:
        base = 31.5 + 0.115 * max(x - 45.0, 0.0)
        fold = np.exp(-(((x - 105) / 55) ** 2)) if x > 60 else 0.0
        ripple = 1.5 * fold * np.sin(0.16 * x + 1.6 * np.sin(around + 0.6)) + 0.8 * fold * np.sin(3 * around + 0.09 * x)
        radius = base + out + ripple
        rings.append(np.stack([np.full(48, -x), radius * np.cos(around), 0.80 * radius * np.sin(around) - 1.0], axis=1))
    last = rings[-1]
    for share in (0.96, 0.8, 0.5, 0.12):  # the end of the arm, which the picture seldom shows
        rings.append(np.stack([last[:, 0] - 0.5 * (1 - share) * 40, share * last[:, 1], share * last[:, 2]], axis=1))
    points = np.concatenate(rings) * mm @ turned.T + at
    grid = np.arange(len(points)).reshape(len(rings), 48)
    a, b = grid[:-1].ravel(), np.roll(grid, -1, axis=1)[:-1].ravel()
    faces = np.concatenate([np.stack([a, a + 48, b], 1), np.stack([b, a + 48, b + 48], 1)])
    closing = np.array([(grid[-1, 0], grid[-1, i + 1], grid[-1, i]) for i in range(1, 47)])
    opening = np.array([(grid[0, 0], grid[0, i], grid[0, i + 1]) for i in range(1, 47)])
    return points, np.concatenate([faces, closing, opening])

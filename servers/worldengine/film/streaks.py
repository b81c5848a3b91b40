"""Motion blur of one picture: what moves is smeared along its way, by where each point that is seen goes while a shutter is open.

A film camera's shutter is open for half of a frame's time. To draw many moments of that costs as many pictures. Here one is drawn,
of the middle moment, and with it what each pixel shows and how far away; so it is known where each point comes from and goes to,
by the poses of its thing and of the camera, along the arc on which it turns. What is behind a thing that moves shows through its smeared outline; what
stands in front of it keeps its own. Shadows, mirror images and what is soft stay where they are, or go with the camera.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from . import carrying, round_things, screws

if TYPE_CHECKING:
    from .carrying import Surfaces
    from .renderers.preview.eye import View

LEAST_PX = 1.0
"""What goes less far while the shutter is open stays sharp."""
APART_PX = 3.0
"""So far apart lie the places that are added up."""
FEWEST, MOST = 3, 24
"""Places that are added up."""
LONGEST = 0.15
"""No streak is longer than this share of the picture's height: a longer one would be steps."""
KIN = 0.02, 0.002
"""What turns as another thing but for so much, and goes as it does but for so many m, is a part of the same."""
LIGHT = (np.arange(256, dtype=np.float32) / 255) ** 2.2
STEPS = 4095
SHADE = np.rint(255 * (np.arange(STEPS + 1) / STEPS) ** (2 / 2.2)).astype(np.uint8)
"""The value of a pixel by the square root of its light."""


def streaked(picture: np.ndarray, now: Surfaces, poses: np.ndarray, view: View, share: float = 1.0) -> np.ndarray:
    """A picture, uint8 (H, W, 3), smeared along the way to another moment; half of the way lies before it.

    Args:
        picture: of the middle moment.
        now: what it shows, pixel by pixel.
        poses: of each thing at a moment soon after (N, 3, 4), as in `Surfaces`.
        view: of the camera then.
        share: how much of the way of things from the one to the other is smeared; the camera's is all of it.
    """
    height, width = now.depth.shape
    mover = _movers(now, poses)
    found, light = picture, None
    turn, step = carrying.pinhole(now.view, view, np.eye(3), np.zeros(3), width, height)
    if not (np.allclose(turn, np.eye(3) * turn[2, 2], atol=1e-9) and np.abs(step).max() < 1e-9):
        ways = _of_camera(now, turn, step)
        if max(-float(ways.min()), float(ways.max())) >= LEAST_PX:
            light = _along_all(LIGHT[picture], ways, mover)
            found = np.where(mover[..., None], picture, _shade(light))
    if not mover.any():
        return found
    goers = _goers(now, poses, view, mover, share)
    part = goers.around(height, width)
    kin = _kin(now.poses, poses)
    own = LIGHT[picture[part]]
    around = own if light is None else light[part]
    theirs = np.where(mover[part], kin[now.things[part]], -1)
    rows, columns, smeared = _over(own, around, now.near[part], theirs, goers.moved(part), kin[goers.things])
    found = found.copy()
    found[part][rows, columns] = _shade(smeared)
    return found


class Goers(NamedTuple):
    """Pixels that things which move come to while the shutter is open."""

    rows: np.ndarray
    columns: np.ndarray
    ways: np.ndarray
    """How far what is seen there goes in the picture, pixels: float32 (N, 2), to the right and down."""
    bows: np.ndarray
    """How its way bends, pixels: at a share s of it, from -1/2 to 1/2, it is s * way + s² * bow beside its middle; float32 (N, 2)."""
    depth: np.ndarray
    """How far away it is, m (N,)."""
    things: np.ndarray
    """Number of what comes there (N,)."""
    round: np.ndarray
    """Where the thing is round, and turns (R,): numbers of these pixels; its outline goes otherwise than its pattern."""
    outline: tuple[np.ndarray, np.ndarray]
    """Ways and bows (R, 2) of that outline."""

    def around(self, height: int, width: int) -> tuple[slice, slice]:
        """Rows and columns of the part of a picture that is read for them."""
        wide = int(np.ceil(np.abs(self.ways).max() / 2 + np.abs(self.bows).max() / 4)) + 8
        return tuple(
            slice(max(int(at.min()) - wide, 0), min(int(at.max()) + wide + 1, most))
            for at, most in ((self.rows, height), (self.columns, width))
        )  # type: ignore[return-value]

    def origins(self, share: float) -> tuple[np.ndarray, np.ndarray]:
        """Columns and rows of what comes to these pixels at a share of its way, which it goes on an arc that ends here."""
        x, y = (share * (share * self.bows - self.ways)).T
        return self.columns + x, self.rows + y

    def outlines(self, share: float) -> tuple[np.ndarray, np.ndarray]:
        """The same of the outlines of what is round: columns and rows (R,)."""
        x, y = (share * (share * self.outline[1] - self.outline[0])).T
        return self.columns[self.round] + x, self.rows[self.round] + y

    def moved(self, part: tuple[slice, slice]) -> Goers:
        """The same in a part of the picture."""
        return self._replace(rows=self.rows - part[0].start, columns=self.columns - part[1].start)


def _shade(light: np.ndarray) -> np.ndarray:
    return SHADE[(np.sqrt(np.clip(light, 0.0, 1.0)) * STEPS + 0.5).astype(np.int32)]


def _movers(now: Surfaces, poses: np.ndarray) -> np.ndarray:
    """Where things are seen that stand elsewhere at another moment: bool (H, W)."""
    count = min(len(now.poses), len(poses))  # a string is wound up
    moves = np.zeros(len(now.poses) + 1, bool)  # the last one stands for -1
    moves[:count] = np.abs(now.poses[:count] - poses[:count]).reshape(count, -1).max(axis=1) > carrying.LEAST_M
    return np.asarray(moves[now.things])


def _kin(now: np.ndarray, then: np.ndarray) -> np.ndarray:
    """Which things go as one between two moments: a number of each, and -1 at the end, of none (N + 1,)."""
    count = min(len(now), len(then))
    turn, step = carrying.motion(now[:count], then[:count])
    rough = np.rint(np.column_stack([turn.reshape(count, 9) / KIN[0], step / KIN[1]]))
    found = np.arange(len(now) + 1)
    found[:count] = np.unique(rough, axis=0, return_inverse=True)[1].ravel()
    found[count:] += count
    found[-1] = -1
    return found


def _of_camera(now: Surfaces, turn: np.ndarray, step: np.ndarray) -> np.ndarray:
    """How far, pixels, what stands still goes in the picture as the camera moves: float32 (H, W, 2)."""
    height, width = now.depth.shape
    t, s = turn.astype(np.float32), step.astype(np.float32)
    column, row = np.arange(width, dtype=np.float32)[None], np.arange(height, dtype=np.float32)[:, None]
    h = [(t[k, 0] * column + t[k, 2]) + t[k, 1] * row + s[k] * now.near for k in range(3)]
    ahead = h[2] > 1e-6
    deep = np.where(ahead, h[2], np.float32(1.0))
    found = np.stack([h[0] / deep - column, h[1] / deep - row], axis=-1)
    return _shortened(found * ahead[..., None], LONGEST * height)


def _shortened(ways: np.ndarray, longest: float) -> np.ndarray:
    """Ways (..., 2), none longer than `longest`, pixels."""
    long = np.hypot(ways[..., 0], ways[..., 1])
    if float(long.max(initial=0.0)) > longest:
        ways = ways * np.minimum(1.0, longest / np.maximum(long, 1e-9))[..., None]
    return ways.astype(np.float32)


def _taps(ways: np.ndarray) -> np.ndarray:
    """Shares of a way, from before to after its middle, at which it is added up."""
    far = float(np.hypot(ways[..., 0], ways[..., 1]).max(initial=0.0))
    count = int(np.clip(np.ceil(far / APART_PX), FEWEST, MOST))
    return ((np.arange(count) + 0.5) / count - 0.5).astype(np.float32)


def _along_all(light: np.ndarray, ways: np.ndarray, mover: np.ndarray) -> np.ndarray:
    """What stands still, smeared as the camera moves; of what moves by itself nothing is spread on it."""
    import cv2

    x, y = carrying.grid(mover.shape[1], mover.shape[0])
    free = (~mover).astype(np.float32)
    four = cv2.merge([*cv2.split(light * free[..., None]), free])
    total = np.zeros_like(four)
    x_way, y_way = np.ascontiguousarray(ways[..., 0]), np.ascontiguousarray(ways[..., 1])
    for share in _taps(ways):
        at = x - share * x_way, y - share * y_way
        total = total + cv2.remap(four, *at, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    weight = total[..., 3:]
    return np.where(weight > 1e-3, total[..., :3] / np.maximum(weight, 1e-3), light)


def _goers(now: Surfaces, poses: np.ndarray, view: View, mover: np.ndarray, share: float) -> Goers:
    rounds = now.rounds
    held = poses if rounds is None else round_things.spun(now.poses, poses, rounds)
    if rounds is not None:
        poses = round_things.spun(now.poses, poses, rounds, round_things.MOST_RAD / max(share, 1e-9))
    longest = LONGEST * now.depth.shape[0]
    rows, columns = np.nonzero(mover)
    far, _ = _ways(now, poses, view, rows, columns, now.things[mover], now.depth[mover], share)
    rim = int(np.ceil(min(float(np.abs(far).max()), longest) / 2)) + 1
    rows, columns, things, depth = carrying.rimmed(now, mover, np.ones((2 * rim + 1,) * 2, np.uint8), rim)
    ways, bows = _shortened_arc(*_ways(now, poses, view, rows, columns, things, depth, share), longest)
    some = np.zeros(0, int) if rounds is None else np.flatnonzero(rounds[things])
    outline = ways[:0], bows[:0]
    if len(some):
        own = _ways(now, held, view, rows[some], columns[some], things[some], depth[some], share)
        outline = _shortened_arc(*own, longest)
    return Goers(rows, columns, ways, bows, depth, things, some, outline)


def _shortened_arc(ways: np.ndarray, bows: np.ndarray, longest: float) -> tuple[np.ndarray, np.ndarray]:
    """Ways (N, 2) that are not too long, pixels, and how they bend then."""
    short = _shortened(ways, longest)
    left = np.hypot(short[:, 0], short[:, 1]) / np.maximum(np.hypot(ways[:, 0], ways[:, 1]), 1e-9)
    return short, (bows * left[:, None] ** 2).astype(np.float32)


def _ways(
    now: Surfaces,
    poses: np.ndarray,
    view: View,
    rows: np.ndarray,
    columns: np.ndarray,
    things: np.ndarray,
    depth: np.ndarray,
    share: float,
) -> tuple[np.ndarray, np.ndarray]:
    """How far, pixels (N, 2), points of things at some pixels and depths go, and how their ways bend, as in `Goers`."""
    height, width = now.depth.shape
    kinds, which = np.unique(things, return_inverse=True)
    point = np.stack([columns, rows, np.ones(len(rows))], axis=1)

    def gone(then: View, turn: np.ndarray, step: np.ndarray) -> np.ndarray:
        turns, steps = carrying.pinhole(now.view, then, turn, step, width, height)
        h = np.einsum("nij,nj->ni", turns[which], point) + steps[which] / depth[:, None]
        ahead = h[:, 2:] > 1e-9
        return np.where(ahead, h[:, :2] / np.where(ahead, h[:, 2:], 1.0) - point[:, :2], 0.0)

    rest = np.broadcast_to(np.eye(3), (len(kinds), 3, 3)), np.zeros((len(kinds), 3))
    turn, step = carrying.motion(now.poses[kinds], poses[kinds])
    before, after = (gone(now.view, *screws.screwed(turn, step, share * half)) for half in (-0.5, 0.5))
    return after - before + gone(view, *rest), 2.0 * (before + after)


def _over(
    own: np.ndarray, around: np.ndarray, near: np.ndarray, movers: np.ndarray, goers: Goers, kin: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What moves, smeared over what is around it: rows, columns, and light (N, 3).

    Args:
        own: light, that of what moves as it is.
        around: light of what stands still.
        near: 1 / distance of what is seen, 1/m.
        movers: what moves where, by `_kin`, -1 where nothing does.
        goers: the pixels that it comes to.
        kin: what comes to each of them.
    """
    import cv2

    mover = movers >= 0
    # Beside what moves: another that is seen there, as the string of a yo-yo, does not go round with it.
    beside = np.flatnonzero(~mover[goers.rows, goers.columns])
    others = movers.astype(np.float32)
    mine = mover.astype(np.float32)
    four = cv2.merge([*cv2.split(own * mine[..., None]), mine])
    soft = cv2.blur(four, (3, 3)) if len(goers.round) else four  # an outline that stays where it is would be stairs
    # What is behind a thing shows where it is for a part of the time: it looks as what is seen beside the thing.
    behind = _without(around, mover, near <= near[mover].max() * (1 + carrying.EDGE))[goers.rows, goers.columns]
    total, counted = np.zeros((len(goers.rows), 4), np.float32), np.zeros((len(goers.rows), 1), np.float32)
    hides = (1.0 / np.maximum(goers.depth, 1e-9) * (1 + carrying.EDGE)).astype(np.float32)[:, None]
    for share in _taps(goers.ways):
        at = goers.origins(share)
        part = _read(four, at, cv2.INTER_LINEAR)
        if len(beside):
            seen = _read(others, (at[0][beside], at[1][beside]), cv2.INTER_NEAREST)[:, 0]
            part[beside[(seen >= 0) & (seen != kin[beside])]] = 0.0
        if len(goers.round):
            own_places = goers.outlines(share)
            part[goers.round] = _within(part[goers.round], _read(soft, own_places, cv2.INTER_LINEAR))
            for places, theirs in zip(at, own_places, strict=True):
                places[goers.round] = theirs
        front = (_read(near, at, cv2.INTER_NEAREST) > hides) & (part[:, 3:] < 0.5)  # something else is in front of it
        total += np.where(front, np.float32(0.0), part)
        counted += ~front
    known = counted[:, 0] > 0
    total, behind = total[known] / counted[known], behind[known]
    return goers.rows[known], goers.columns[known], total[:, :3] + (1.0 - total[:, 3:]) * behind


def _within(pattern: np.ndarray, outline: np.ndarray) -> np.ndarray:
    """What is round, (N, 4) with what it covers last: the colours of its pattern, as far as they are its own, within its outline."""
    theirs = np.where(pattern[:, 3:] > 0.5, pattern, outline)
    return np.asarray(theirs * (outline[:, 3:] / np.maximum(theirs[:, 3:], 1e-3)))


def _read(picture: np.ndarray, at: tuple[np.ndarray, np.ndarray], how: int) -> np.ndarray:
    """What a picture shows at some places (N,): (N, channels)."""
    import cv2

    count, tall = len(at[0]), 1 << 12  # OpenCV takes no map that is longer than 2^15
    x, y = (np.resize(part.astype(np.float32), (-(-count // tall), tall)) for part in at)
    found = cv2.remap(picture, x, y, how, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(found.reshape(x.size, -1)[:count])


def _without(around: np.ndarray, mover: np.ndarray, far: np.ndarray) -> np.ndarray:
    """What is around, with what moves taken out: its place shows the nearest beside it that is as `far`, blurred a little."""
    import cv2

    source = cv2.erode((~mover).astype(np.uint8), np.ones((3, 3), np.uint8)) > 0  # the rim is mixed with what moves
    source &= far
    if not source.any():
        return around
    _, labels = cv2.distanceTransformWithLabels(
        (~source).astype(np.uint8), cv2.DIST_L2, 3, labelType=cv2.DIST_LABEL_PIXEL
    )
    of_label = np.zeros((int(labels.max()) + 1, 3), np.float32)
    of_label[labels[source]] = around[source]
    return np.where((source | ~mover)[..., None], around, cv2.blur(of_label[labels], (7, 7)))

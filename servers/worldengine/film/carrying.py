"""Carry traced pictures over to a moment between them, by where each point that is seen stood when they were traced.

Nothing is guessed from colours: what each pixel shows and how far away it is is drawn for all three moments, so the point is
known in its thing's own frame, and with it where it was seen before and will be seen after, or that it was hidden. Light moves
by itself: shadows, gloss and mirror images melt from the one picture into the other.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from .renderers.preview.eye import View

RIM_PX = 2
"""The outline of a moving thing is mixed with what is behind it over so many pixels each way, which go where the thing goes."""
MOST_RIM_PX = 24
TAPS_PX = 2
"""A place between pixels is read from so many each way."""
MOST_FILLED, FILL_PX = 8, 48
"""What no picture shows of so many things at most is filled in by themselves, as they look within so many pixels."""
LEAST_M = 1e-6
"""What moved by less stands still."""
SLACK = 0.004
"""A point is seen where it is as far away as what is seen there or beside it, but for this share."""
EDGE, BORDER = 0.03, 0.05
"""What is nearer by more than the first share stands in front, and is the same at another moment but for the second."""
MIXED = 1e-3
"""What is mixed with something nearer weighs so little: it is better than nothing, as among leaves."""
FADED, MOST_GAIN = 1.1, 3.0
"""A film fades where one picture is so many times as bright as the other; one that is too dark by the latter tells nothing."""
LEAST_SHARED = 0.01
"""Whether it fades is told by so much of the picture at least."""
FEATHER_PX = 5
"""Over so many pixels the one picture gives way to the other where only that one shows what is seen."""
LEAST_GONE, LEAST_STILL = 4e-5, 1e-3
"""A thing is missed from so much of a picture on; one that stands still only from more on: a leaf or a stone is one of many."""


@dataclass(frozen=True, eq=False)
class Surfaces:
    """What a picture shows, pixel by pixel."""

    things: np.ndarray
    """Number of the thing, or -1 of the surroundings and of what is soft: int32 (H, W)."""
    depth: np.ndarray
    """Distance along the view axis, m, 0 where there is nothing: float32 (H, W)."""
    poses: np.ndarray
    """Of each thing how it turns and scales, and where it is, m: (N, 3, 4)."""
    view: "View"
    rim_px: int = RIM_PX
    """How wide outlines are mixed with what is behind them; 0 where that is not asked for."""
    behind: "Surfaces | None" = None
    """The same without all that is see-through; None where nothing is, or where that is not asked for."""
    rounds: np.ndarray | None = None
    """How each thing is round, by `round_things`: (N,)."""

    @cached_property
    def near(self) -> np.ndarray:
        """1 / distance, 1/m, 0 where there is nothing (H, W): along a plane it changes evenly from pixel to pixel."""
        return np.divide(1.0, self.depth, out=np.zeros_like(self.depth), where=self.depth > 0)

    @cached_property
    def rim(self) -> tuple[np.ndarray, np.ndarray]:
        """Of each pixel the inverse distance of the nearest within its rim, and whether it lies behind an edge there itself."""
        return _beside_nearer(self.near, self.rim_px)

    @cached_property
    def known(self) -> np.ndarray:
        """What another moment asks: the least and the largest inverse distance beside each pixel, that of the nearest within its
        rim, and whether it is mixed with something nearer: float32 (H, W, 4)."""
        import cv2

        brush = np.ones((3, 3), np.uint8)
        _, mixed = _beside_nearer(self.near, self.rim_px + TAPS_PX if self.rim_px else 0)
        close = cv2.dilate(self.near, brush)
        far = 2 * self.near - close  # as on a plane; beyond the edge of something near it lies what is seen no more
        sides = [far, close, self.rim[0], mixed.astype(np.float32)]
        merged: np.ndarray = cv2.merge(sides)
        return merged


class Carried(NamedTuple):
    """Where a picture shows what is seen at another moment."""

    x: np.ndarray
    y: np.ndarray
    """Place in that picture, pixels, float32 (H, W)."""
    seen: np.ndarray
    """Whether it is seen there: bool (H, W)."""
    clear: np.ndarray
    """Whether that is not mixed there with something nearer: bool (H, W)."""
    still: bool
    """All of it stands where it stood."""


def between(
    now: Surfaces,
    sides: "list[tuple[Surfaces, np.ndarray]]",
    share: float,
    smear: float = 0.0,
) -> tuple[np.ndarray, float]:
    """Reckon the picture of a moment: uint8 (H, W, 3), and the share of it that no picture shows, 1 where a thing would be missed.

    Args:
        now: what is seen at the moment.
        sides: one or two pictures, uint8 (H, W, 3), of moments before and after, with what they show.
        share: how much of the time between the two has passed, 0 to 1.
        smear: how much of the way from picture to picture a thing goes while the shutter is open.
    """
    import cv2

    found = [(carry(now, then, smear), picture) for then, picture in sides]
    parts = [1.0] if len(found) == 1 else [1.0 - share, share]
    if all(one.still for one, _ in found):
        mixed = sum(np.float32(part) * picture for part, (_, picture) in zip(parts, found, strict=True))
        return np.rint(mixed).astype(np.uint8), 0.0
    total = np.zeros((*now.depth.shape, 3), np.float32)
    weights = np.zeros(now.depth.shape, np.float32)
    carried = [
        picture if one.still else cv2.remap(picture, one.x, one.y, cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)
        for one, picture in found
    ]
    gains = exposures(parts, carried, np.logical_and.reduce([one.clear for one, _ in found]))
    for part, gain, (one, _), moved in zip(parts, gains, found, carried, strict=True):
        if gain > MOST_GAIN:
            continue
        if gain != 1.0:
            moved = np.float32(gain) * moved
        weight = np.where(one.clear, np.float32(1.0), np.float32(MIXED) * one.seen)
        if not one.clear.all():
            weight *= cv2.blur(weight, (FEATHER_PX, FEATHER_PX)) + np.float32(1e-3)
        weight *= np.float32(part)
        total += moved * weight[..., None]
        weights += weight
    unseen = weights <= 0
    missing = 1.0 if gone(now, [then for then, _ in sides], unseen) else float(unseen.mean())
    total /= np.maximum(weights, np.float32(1e-9))[..., None]
    image = np.clip(np.rint(total), 0, 255).astype(np.uint8)
    return (filled(image, unseen, now.things) if missing else image), missing


def exposures(parts: list[float], pictures: list[np.ndarray], shared: np.ndarray) -> list[float]:
    """By how much each picture has to be brighter so that what only one shows looks as lit as what is taken from all of them.

    That is told by what all of them show (`shared`, bool (H, W)), carried to one place: else a camera that pans onto something
    bright would be taken for a film that fades. Where they share next to nothing none is changed.
    """
    some = shared[::4, ::4]
    if some.mean() < LEAST_SHARED:
        return [1.0] * len(pictures)
    lit = [max(float(picture[::4, ::4][some].mean()), 1e-3) for picture in pictures]
    wanted = sum(part * one for part, one in zip(parts, lit, strict=True))
    gains = [wanted / one for one in lit]
    return gains if max(gains) > FADED * min(gains) else [1.0] * len(gains)


def gone(now: Surfaces, sides: "list[Surfaces]", hidden: np.ndarray) -> bool:
    """Whether a thing would be missed that others do not show: most of it is `hidden`, and it would not be filled in by itself."""
    kinds = np.unique(now.things[hidden])
    for thing in kinds[kinds >= 0]:
        mine = now.things == thing
        moves = any(
            thing >= len(side.poses) or np.abs(now.poses[thing] - side.poses[thing]).max() > LEAST_M for side in sides
        )
        if mine.mean() < (LEAST_GONE if moves else LEAST_STILL) or hidden[mine].mean() <= 0.5:
            continue
        if not any((side.things == thing).any() for side in sides):
            return True
    return False


def filled(image: np.ndarray, holes: np.ndarray, things: np.ndarray) -> np.ndarray:
    """A picture whose holes show the nearest that is known of the same thing, else of any; unchanged where nothing is."""
    import cv2

    if holes.all():
        return image
    known, brush = ~holes, np.ones((2 * RIM_PX + 1,) * 2, np.uint8)
    kinds, counts = np.unique(things[holes], return_counts=True)
    left = holes.copy()
    for kind in kinds[np.argsort(-counts)][:MOST_FILLED]:
        mine = holes & (things == kind)
        part = tuple(slice(*span(mine.any(axis=axis), FILL_PX)) for axis in (1, 0))
        source = cv2.erode(
            ((things[part] == kind) & known[part]).astype(np.uint8), brush
        )  # its rim is mixed with others
        if source.any():
            image[part][mine[part]] = _nearest(image[part], source > 0, mine[part])
            left[part] &= ~mine[part]
    if left.any():
        image[left] = _nearest(image, known, left)
    return image


def _nearest(image: np.ndarray, source: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    import cv2

    _, labels = cv2.distanceTransformWithLabels(
        (~source).astype(np.uint8), cv2.DIST_L2, 3, labelType=cv2.DIST_LABEL_PIXEL
    )
    of_label = np.zeros((int(labels.max()) + 1, 3), np.uint8)
    of_label[labels[source]] = image[source]
    found: np.ndarray = of_label[labels[wanted]]
    return found


def carry(now: Surfaces, then: Surfaces, smear: float = 0.0) -> Carried:
    """Find what is seen now in the picture of another moment."""
    import cv2

    height, width = now.depth.shape
    if len(now.poses) != len(then.poses):  # a string is wound up
        count = max(len(now.poses), len(then.poses))
        now, then = (replace(side, poses=_longer(side.poses, count)) for side in (now, then))
    shift = np.abs(now.poses - then.poses).reshape(len(now.poses), -1).max(axis=1) > LEAST_M
    moves = np.append(shift, False)  # the last one stands for -1
    here, there = moves[now.things], moves[then.things]
    turn, step = pinhole(now.view, then.view, np.eye(3), np.zeros(3), width, height)
    fixed = np.allclose(turn, np.eye(3) * turn[2, 2], atol=1e-9) and np.abs(step).max() < 1e-9
    if fixed and not here.any() and not there.any():
        everywhere = np.ones((height, width), bool)
        return Carried(*grid(width, height), everywhere, everywhere, True)
    if fixed:
        x, y = (part.copy() for part in grid(width, height))
        seen = np.abs(now.depth - then.depth) <= SLACK * now.depth
        clear = seen.copy()
    else:
        x, y, seen, clear = _from_elsewhere(now, then, turn, step)
    soft = (now.depth > 0) & (now.things < 0)  # how it bends is not known, so it melts where it stands
    soft &= cv2.remap((then.things < 0).astype(np.uint8), x, y, cv2.INTER_NEAREST) > 0
    seen, clear = seen | soft, clear | soft
    if not here.any() and not there.any():
        return Carried(x, y, seen, clear, False)
    rim = now.rim_px
    if smear > 0:
        rim = min(MOST_RIM_PX, rim + round(smear * farthest(now, then, shift)))
    brush = np.ones((2 * rim + 1,) * 2, np.uint8)
    wide = cv2.dilate(there.astype(np.uint8), brush)
    if fixed:
        seen &= wide == 0
    else:
        seen &= cv2.remap(wide, x, y, cv2.INTER_NEAREST, borderValue=0) == 0
    rows, columns, things, depth = rimmed(now, here, brush, rim)
    clear &= seen
    if len(rows):
        to_x, to_y, good = _placed(now, then, (rows, columns, things, depth), wide)
        x[rows, columns], y[rows, columns], seen[rows, columns], clear[rows, columns] = to_x, to_y, good, good
    return Carried(x, y, seen, clear, False)


def rimmed(
    now: Surfaces, here: np.ndarray, brush: np.ndarray, rim: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """The pixels of things that move, and of the rim around them: rows, columns, things, depths."""
    import cv2

    if not here.any():
        none = np.zeros(0, int)
        return none, none, none, np.zeros(0, np.float32)
    mask = here.astype(np.uint8)
    top, bottom = span(mask.max(axis=1), rim + 1)
    left, right = span(mask.max(axis=0), rim + 1)
    inner = mask[top:bottom, left:right]
    _, labels = cv2.distanceTransformWithLabels(1 - inner, cv2.DIST_L2, 3, labelType=cv2.DIST_LABEL_PIXEL)
    ys, xs = np.nonzero(inner)
    where = np.zeros((int(labels.max()) + 1, 2), int)
    where[labels[ys, xs]] = np.column_stack([ys + top, xs + left])
    ys, xs = np.nonzero(cv2.dilate(inner, brush))
    from_y, from_x = where[labels[ys, xs]].T
    rows, columns = ys + top, xs + left
    things, depth = now.things[from_y, from_x], now.depth[from_y, from_x]
    own = now.depth[rows, columns]
    behind = (own <= 0) | (own >= depth * (1 - SLACK)) | here[rows, columns]  # what stands in front keeps its place
    return rows[behind], columns[behind], things[behind], depth[behind]


def span(taken: np.ndarray, more: int) -> tuple[int, int]:
    """The first place that is taken (N,), and the one after the last, with `more` on both sides as far as there are any."""
    found = np.flatnonzero(taken)
    return max(int(found[0]) - more, 0), min(int(found[-1]) + more + 1, len(taken))


def _placed(
    now: Surfaces, then: Surfaces, pixels: tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray], wide: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where pixels of things that move, and of their rims, are by how these move, and whether they are seen there."""
    height, width = now.depth.shape
    rows, columns, things, depth = pixels
    kinds, which = np.unique(things, return_inverse=True)
    lenses = pinhole(now.view, then.view, *motion(now.poses[kinds], then.poses[kinds]), width, height)
    turns, steps = (part.astype(np.float32)[which] for part in lenses)
    point = np.stack([columns, rows, np.ones(len(rows))], axis=1).astype(np.float32)
    h = np.einsum("nij,nj->ni", turns, point) + steps / depth[:, None]
    ahead = h[:, 2] > 1e-9
    safe = np.where(ahead, h[:, 2], 1.0)
    to_x, to_y, far = h[:, 0] / safe, h[:, 1] / safe, h[:, 2] * depth
    column, row = np.rint(to_x), np.rint(to_y)
    inside = ahead & (column >= 0) & (column < width) & (row >= 0) & (row < height)
    column, row = np.where(inside, column, 0).astype(int), np.where(inside, row, 0).astype(int)
    own = now.things[rows, columns] == things
    there = then.depth[row, column]
    same = then.things[row, column] == things
    apart = np.abs(there - far)
    rim = (wide[row, column] > 0) & ((there <= 0) | (there >= far * (1 - SLACK)))
    good = inside & np.where(own, (same & (apart <= 0.05 * far)) | (rim & ~same), rim | same)
    return to_x, to_y, good


def motion(now: np.ndarray, then: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """How points of things at one pose (..., 3, 4) come to where they are at another: turns (..., 3, 3), steps (..., 3), m."""
    turn = then[..., :3] @ np.linalg.pinv(now[..., :3])
    return turn, then[..., 3] - (turn @ now[..., 3:])[..., 0]


def pinhole(
    now: "View", then: "View", turn: np.ndarray, step: np.ndarray, width: int, height: int
) -> tuple[np.ndarray, np.ndarray]:
    """From pixels (column, row, 1) now, and the inverse of their distance, m, to those then: (..., 3, 3) and (..., 3).

    What moves so meanwhile (..., 3, 3) and (..., 3), m, is at the sum of both; its third number is by how much the distance grows.
    """
    lens = np.array([[2 * now.tangents[0] / width, 0.0, (1.0 / width - 1.0) * now.tangents[0]],
                     [0.0, -2 * now.tangents[1] / height, (1.0 - 1.0 / height) * now.tangents[1]],
                     [0.0, 0.0, -1.0]])  # fmt: skip
    half_x, half_y = 0.5 * width / then.tangents[0], 0.5 * height / then.tangents[1]
    back = np.array([[half_x, 0.0, -(0.5 * width - 0.5)], [0.0, -half_y, -(0.5 * height - 0.5)], [0.0, 0.0, -1.0]])
    look = back @ then.axes.T
    return look @ turn @ now.axes @ lens, (turn @ now.eye + step - then.eye) @ look.T


def _from_elsewhere(
    now: Surfaces, then: Surfaces, turn: np.ndarray, step: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Where a picture from another place, of what stands still, shows what is seen now: columns, rows, whether, and if clearly.

    What borders on something nearer is mixed with it, so it goes where that goes, and nothing else is taken from such a border
    if it can be had elsewhere.
    """
    import cv2

    height, width = now.depth.shape
    column, row = np.arange(width, dtype=np.float32)[None], np.arange(height, dtype=np.float32)[:, None]
    nearest, border = now.rim
    near = np.where(border, nearest, now.near)
    t, s = turn.astype(np.float32), step.astype(np.float32)
    h = [(t[k, 0] * column + t[k, 2]) + t[k, 1] * row + s[k] * near for k in range(3)]
    ahead = h[2] > 1e-6
    deep = np.where(ahead, h[2], np.float32(1.0))
    x, y, expected = h[0] / deep, h[1] / deep, near / deep
    none = (9e9, -1.0, -1.0, 1.0)
    found = cv2.remap(then.known, x, y, cv2.INTER_NEAREST, borderMode=cv2.BORDER_CONSTANT, borderValue=none)
    far, close, beside, mixed = cv2.split(found)
    plain = (expected >= far * (1 - SLACK) - 1e-7) & (expected <= close * (1 + SLACK) + 1e-7)
    along = np.abs(beside - expected) <= BORDER * expected
    seen = ahead & np.where(border, along, plain)
    return x, y, seen, seen & (border | (mixed == 0))


def _beside_nearer(near: np.ndarray, reach: int) -> tuple[np.ndarray, np.ndarray]:
    import cv2

    brush = np.ones((2 * reach + 1,) * 2, np.uint8)
    nearest, farthest = cv2.dilate(near, brush), cv2.erode(near, brush)
    return nearest, nearest + farthest > np.float32(2 + EDGE) * near + np.float32(1e-6)


def _longer(poses: np.ndarray, count: int) -> np.ndarray:
    return np.concatenate([poses, np.zeros((count - len(poses), 3, 4))])


def strayed(now: Surfaces, then: Surfaces) -> float:
    """How far, pixels, anything that is seen goes at most between two moments, besides what the camera does."""
    if now.poses.shape != then.poses.shape:
        return float("inf")
    return farthest(now, then, np.abs(now.poses - then.poses).reshape(len(now.poses), -1).max(axis=1) > LEAST_M)


def farthest(now: Surfaces, then: Surfaces, shift: np.ndarray) -> float:
    """How far, pixels, the things that move go at most, by their middles and a still camera."""
    seen = np.unique(now.things)
    seen = seen[seen >= 0]
    seen = seen[shift[seen]]
    if not len(seen):
        return 0.0
    height, view = now.depth.shape[0], now.view
    places = [(side.poses[seen, :, 3] - view.eye) @ view.axes for side in (now, then)]
    flat = [p[:, :2] / np.maximum(-p[:, 2:], view.near_m) * height / 2 / view.tangents[1] for p in places]
    return float(np.linalg.norm(flat[1] - flat[0], axis=1).max())


def grid(width: int, height: int) -> tuple[np.ndarray, np.ndarray]:
    """Columns and rows of pixels, float32 (H, W) each."""
    x, y = np.meshgrid(np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32))
    return x, y

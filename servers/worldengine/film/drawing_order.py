"""The order in which the frames of a film are drawn, so that it looks as well as it can whenever it is cut."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import pairwise

STRIDES = (8, 4, 2, 1)
FARTHEST = STRIDES[0]


def rounds(
    shots: Sequence[range], levels: Iterable[float], lacking: Callable[[int, int, int], bool] | None = None
) -> Iterator[tuple[int, float]]:
    """(frame, samples) in the order of drawing: of the film, and after its draft of each shot, every eighth frame first, then
    those between. What stands still in a shot is drawn once for it, and need not be kept for another.

    Where frames can be reckoned, only those that are `lacking` are drafted. Each round draws these first, and from the second
    round on the others too: reckoned between good frames they look better than drawn with few samples.
    """
    rest = iter(levels)
    draft, first = next(rest), set[int]()
    for number in far_first(range(shots[-1].stop)) if lacking is None else drafted(shots, lacking):
        first.add(number)
        yield number, draft
    for number, samples in enumerate(rest):
        for early in (True, False) if number or lacking is None else (True,):
            yield from ((n, samples) for shot in shots for n in far_first(shot) if (n in first) == early)


def far_first(part: range) -> list[int]:
    """Every eighth frame, then those between."""
    return list(dict.fromkeys(number for stride in STRIDES for number in part[::stride]))


def skeleton(shot: range, stride: int) -> list[int]:
    """Every so many-th frame of a shot, and its last."""
    return sorted({*shot[::stride], shot[-1]})


def drafted(shots: Sequence[range], lacking: Callable[[int, int, int], bool]) -> Iterator[int]:
    """The frames to trace before all others, the far apart ones of all shots first: each shot's first and last and every eighth,
    then of those halfway between two that are traced the ones that cannot be reckoned from these."""
    traced = [skeleton(shot, FARTHEST) for shot in shots]
    for place in range(max(map(len, traced), default=0)):
        yield from (frames[place] for frames in traced if place < len(frames))
    gap = FARTHEST
    while gap > 1:
        for number, frames in enumerate(traced):
            new = []
            for before, after in pairwise(frames):
                middle = (before + after) // 2
                if gap // 2 < after - before <= gap and lacking(middle, before, after):
                    new.append(middle)
                    yield middle
            traced[number] = sorted({*frames, *new})
        gap //= 2

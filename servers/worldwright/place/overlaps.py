"""Which objects may overlap: a sweep along x over their world boxes."""

from collections.abc import Iterator, Sequence

from ..model.plan import Vec3

Bounds = tuple[str, Vec3, Vec3]
"""Name, lowest and highest corner, metres."""


def overlapping(bounds: Sequence[Bounds], *, deeper_than_m: float = 1e-3) -> Iterator[tuple[str, str, float]]:
    """Pairs of boxes that overlap along all three axes, with the smallest of the three overlaps in metres."""
    active: list[Bounds] = []
    for name, low, high in sorted(bounds, key=lambda b: (b[1][0], b[0])):
        active = [other for other in active if other[2][0] - low[0] > deeper_than_m]
        for other, other_low, other_high in active:
            depth = min(min(high[i], other_high[i]) - max(low[i], other_low[i]) for i in range(3))
            if depth > deeper_than_m:
                yield (*sorted((other, name)), depth)  # type: ignore[misc]
        active.append((name, low, high))

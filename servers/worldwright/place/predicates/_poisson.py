"""Sample a region of the plane by Poisson disks: no two places nearer than r, and no room left for another.

Source: R. Bridson, "Fast Poisson disk sampling in arbitrary dimensions", SIGGRAPH 2007: a grid of cells of side r / sqrt(2)
holds at most one sample each; around a random active sample up to 30 candidates are tried between r and 2 r away. Python's
Mersenne twister gives the same places on every machine.
"""

import math
from collections.abc import Callable
from random import Random

from ..anchors import Surface

TRIES = 30
STARTS = 2000
"""Each pass tries so often to find a first place, as a region may be cut into separate free parts."""
MOST = 20_000
"""The most places that are drawn: no plan has more objects."""


def places(area: Surface, apart_m: float, seed: int, fits: Callable[[float, float], bool]) -> list[tuple[float, float]]:
    """Places in the region's own frame, shuffled.

    Args:
        area: the region; its rectangle is sampled, `fits` decides.
        apart_m: least distance between two places.
        seed: the seed of the draw.
        fits: tells whether something can be at a place.
    """
    random = Random(seed)
    cell = apart_m / math.sqrt(2)
    width, height = area.extents
    x0, y0 = area.centre[0] - width / 2, area.centre[1] - height / 2
    grid: dict[tuple[int, int], tuple[float, float]] = {}
    active: list[tuple[float, float]] = []

    def free(x: float, y: float) -> bool:
        i, j = int((x - x0) / cell), int((y - y0) / cell)
        near = (grid.get((i + a, j + b)) for a in range(-2, 3) for b in range(-2, 3))
        return all(p is None or math.dist(p, (x, y)) >= apart_m for p in near)

    def take(x: float, y: float) -> None:
        grid[int((x - x0) / cell), int((y - y0) / cell)] = (x, y)
        active.append((x, y))

    for _ in range(STARTS):
        x, y = x0 + random.random() * width, y0 + random.random() * height
        if not (fits(x, y) and free(x, y)):
            continue
        take(x, y)
        while active and len(grid) < MOST:
            index = random.randrange(len(active))
            px, py = active[index]
            for _ in range(TRIES):
                angle, far = random.random() * 2 * math.pi, apart_m * (1 + random.random())
                x, y = px + far * math.cos(angle), py + far * math.sin(angle)
                inside = 0 <= x - x0 <= width and 0 <= y - y0 <= height
                if inside and free(x, y) and fits(x, y):
                    take(x, y)
                    break
            else:
                active[index] = active[-1]
                active.pop()
    found = list(grid.values())
    random.shuffle(found)
    return found

"""What a tracked vehicle looks like: a bulldozer with its hull, engine, cab and blade, its belts around sprocket, idler and road wheels."""

import itertools
from math import atan2, cos, hypot, pi, sin
from typing import TYPE_CHECKING

from .regions import GLASS, STEEL, TRIM, WHITE_LAMP, Regions, dress_body, dress_tyres, patch
from .tracked_numbers import Tracked

if TYPE_CHECKING:
    import mujoco

    from ..sculpt import Shape


def dress_tracked(spec: "mujoco.MjSpec", tracked: Tracked, name: str, look: str) -> None:
    """The shell with both belts, then the road wheels, which are seen to turn."""
    from .. import sculpt

    long, wide, high, radius = tracked.length_m, tracked.width_m, tracked.height_m, tracked.wheel_radius_m
    over, top = 2.2 * radius + 0.12, 0.6 * high
    inner = tracked.track_m - tracked.tyre_width_m - 0.06
    hull = sculpt.box((0.86 * long, inner, over - 0.3), 0.06).translate(0, 0, (over + 0.3) / 2)
    hood = sculpt.box((0.5 * long, 0.44 * wide, top - over + 0.1), 0.08).translate(0.2 * long, 0, (top + over) / 2)
    deck = sculpt.box((0.8 * long, wide - 0.1, 0.1), 0.03).translate(-0.03 * long, 0, over + 0.1)
    cab = sculpt.box((0.34 * long, 0.58 * wide, high - top + 0.5), 0.07).translate(
        -0.16 * long, 0, (high + top - 0.5) / 2
    )
    roof = sculpt.box((0.38 * long, 0.64 * wide, 0.09), 0.04).translate(-0.16 * long, 0, high - 0.045)
    pipe = sculpt.cylinder(0.12, 0.75).translate(0.24 * long, 0.25, top + 0.3)
    front = long / 2
    blade = sculpt.cylinder(1.5, wide, 0.0).rotate(90, "x") - sculpt.cylinder(1.4, 2 * wide).rotate(90, "x")
    blade = sculpt.intersection(blade.translate(front + 0.62, 0, 0.66), patch(front, 0, 0.58, (0.5, wide, 1.0)))
    arms = [
        sculpt.capsule((0.05 * long, s * (wide / 2 - 0.03), 0.5), (front - 0.1, s * (wide / 2 - 0.1), 0.4), 0.13)
        for s in (1, -1)
    ]
    belts = [_belt(tracked).translate(y=s * tracked.track_m / 2) for s in (1, -1)]
    shell = sculpt.union(hull, hood, deck, cab, roof, pipe, blade, *arms, *belts)
    pane_z, pane_h = high - 0.55, 0.62
    regions = (
        *((patch(0, s * tracked.track_m / 2, over / 2 - 0.05, (2 * long, tracked.tyre_width_m + 0.01, over)), "#2a2a2b", 0.75) for s in (1, -1)),
        (patch(front, 0, 0.6, (0.6, 2 * wide, 1.2)), STEEL, 0.4),
        (patch(0.24 * long, 0.25, top + 0.34, (0.2, 0.2, 0.8)), TRIM, 0.6),
        (patch(-0.16 * long, 0, pane_z, (0.24 * long, wide, pane_h)), GLASS, 0.07),
        (patch(-0.16 * long, 0, pane_z, (long / 2, 0.46 * wide, pane_h)), GLASS, 0.07),
        (patch(0.45 * long, 0, (top + over) / 2 + 0.05, (0.03 * long, 0.36 * wide, 0.6 * (top - over))), TRIM, 0.6),
        *((patch(0.45 * long, s * 0.16 * wide, top - 0.05, (0.1, 0.16, 0.14)), WHITE_LAMP, 0.1) for s in (1, -1)),
    )  # fmt: skip
    dress_body(spec, name, shell, Regions(look, 0.4, regions), (0, 0, radius), cells=190)
    dress_tyres(spec, tracked, name)


def _belt(tracked: Tracked) -> "Shape":
    """One belt of shoes around the road wheels, an idler in front and a sprocket behind, with both of these."""
    from .. import sculpt

    radius, thick, wide = tracked.wheel_radius_m, 0.035, tracked.tyre_width_m
    half, raised = tracked.wheelbase_m / 2, 0.55 * radius
    ends = (half + 0.62 * radius + 0.12, radius + raised)
    rounds = [(-half, radius), (half, radius), ends, (-ends[0], ends[1])]
    outside = _around(rounds, radius, thick)
    inside = _around(rounds, radius, -0.005)
    side = sculpt.extruded(outside, wide).rotate(90, "x") - sculpt.extruded(inside, 2 * wide).rotate(90, "x")
    shoes, perimeter = [], [*outside, outside[0]]
    for (xa, za), (xb, zb) in itertools.pairwise(perimeter):
        count = int(hypot(xb - xa, zb - za) / 0.17)
        turn = -atan2(zb - za, xb - xa) * 180 / pi
        shoes += [
            sculpt.box((0.05, wide, 0.045)).rotate(turn, "y").translate(xa + (xb - xa) * (i + 0.5) / count, 0, za + (zb - za) * (i + 0.5) / count)
            for i in range(count)
            if min(za, zb) > 0.1 or count < 2
        ]  # fmt: skip
    turning = [
        sculpt.cylinder(1.9 * radius, 0.6 * wide, 0.03).rotate(90, "x").translate(x, 0, z) for x, z in rounds[2:]
    ]
    return sculpt.union(side, *shoes, *turning)


def _around(rounds: list[tuple[float, float]], radius: float, out: float) -> list[tuple[float, float]]:
    """The outline (x, z) around circles of one radius, in the order of their convex polygon, as far outside as that."""
    found = []
    count = len(rounds)
    for i, (x, z) in enumerate(rounds):
        before, after = rounds[i - 1], rounds[(i + 1) % count]
        first = atan2(z - before[1], x - before[0]) - pi / 2
        last = atan2(after[1] - z, after[0] - x) - pi / 2
        while last < first:
            last += 2 * pi
        found += [
            (
                x + (radius + out) * cos(first + (last - first) * k / 6),
                z + (radius + out) * sin(first + (last - first) * k / 6),
            )
            for k in range(7)
        ]
    return found

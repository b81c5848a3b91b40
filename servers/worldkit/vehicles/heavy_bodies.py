"""What trucks, buses and trailers look like. They touch nothing; coordinates are on the ground below the middle of the wheelbase."""

from typing import TYPE_CHECKING

from .heavy_numbers import Bus, Trailer, Truck
from .regions import (
    AMBER_LAMP,
    GLASS,
    RED_LAMP,
    STEEL,
    TRIM,
    WHITE_LAMP,
    Regions,
    dress_body,
    dress_tyres,
    patch,
    wheel_rooms,
)  # fmt: skip

if TYPE_CHECKING:
    import mujoco


def dress_truck(spec: "mujoco.MjSpec", truck: Truck, name: str, look: str) -> None:
    """A cab with its windows above the front axle, and an open steel bed behind it on a ladder frame."""
    from .. import sculpt

    radius, wide, high = truck.wheel_radius_m, truck.width_m, truck.height_m
    front, over, long = truck.middle_x_m + truck.length_m / 2, 2.15 * radius, truck.cab_m
    rear = front - truck.length_m
    low = 0.55
    cab = sculpt.box((long, 0.98 * wide, high - low), 0.14).translate(front - long / 2, 0, (high + low) / 2)
    lean = sculpt.half_space((0.94, 0, 0.34), 0.94 * (front - 0.02) + 0.34 * 0.70 * high)
    cab = sculpt.intersection(cab, lean, radius=0.1)
    bed_long, bed_high, wall = truck.length_m - long - 0.12, 0.62 * high, 0.06
    middle = rear + bed_long / 2
    bed = sculpt.box((bed_long, wide, bed_high - over), 0.02).translate(middle, 0, (bed_high + over) / 2)
    inside = sculpt.box((bed_long - 2 * wall, wide - 2 * wall, bed_high - over)).translate(
        middle, 0, (bed_high + over) / 2 + 0.16
    )
    bed = sculpt.difference(bed, inside)
    ribs = [
        sculpt.box((0.07, wide + 0.05, bed_high - over)).translate(
            rear + bed_long * (i + 0.5) / 7, 0, (bed_high + over) / 2
        )
        for i in range(7)
    ]
    bed = sculpt.difference(bed | sculpt.union(*ribs), inside)
    beams = sculpt.union(
        *(
            sculpt.box((truck.length_m - 0.5, 0.09, 0.28)).translate(truck.middle_x_m, side * 0.42, over - 0.2)
            for side in (1, -1)
        )
    )
    tank = sculpt.cylinder(0.55, 1.1, 0.05).rotate(90, "y").translate(front - long - 0.75, 0.8, 0.75)
    mirrors = sculpt.box((0.08, 0.2, 0.42), 0.03).translate(front - 0.18, wide / 2 + 0.1, 0.72 * high).mirror("y")
    shell = sculpt.difference(sculpt.union(cab, bed, beams, tank, mirrors), wheel_rooms(truck), radius=0.02)
    glass_z = 0.72 * high
    regions = (
        (patch(middle, 0, (bed_high + over) / 2, (bed_long + 0.02, wide + 0.2, bed_high - over + 0.02)), "#7d7f80", 0.55),
        (patch(truck.middle_x_m, 0, over / 2, (truck.length_m, 1.1, over)), TRIM, 0.7),
        (patch(front - long - 0.75, 0.8, 0.75, (1.2, 0.6, 0.6)), STEEL, 0.3),
        (patch(front, 0, glass_z, (1.0, 0.86 * wide, 0.27 * high)), GLASS, 0.08),
        (patch(front - 0.42 * long, wide / 2, glass_z - 0.02, (0.42 * long, 0.5, 0.22 * high)), GLASS, 0.08),
        (patch(front - 0.42 * long, -wide / 2, glass_z - 0.02, (0.42 * long, 0.5, 0.22 * high)), GLASS, 0.08),
        (patch(front, 0, 0.42 * high, (0.3, 0.62 * wide, 0.13 * high)), TRIM, 0.4),
        (patch(front, 0, low + 0.16, (0.3, wide, 0.3)), TRIM, 0.6),
        *((patch(front, s * 0.4 * wide, low + 0.24, (0.3, 0.26, 0.13)), WHITE_LAMP, 0.05) for s in (1, -1)),
        *((patch(rear, s * 0.43 * wide, over + 0.12, (0.2, 0.22, 0.12)), RED_LAMP, 0.1) for s in (1, -1)),
        (patch(front - 0.18, 0, 0.72 * high, (0.1, wide + 0.5, 0.44)) - patch(front - 0.18, 0, 0.72 * high, (0.2, wide, 0.5)), TRIM, 0.5),
    )  # fmt: skip
    dress_body(spec, name, shell, Regions(look, 0.28, regions), (0, 0, radius))
    dress_tyres(spec, truck, name)


def dress_bus(spec: "mujoco.MjSpec", bus: Bus, name: str, look: str) -> None:
    """A long body with a band of windows, two doors on the right, and its number's board in front."""
    from .. import sculpt

    wide, high, low, x = bus.width_m, bus.height_m, 0.30, bus.middle_x_m
    front, rear = x + bus.length_m / 2, x - bus.length_m / 2
    shell = sculpt.box((bus.length_m, wide, high - low), 0.16).translate(x, 0, (high + low) / 2)
    unit = sculpt.box((3.0, 1.5, 0.22), 0.08).translate(x - 1.5, 0, high - 0.02)
    mirrors = sculpt.box((0.1, 0.16, 0.36), 0.03).translate(front - 0.02, wide / 2 + 0.1, 0.72 * high).mirror("y")
    shell = sculpt.difference(sculpt.union(shell, unit, mirrors), wheel_rooms(bus), radius=0.02)
    sill, top = 0.42 * high, 0.84 * high
    panes, count = [], 8
    pitch = (bus.length_m - 1.2) / count
    for i in range(count):
        at = rear + 0.6 + pitch * (i + 0.5)
        panes += [
            (patch(at, s * wide / 2, (sill + top) / 2, (pitch - 0.09, 0.3, top - sill)), GLASS, 0.07) for s in (1, -1)
        ]
    doors = [
        region
        for at in (front - 0.95, x + 0.5)
        for region in (
            (patch(at, -wide / 2, (low + top) / 2 + 0.05, (1.3, 0.3, top - low + 0.1)), TRIM, 0.4),
            (patch(at - 0.32, -wide / 2, (low + top) / 2 + 0.06, (0.52, 0.31, top - low - 0.1)), GLASS, 0.07),
            (patch(at + 0.32, -wide / 2, (low + top) / 2 + 0.06, (0.52, 0.31, top - low - 0.1)), GLASS, 0.07),
        )
    ]
    regions = (
        (patch(x, 0, low + 0.1, (bus.length_m + 1, wide + 1, 0.24)), TRIM, 0.6),
        *panes,
        *doors,
        (patch(front, 0, 0.58 * high, (0.36, 0.94 * wide, 0.46 * high)), GLASS, 0.07),
        (patch(front, 0, 0.90 * high, (0.4, 0.7 * wide, 0.08 * high)), "#1a1509", 0.3),
        (patch(front, 0, 0.90 * high, (0.42, 0.5 * wide, 0.04 * high)), AMBER_LAMP, 0.3),
        (patch(rear, 0, 0.66 * high, (0.3, 0.7 * wide, 0.3 * high)), GLASS, 0.07),
        *((patch(front, s * 0.38 * wide, 0.25 * high, (0.3, 0.34, 0.14)), WHITE_LAMP, 0.05) for s in (1, -1)),
        *((patch(rear, s * 0.42 * wide, 0.34 * high, (0.3, 0.16, 0.5)), RED_LAMP, 0.1) for s in (1, -1)),
    )
    dress_body(spec, name, shell, Regions(look, 0.22, regions), (0, 0, bus.wheel_radius_m), cells=230)
    dress_tyres(spec, bus, name)


def dress_trailer(spec: "mujoco.MjSpec", trailer: Trailer, name: str, look: str) -> None:
    """A box with rounded edges and a door behind, on a frame with a drawbar."""
    from .. import sculpt

    radius, wide, high, bar = trailer.wheel_radius_m, trailer.width_m, trailer.height_m, trailer.drawbar_m
    ball, _, level = trailer.ball
    long, low = trailer.length_m - bar, 1.2 * radius
    middle = ball - bar - long / 2
    box = sculpt.box((long, wide, high - low), 0.08).translate(middle, 0, (high + low) / 2)
    arms = [sculpt.capsule((ball, 0, level), (ball - bar - 0.3, side * 0.55, level), 0.08) for side in (1, -1)]
    coupling = sculpt.sphere(0.13).translate(ball, 0, level)
    wheel = sculpt.cylinder(0.05, 0.45).translate(ball - 0.35, 0.13, level) | sculpt.cylinder(0.2, 0.06).rotate(
        90, "x"
    ).translate(ball - 0.35, 0.13, level - 0.28)
    shell = sculpt.difference(sculpt.union(box, *arms, coupling, wheel), wheel_rooms(trailer), radius=0.02)
    behind = middle - long / 2
    regions = (
        (patch(ball - bar / 2, 0, level, (bar, 1.4, 0.7)), STEEL, 0.45),
        (patch(middle, 0, low + 0.05, (long + 0.2, wide + 0.2, 0.14)), TRIM, 0.6),
        (patch(behind, 0, (high + low) / 2, (0.06, 0.02, high - low - 0.3)), TRIM, 0.6),
        *((patch(behind, s * 0.43 * wide, low + 0.22, (0.1, 0.14, 0.2)), RED_LAMP, 0.1) for s in (1, -1)),
    )
    dress_body(spec, name, shell, Regions(look, 0.3, regions), (0, 0, radius), cells=150)
    dress_tyres(spec, trailer, name)

"""What a car looks like: a sculpted saloon body with painted glass and lamps, and wheels with tyre and rim. It touches nothing.

Outlines are a mid-size saloon's, in metres on the ground below the middle of the wheelbase, and are stretched to the car's numbers.
"""

from typing import TYPE_CHECKING, Any

from .axles import OnAxles
from .car_numbers import CORNERS, Car

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..sculpt import Shape

DRAWN_AS = Car()
"""The car whose outlines these are."""
SIDE = (
    (-2.13, 0.30), (-2.20, 0.50), (-2.19, 0.72), (-2.13, 0.90), (-1.95, 0.975), (-1.45, 0.985), (-0.60, 0.955), (0.40, 0.935),
    (0.98, 0.915), (1.45, 0.845), (1.82, 0.755), (2.05, 0.655), (2.13, 0.52), (2.12, 0.36), (2.04, 0.23), (1.60, 0.19), (0.0, 0.18),
    (-1.60, 0.19), (-2.02, 0.23),
)  # fmt: skip
"""(x, z) of the lower body."""
CABIN = (
    (-1.74, 0.90), (-1.50, 1.04), (-1.16, 1.25), (-0.86, 1.375), (-0.52, 1.432), (-0.10, 1.45), (0.22, 1.425), (0.50, 1.335),
    (0.80, 1.165), (1.16, 0.90), (0.60, 0.80), (-1.20, 0.80),
)  # fmt: skip
"""(x, z) of the glasshouse with its roof."""
ABOVE = (
    (2.14, 0.0), (2.10, 0.38), (1.98, 0.66), (1.74, 0.815), (1.30, 0.875), (0.60, 0.89), (-0.70, 0.89), (-1.40, 0.88), (-1.82, 0.83),
    (-2.06, 0.69), (-2.17, 0.42), (-2.20, 0.0),
)  # fmt: skip
"""(x, y) of the left half of the lower body, seen from above."""
FRONT_GLASS, REAR_GLASS = ((0.28, 0.60), (1.02, 0.985)), ((-0.88, 0.58), (-1.58, 1.01))
SIDE_GLASS = (
    ((0.80, 0.985), (0.52, 1.17), (0.22, 1.335), (0.02, 1.368), (-0.22, 1.372), (-0.22, 0.992)),
    ((-0.29, 0.992), (-0.29, 1.372), (-0.56, 1.352), (-0.85, 1.28), (-1.14, 1.12), (-1.27, 1.02)),
)
"""(x, z) of the windows of the front and the rear door."""
DOORS_X = (0.86, -0.255, -1.05)
GLASS, TRIM, CHROME, TYRE, RIM, DEEP = "#0b0e12", "#141516", "#c9ccd0", "#17181a", "#b4b8bd", "#26282b"


def body_shape(car: Car) -> "Shape":
    """The shell, in metres on the ground below the middle of the wheelbase: without wheels, its arches open."""
    from .. import sculpt

    lower = _side(SIDE, 2.0)
    outline = [*ABOVE, *((x, -y) for x, y in ABOVE[-2:0:-1])]
    seen_from_above = sculpt.extruded(outline, 4.0, smooth=True)
    lower = sculpt.intersection(lower, seen_from_above, radius=0.10)
    cabin = _side(CABIN, 1.72)
    for side in (1.0, -1.0):  # the windows lean inwards
        cabin = sculpt.intersection(cabin, sculpt.half_space((0.0, 0.925 * side, 0.38), 1.106), radius=0.07)
    # Shoulders: the flanks are fullest at the height of the door handles.
    for side in (1.0, -1.0):
        lower = sculpt.intersection(lower, sculpt.half_space((0.0, 0.985 * side, -0.17), 0.80), radius=0.12)
    shell = sculpt.union(lower, cabin, radius=0.05)
    mirrors = sculpt.ellipsoid((0.11, 0.19, 0.13)).rotate(-12, "z").translate(0.70, 0.93, 1.01).mirror("y")
    shell = sculpt.union(shell, mirrors, radius=0.015)
    base = DRAWN_AS
    stretched = shell.scale(
        (car.wheelbase_m / base.wheelbase_m, car.width_m / base.width_m, car.height_m / base.height_m)
    )
    return sculpt.difference(stretched, arches(car), radius=0.025)


def arches(car: Car) -> "Shape":
    """Where the wheels stand and turn."""
    from .. import sculpt

    room, depth = 2 * (car.wheel_radius_m + 0.055), car.tyre_width_m + 0.24
    found = []
    for corner in CORNERS:
        x, y = car.place(corner)
        outwards = (0.12 if y > 0 else -0.12) / 2
        found.append(sculpt.cylinder(room, depth).rotate(90, "x").translate(x, y + outwards, car.wheel_radius_m + 0.01))
    return sculpt.union(*found)


def _side(outline: "tuple[tuple[float, float], ...]", width: float) -> "Shape":
    """An outline of (x, z) as wide as that."""
    from .. import sculpt

    return sculpt.extruded(outline, width, smooth=True).rotate(90, "x")


class BodyPaint:
    """The paint of a shell: colour, glass, lamps, seams, trim; a function of points and normals (`skills/sculpting`)."""

    def __init__(self, car: Car, look: str) -> None:
        self._car, self._look = car, look

    def __call__(self, points: "np.ndarray", normals: "np.ndarray") -> "tuple[np.ndarray, np.ndarray]":
        """((N, 3) colours, (N,) roughness)."""
        import numpy as np

        from .. import sculpt
        from ..sculpt import brushes

        car, base = self._car, DRAWN_AS
        own = points / (car.wheelbase_m / base.wheelbase_m, car.width_m / base.width_m, car.height_m / base.height_m)
        x, y, z = own.T
        left = np.abs(y)
        rgb, rough = brushes.plain(points, self._look), np.full(len(points), 0.22)

        def lay(mask: "np.ndarray", colour: str, roughness: float) -> None:
            nonlocal rgb, rough
            rgb = brushes.over(rgb, colour, mask)
            rough = rough * (1 - mask) + roughness * mask

        flank = brushes.step(np.abs(normals[:, 1]), 0.55, 0.1)
        for at in DOORS_X:
            seam = 1 - brushes.step(np.abs(x - at - 0.10 * (z - 0.6) * (at > 0)), 0.006, 0.004)
            lay(seam * flank * brushes.step(z, 0.27, 0.005) * (1 - brushes.step(z, 0.955, 0.005)), TRIM, 0.6)
        for at in (-0.12, -0.93):
            handle = brushes.within(sculpt.box((0.17, 3.0, 0.028), 0.012).translate(at, 0, 0.845), 0.003)(own)
            lay(handle * flank, CHROME, 0.2)
        lay(1 - brushes.step(z, 0.265, 0.012), TRIM, 0.7)  # sills and the lower edge of the bumpers
        for window in SIDE_GLASS:
            pane = brushes.within(sculpt.extruded(window, 4.0, rounded=0.02).rotate(90, "x"), 0.004)(own)
            lay(pane * brushes.step(np.abs(normals[:, 1]), 0.35, 0.1), GLASS, 0.10)
        for ((top, half_top), (bottom, half_bottom)), sign in ((FRONT_GLASS, 1.0), (REAR_GLASS, -1.0)):
            share = np.clip((x - top) / (bottom - top), 0, 1)
            wide = 1 - brushes.step(left, half_top + share * (half_bottom - half_top) - 0.40 * share - 0.02, 0.006)
            long = brushes.step(sign * (x - top), 0.0, 0.006) * (1 - brushes.step(sign * (x - bottom), 0.0, 0.006))
            lay(wide * long * brushes.step(z, 0.96, 0.01) * brushes.step(sign * normals[:, 0], 0.15, 0.08), GLASS, 0.10)
        ahead, behind = brushes.step(normals[:, 0], 0.15, 0.1), brushes.step(-normals[:, 0], 0.2, 0.1)
        lamp = _patch(left, 0.40, 0.80) * _patch(z - 0.10 * (left - 0.6), 0.60, 0.70) * (x > 1.5)
        lay(lamp, "#e9eef3", 0.05)
        lay(lamp * (1 - brushes.step(np.abs(left - 0.66), 0.045, 0.01)), "#5b6670", 0.05)
        lay(_patch(left, -1.0, 0.34) * _patch(z, 0.535, 0.665) * ahead * (x > 1.8), TRIM, 0.35)
        lay(_patch(left, -1.0, 0.62) * _patch(z, 0.30, 0.43) * ahead * (x > 1.8), TRIM, 0.6)
        lay(_patch(left, 0.40, 0.90) * _patch(z, 0.735, 0.865) * (x < -1.85), "#4a0407", 0.06)
        lay(_patch(left, 0.44, 0.60) * _patch(z, 0.765, 0.835) * (x < -1.85), "#d9c9c4", 0.06)
        lay(_patch(left, -1.0, 0.70) * _patch(z, 0.30, 0.39) * behind * (x < -1.8), TRIM, 0.6)
        for front in (True, False):
            plate = _patch(left, -1.0, 0.26) * (_patch(z, 0.44, 0.53) if front else _patch(z, 0.60, 0.70))
            lay(plate * (ahead * (x > 1.8) if front else behind * (x < -1.8)), "#eceae2", 0.4)
        inside = brushes.within(arches(car).grow(0.012), 0.004)(points)
        lay(inside, "#0a0a0b", 0.9)
        return rgb, rough


def _patch(along: "np.ndarray", low: float, high: float) -> "np.ndarray":
    """A mask between two values."""
    from ..sculpt import brushes

    return brushes.step(along, low, 0.006) * (1 - brushes.step(along, high, 0.006))


def wheel_shape(car: OnAxles) -> "Shape":
    """A tyre on a rim of seven spokes, its axle along y, in the wheel's frame."""
    from .. import sculpt

    radius, half = car.wheel_radius_m, car.tyre_width_m / 2
    rim, hub = 0.70 * radius, 0.20 * radius
    outside = (
        (0, -0.88), (0.74, -0.88), (0.88, -1), (0.975, -0.8), (1, -0.5), (1, 0.5), (0.975, 0.8), (0.88, 1), (0.74, 0.88), (0, 0.88),
    )  # fmt: skip
    solid = sculpt.revolved([(r * radius, z * half) for r, z in outside])
    tyre = sculpt.difference(solid, sculpt.cylinder(2 * rim, 4 * half))
    barrel = sculpt.difference(sculpt.cylinder(2 * rim + 0.01, 1.7 * half), sculpt.cylinder(2 * rim - 0.03, 4 * half))
    spoke = sculpt.box((rim - hub + 0.02, 0.045, 0.03), 0.008).translate((rim + hub) / 2, 0, 0.55 * half)
    spokes = sculpt.radial(spoke, 7) | sculpt.cylinder(2 * hub + 0.03, 0.05, 0.01).translate(z=0.55 * half)
    disc = sculpt.cylinder(2 * rim, 0.03)
    return sculpt.union(tyre, barrel, spokes | spokes.mirrored("z"), disc).rotate(90, "x")


class WheelPaint:
    """Rubber outside, a rim inside, dark between its spokes."""

    def __init__(self, car: OnAxles, wide: float = 1.0) -> None:
        self._rim, self._depth = 0.71 * car.wheel_radius_m, 0.17 * car.tyre_width_m * wide

    def __call__(self, points: "np.ndarray", normals: "np.ndarray") -> "tuple[np.ndarray, np.ndarray]":  # noqa: ARG002
        """((N, 3) colours, (N,) roughness)."""
        import numpy as np

        from ..sculpt import brushes

        tyre = brushes.step(np.hypot(points[:, 0], points[:, 2]), self._rim, 0.004)
        deep = 1 - brushes.step(np.abs(points[:, 1]), self._depth, 0.003)  # behind the spokes: disc and dark
        rgb = brushes.over(brushes.plain(points, RIM), DEEP, deep)
        return brushes.over(rgb, TYRE, tyre), 0.3 + 0.3 * deep * (1 - tyre) + 0.55 * tyre


def dress_car(spec: "mujoco.MjSpec", car: Car, name: str, look: str, cells: int = 200) -> None:
    """Draw body and wheels in place of the boxes and ellipsoids, which go on to collide, unseen."""
    from .. import sculpt

    body, wheel = body_shape(car), wheel_shape(car)
    make: dict[str, Any] = {"paint": BodyPaint(car, look), "cells": cells, "triangles": 24_000, "texels": 1024}
    solid = sculpt.made(body, hulls="convex", **make)
    x, y, z = ((solid.low + solid.high) / 2).tolist()
    sculpt.dress(spec, name, body, pos=(x, y, z - car.wheel_radius_m), **make)
    for corner in CORNERS:
        sculpt.dress(
            spec, f"{name}_{corner}_wheel", wheel, paint=WheelPaint(car), cells=90, triangles=9_000, texels=256
        )

"""Paint by regions, and the dressing that bodies of vehicles have in common: a shell on the chassis, a tyre on each wheel."""

from typing import TYPE_CHECKING, Any

from .car_body import WheelPaint, wheel_shape

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..sculpt import Shape
    from .axles import OnAxles

GLASS, TRIM, RUBBER, STEEL = "#0b0e12", "#141516", "#17181a", "#5c6166"
WHITE_LAMP, RED_LAMP, AMBER_LAMP = "#e9eef3", "#5a060a", "#d98a17"


class Regions:
    """One colour, and others where points lie in shapes, later ones above."""

    def __init__(self, look: str, rough: float, regions: "tuple[tuple[Shape, str, float], ...]") -> None:
        self._look, self._rough, self._regions = look, rough, regions

    def __call__(self, points: "np.ndarray", normals: "np.ndarray") -> "tuple[np.ndarray, np.ndarray]":  # noqa: ARG002
        """((N, 3) colours, (N,) roughness)."""
        import numpy as np

        from ..sculpt import brushes

        rgb, rough = brushes.plain(points, self._look), np.full(len(points), self._rough)
        for shape, colour, roughness in self._regions:
            mask = brushes.within(shape, 0.004)(points)
            rgb, rough = brushes.over(rgb, colour, mask), rough * (1 - mask) + roughness * mask
        return rgb, rough


def dress_body(
    spec: "mujoco.MjSpec",
    body: str,
    shape: "Shape",
    paint: Regions,
    origin: tuple[float, float, float],
    cells: int = 170,
) -> None:
    """Draw a shape on a body in place of its boxes; `origin` is the body's, in the shape's coordinates, m."""
    from .. import sculpt

    make: dict[str, Any] = {"paint": paint, "cells": cells, "triangles": 20_000, "texels": 1024}
    solid = sculpt.made(shape, hulls="convex", **make)
    x, y, z = ((solid.low + solid.high) / 2).tolist()
    sculpt.dress(spec, body, shape, pos=(x - origin[0], y - origin[1], z - origin[2]), **make)


def dress_tyres(spec: "mujoco.MjSpec", vehicle: "OnAxles", name: str) -> None:
    """Draw the tyres, two side by side where an axle's are twin."""
    from .. import sculpt

    single = wheel_shape(vehicle)
    side = vehicle.tyre_width_m / 2
    twin = single.translate(y=side) | single.translate(y=-side)
    for axle in vehicle.axles:
        paint = WheelPaint(vehicle, 2.0 if axle.twin else 1.0)
        for corner in axle.corners:
            shape = twin if axle.twin else single
            sculpt.dress(spec, f"{name}_{corner}_wheel", shape, paint=paint, cells=90, triangles=9_000, texels=256)


def patch(x: float, y: float, z: float, size: tuple[float, float, float]) -> "Shape":
    """A box in which a colour lies, by its middle."""
    from .. import sculpt

    return sculpt.box(size).translate(x, y, z)


def wheel_rooms(vehicle: "OnAxles") -> "Shape":
    """Where the wheels stand and turn."""
    from .. import sculpt

    room, found = 2 * (vehicle.wheel_radius_m + 0.06), []
    for axle in vehicle.axles:
        depth = vehicle.wheel_width(axle) + 0.3
        for corner in axle.corners:
            x, y = vehicle.place(corner)
            shape = sculpt.cylinder(room, depth).rotate(90, "x")
            found.append(shape.translate(x, y + (0.08 if y > 0 else -0.08), vehicle.wheel_radius_m))
    return sculpt.union(*found)

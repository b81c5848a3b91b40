"""Vehicles and roads in the pre-roll's world: wheels, and the surface that they stand on (runs in the pre-roll process).

The box around a road that climbs is full of what drives on it, and the box around a car reaches into the slope that its wheels touch.
"""

from math import cos, hypot, radians, sin
from typing import Any

NEAR_M = 60.0
"""So far from the nearest of the other objects a road has ground."""


def vehicle(spec: Any, row: dict[str, Any]) -> None:
    """Add a vehicle of a request as it is built, undressed: its wheels on the underside of the box that is placed."""
    import mujoco

    from worldkit import vehicles

    made = getattr(vehicles, row["vehicle"]["kind"].capitalize())(**row["vehicle"]["numbers"])
    (x, y, z), turn = row["position"], radians(row["deg_z"])
    ground = (x - made.middle_x_m * cos(turn), y - made.middle_x_m * sin(turn), z - made.extents[2] / 2)
    body = vehicles.add(spec, made, name=row["name"], pos=ground, yaw_deg=row["deg_z"], look=None)
    if row["fixed"]:
        for joint in [joint for joint in body.joints if joint.type == mujoco.mjtJoint.mjJNT_FREE]:
            spec.delete(joint)


def road(spec: Any, row: dict[str, Any], objects: list[dict[str, Any]], surface: dict[str, Any] | None) -> None:
    """Add a road of a request, whose box's middle is placed; it has ground where anything else of the `objects` is near."""
    from worldkit import roads
    from worldkit.roads.road_tiles import TILE_M, tiles

    made = roads.read(row["road"]["file"])
    low, high = roads.box(made)
    (x, y, z), turn = row["position"], radians(row["deg_z"])
    c, s = cos(turn), sin(turn)
    u, v, w = ((a + b) / 2 for a, b in zip(low, high, strict=True))
    origin = (x - c * u + s * v, y - s * u - c * v, z - w)
    others = [
        (c * (a - origin[0]) + s * (b - origin[1]), c * (b - origin[1]) - s * (a - origin[0]), hypot(*one["size"][:2]) / 2)
        for one in objects
        if one is not row
        for a, b, _ in [one["position"]]
    ]  # fmt: skip

    def near(left: float, below: float) -> bool:
        return any(
            hypot(max(left - a, 0.0, a - left - TILE_M), max(below - b, 0.0, b - below - TILE_M)) <= reach + NEAR_M
            for a, b, reach in others
        )

    every = tiles(made)
    some = [tile for tile in every if near(*tile)] or every[:1]
    roads.add(spec, made, name=row["name"], pos=origin, yaw_deg=row["deg_z"], surface=surface, places=some, drawn=False)

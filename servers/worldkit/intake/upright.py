"""How a file's axes and unit become ours: z up, +x the front, metres."""

from typing import Any

import numpy as np

from ..errors import IntakeError
from .told_frames import NOTHING, Told

Array = np.ndarray
AXES = {f"{sign}{axis}": np.eye(3)["xyz".index(axis)] * (1 if sign == "+" else -1) for axis in "xyz" for sign in "+-"}
USUAL = {".glb": ("+y", "+z"), ".obj": ("+y", "+z")}
"""Which way is up and which the front where nobody says: as glTF prescribes it, and most programs write OBJ."""
OTHERWISE = ("+z", "+x")
UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "in": 0.0254, "ft": 0.3048}
LEAST_M, MOST_M = 3e-4, 200.0
METRIC = (".glb",)
"""Formats whose unit is the metre by their standard."""
APART = 3.0
"""A metric file that is so many times off its category's range is scaled to it all the same."""


def turn(suffix: str, up: str, front: str, told: Told = NOTHING) -> tuple[Array, list[str]]:
    """The rotation (3, 3) from a file's axes to ours, and what was assumed for it.

    Args:
        suffix: the file's.
        up, front: the file's axes that are up and front, such as `+y`; empty for what it says, else what its format has.
        told: what the file says.

    Raises:
        IntakeError: no such axis, or both are along one line.
    """
    usual_up, usual_front = (told.up, told.front) if told.up else USUAL.get(suffix, OTHERWISE)
    assumed = [] if up or told.up else [f"up is {usual_up}, as {suffix[1:].upper()} files mostly have it"]
    up, front = up or usual_up, front or usual_front
    for name in (up, front):
        if name not in AXES:
            raise IntakeError("no_axis", f"{name!r} is no axis", "", f"name one of {', '.join(AXES)}")
    z, x = AXES[up], AXES[front]
    if abs(z @ x) > 0.5:  # up was given, and is the front that is usual: any other will do
        if front != usual_front:
            raise IntakeError("no_axis", f"up {up} and front {front} are along one line", "", "give a front across it")
        x = next(axis for name, axis in AXES.items() if name[0] == "+" and abs(axis @ z) < 0.5)
    return np.stack([x, np.cross(z, x), z]), assumed


def scale(suffix: str, extents: Array, asked: dict[str, Any], told: Told = NOTHING) -> tuple[Array, str, list[str]]:
    """The factors (3,) that make it metric, who says so, and what was assumed.

    Args:
        suffix: the file's.
        extents: along x, y, z once it is upright, in the file's unit.
        asked: `extents` in m, or `height` in m, or `units`, or `reference` with low and high of the category's heights in m, and its `name`.
        told: what the file says.

    Raises:
        IntakeError: nothing tells its size, or it is of no size that a thing has.
    """
    tall = float(extents[2])
    assumed: list[str] = []
    if asked.get("extents") and not asked.get("height"):
        return (
            _checked(np.asarray(asked["extents"], float) / np.maximum(extents, 1e-12), extents),
            "its library's",
            assumed,
        )
    if asked.get("height"):
        factor, source = float(asked["height"]) / tall, "stated by whoever added it"
    elif asked.get("units"):
        factor, source = UNITS[asked["units"]], f"the file's, in {asked['units']}"
    else:
        factor, source, assumed = _unstated(suffix, tall, asked.get("reference"), told)
    return _checked(np.full(3, factor), extents), source, assumed


def _checked(factor: Array, extents: Array) -> Array:
    """Factors that give a size that a thing has."""
    size = extents * factor
    if not (size >= LEAST_M / 10).all() or not (size <= MOST_M).all() or not size[2] >= LEAST_M:
        told = " x ".join(f"{side:.3g}" for side in size)
        raise IntakeError(
            "implausible_size", f"it would measure {told} m", "", "give its --height in metres, or its --units"
        )
    return factor


def _unstated(suffix: str, tall: float, reference: dict[str, Any] | None, told: Told) -> tuple[float, str, list[str]]:
    unit = 1.0 if suffix in METRIC else told.unit_m
    said = (
        "the file's, in m as glTF prescribes"
        if suffix in METRIC
        else f"the file's, which says that its unit is {unit:g} m"
    )
    if reference is None:
        if unit:
            return unit, said, []
        raise IntakeError(
            "unknown_size", f"{suffix[1:].upper()} files tell no unit, and nothing else tells its size", "",
            "give its --height in metres, its --units (m, cm, mm, in, ft), or a --category whose size is known (chair, bowl, car …)",
        )  # fmt: skip
    low, high = float(reference["low"]), float(reference["high"])
    if unit and low / APART <= tall * unit <= high * APART:
        return unit, said, []
    usual = float(np.sqrt(low * high))
    said = f"the middle of the heights of a {reference['name']}, {low:g} to {high:g} m"
    return usual / tall, said, [f"it is {usual:.3g} m high: {said}"]

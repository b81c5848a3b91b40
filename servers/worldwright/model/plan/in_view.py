"""How large what a plan speaks of should be in its pictures, and where a camera has to stand for that."""

from collections.abc import Iterator, Mapping
from typing import Any

from .committed import Plan
from .scene_objects import Vec3

SHARE = 1 / 40
"""Of a picture's width: what is shorter than this in every planned picture cannot be watched."""


def mentioned(value: Any) -> set[str]:
    """Every text anywhere in the arguments of expectations, as these are the names they speak of."""
    if isinstance(value, str):
        return {value}
    if isinstance(value, dict):
        return {name for inner in value.values() for name in mentioned(inner)}
    if isinstance(value, (list, tuple)):
        return {name for inner in value for name in mentioned(inner)}
    return set()


def spoken_of(plan: Plan) -> tuple[str, ...]:
    """The objects that should move or that a claim is about, in plan order."""
    said = {*plan.movers(), *mentioned([objective.expect for objective in plan.objectives])}
    return tuple(name for name in plan.object_names() if name in said)


def nearer(eye: Vec3, thing: Vec3, pixels: float, width: int) -> Vec3:
    """Where a camera at `eye`, m, would see a thing a tenth larger than it has to be, on the line between them."""
    share = min(1.0, pixels / (1.1 * width * SHARE))
    x, y, z = (round(t + (e - t) * share, 3) for e, t in zip(eye, thing, strict=True))
    return (x, y, z)


def told(name: str, pixels: float, camera: str, width: int) -> str:
    """How large a thing is where it is largest."""
    return f"`{name}` is {pixels:.0f} pixels long in camera {camera}, {pixels / width:.1%} of the picture's width"


def alike(plan: Plan) -> dict[str, str]:
    """The name of the row of the plan that says what a thing is, by the thing's own name: copies have one in common."""
    said = {**plan.families, **{row.name: row.instances for row in plan.assets}}
    return {name: name for name in plan.object_names()} | {copy: row for row, names in said.items() for copy in names}


def once(plan: Plan, lengths: Mapping[str, float]) -> Iterator[tuple[str, str]]:
    """Of things that are too small, one of each row of the plan, the smallest, and what its message says of the others.

    Args:
        plan: whose objects they are.
        lengths: how long each is in the picture that shows it largest, by its name.
    """
    rows, groups = alike(plan), dict[str, list[str]]()
    for name in sorted(lengths, key=lambda name: lengths[name]):
        groups.setdefault(rows.get(name, name), []).append(name)
    for row, names in groups.items():
        others = f" (and {len(names) - 1} more of `{row}` are too small)" if len(names) > 1 else ""
        yield names[0], others


def remedy(name: str, camera: str, eye: Vec3, thing: Vec3, pixels: float, width: int, *, follows: bool = False) -> str:
    """Which camera to move, and to where; of one that follows, which stands still once it has a place, only what to add.

    Args:
        name: the thing.
        camera: the one that shows it largest.
        eye: where that stands then, m.
        thing: where the thing is then, m.
        pixels: how long it is in that picture.
        width: of the picture, pixels.
        follows: the camera moves with its subjects.
    """
    close = f"name: close_{name}, view: close_up, subjects: [{name}]"
    if follows:
        return f"add `{{{close}, follow: true}}`: camera {camera} follows its subjects, and what it shows besides stays small"
    place = ", ".join(f"{value:g}" for value in nearer(eye, thing, pixels, width))
    aim = ", ".join(f"{value:.3g}" for value in thing)
    return f"move camera {camera} to `position: [{place}]`, `target: [{aim}]`, or add `{{{close}}}`"

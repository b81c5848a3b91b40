"""Section `layout_density`: how full a scene must be, and how much room must stay free.

    scene:      {min_objects, max_objects, min_kinds, area: [x, y], min_fill, max_fill, envelope: [x, y, z]}
    <object>:   {surface, min_objects, max_objects, min_kinds, min_fill, max_fill}          of what rests on it
    clearance:  [{between: [a, b], min_m}, {around: a, min_m, ignoring: [b, …]}]

A kind is a catalog key, or a primitive of one role and size. `fill` is the share of an area that the footprints of what
stands directly on it cover, 0 to 1. Objects on an object count through everything that they carry.
"""

from typing import Any

from pydantic import Field, ValidationError, model_validator

from ..frozen import Frozen

SCENE = "scene"
CLEARANCE = "clearance"
Path = tuple[str | int, ...]


class Target(Frozen):
    """What one surface, or the whole scene, must carry."""

    surface: str | None = None
    """Name of the object's surface; None: its default one."""
    min_objects: int | None = Field(None, ge=0)
    max_objects: int | None = Field(None, ge=0)
    min_kinds: int | None = Field(None, ge=0)
    min_fill: float | None = Field(None, ge=0, le=1)
    max_fill: float | None = Field(None, ge=0, le=1)
    area: tuple[float, float] | None = None
    """Extents in metres that the fill of the scene's ground refers to; None: those of everything placed."""
    envelope: tuple[float, float, float] | None = None
    """Extents in metres, on the ground and around the origin, that nothing may reach out of."""


class Clearance(Frozen):
    """A free distance in metres: between two objects, or around one."""

    min_m: float = Field(gt=0)
    between: tuple[str, str] | None = None
    around: str | None = None
    ignoring: tuple[str, ...] = ()
    """Objects that may be nearer, e.g. the chairs of a table; what rests on it never counts."""

    @model_validator(mode="after")
    def _one(self) -> "Clearance":
        if (self.between is None) == (self.around is None):
            raise ValueError("needs either `between: [a, b]` or `around: a`")
        return self


def read(section: dict[str, Any]) -> tuple[dict[str, Target], list[tuple[int, Clearance]], list[tuple[Path, str]]]:
    """The targets by name, the clearances with their index, and (path, cause) of what makes no sense."""
    targets: dict[str, Target] = {}
    clearances: list[tuple[int, Clearance]] = []
    wrong: list[tuple[Path, str]] = []
    for name, value in section.items():
        rows = list(enumerate(value)) if name == CLEARANCE and isinstance(value, list | tuple) else [(None, value)]
        for index, row in rows:
            path: Path = ("layout_density", name) if index is None else ("layout_density", name, index)
            try:
                if name == CLEARANCE:
                    clearances.append((index or 0, Clearance.model_validate(row)))
                else:
                    targets[name] = Target.model_validate(row)
            except ValidationError as error:
                first = error.errors()[0]
                where = ".".join(str(part) for part in first["loc"])
                wrong.append((path, f"{where + ': ' if where else ''}{first['msg'].removeprefix('Value error, ')}"))
    return targets, clearances, wrong

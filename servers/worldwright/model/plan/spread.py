"""How the copies of one object stand: in a row, a grid, a ring or a helix, as arithmetic on their number."""

import math
from typing import Any, Literal, NamedTuple

from pydantic import Field, model_validator

from ..frozen import Frozen
from .object_parts import Vec3

NEEDS = {"row": ("step",), "grid": ("step", "columns"), "ring": ("radius",), "helix": ("radius", "step_deg", "rise")}
MAY = {"row": ("facing",), "grid": ("rows", "facing"), "ring": ("start_deg", "arc_deg", "facing"), "helix": ("start_deg", "facing")}  # fmt: skip


class Stand(NamedTuple):
    """Where one copy stands from the place that the row gives, m, and which way it faces, degrees; None: as it would."""

    x: float
    y: float
    z: float
    deg_z: float | None


class Spread(Frozen):
    """The pattern of the copies of a row's subject, around the place that the row gives."""

    pattern: Literal["row", "grid", "ring", "helix"]
    step: Vec3 | None = None
    """Metres along x, y, z: of a row from each to the next, the first at the place; of a grid between columns (x), rows (y)
    and layers (z), the middle of the lowest layer at the place."""
    columns: int | None = Field(None, ge=1)
    """Of a grid, along x."""
    rows: int | None = Field(None, ge=1)
    """Of a grid, along y; what is more goes into further layers. None: as many as it takes."""
    radius: float | None = Field(None, gt=0)
    """Metres, of a ring or a helix about the place."""
    start_deg: float | None = None
    """Where the first one stands, degrees counter-clockwise from +x; None: 0."""
    arc_deg: float | None = Field(None, gt=0, le=360)
    """Of a ring that is open, from the first to the last; None: all round, the last beside the first."""
    step_deg: float | None = None
    """Of a helix, from each to the next."""
    rise: float | None = None
    """Metres, of a helix, from each to the next."""
    facing: Literal["out", "in", "along"] | None = None
    """Where each one's front points: away from the middle, to it, or on to the next; None: as other rows say."""

    @model_validator(mode="after")
    def _whole(self) -> "Spread":
        needed, may = NEEDS[self.pattern], MAY[self.pattern]
        if missing := [key for key in needed if getattr(self, key) is None]:
            raise ValueError(f"a {self.pattern} needs {', '.join(missing)}")
        known = {"pattern", *needed, *may}
        if others := sorted(key for key, value in self if value is not None and key not in known):
            raise ValueError(f"a {self.pattern} has no {', '.join(others)}; it may have {', '.join((*needed, *may))}")
        if self.step is not None and not any(self.step):
            raise ValueError("`step` is nil: the copies would stand in one place")
        if self.facing and self.pattern in ("row", "grid") and self.facing != "along":
            raise ValueError(f"what stands in a {self.pattern} can face `along` it; it has no middle to face")
        return self

    def stands(self, count: int) -> list[Stand]:
        """Where each of `count` copies stands, in their order."""
        return [self._stand(k, count) for k in range(count)]

    def _stand(self, k: int, count: int) -> Stand:
        if self.pattern in ("row", "grid"):
            dx, dy, dz = self.step or (0.0, 0.0, 0.0)
            way = math.degrees(math.atan2(dy, dx)) if self.pattern == "row" else 0.0
            facing = way if self.facing else None
            if self.pattern == "row":
                return Stand(k * dx, k * dy, k * dz, facing)
            columns = self.columns or 1
            rows = self.rows or math.ceil(count / columns)
            column, row, layer = k % columns, k // columns % rows, k // (columns * rows)
            return Stand((column - (columns - 1) / 2) * dx, (row - (rows - 1) / 2) * dy, layer * dz, facing)
        between = self.step_deg if self.step_deg is not None else self._between(count)
        turn = (self.start_deg or 0.0) + k * between
        radius, angle = self.radius or 0.0, math.radians(turn)
        ahead = 90.0 if between >= 0 else -90.0
        front = {None: None, "out": turn, "in": turn + 180.0, "along": turn + ahead}[self.facing]
        rise = k * (self.rise or 0.0)
        return Stand(
            radius * math.cos(angle), radius * math.sin(angle), rise, None if front is None else _wrapped(front)
        )

    def _between(self, count: int) -> float:
        return 360.0 / count if self.arc_deg is None else self.arc_deg / max(count - 1, 1)


def moved(predicate: str, params: dict[str, Any], stand: Stand) -> dict[str, Any] | None:
    """The parameters of a row for the copy that stands there; None where the predicate gives no place to spread about."""
    if predicate == "PLACE-ON-BASE":
        found = {**params, "x": params.get("x", 0.0) + stand.x, "y": params.get("y", 0.0) + stand.y}
    elif predicate in ("PLACE-ON", "PLACE-IN"):
        across, along = params.get("offset") or (0.0, 0.0)
        found = {**params, "offset": [across + stand.x, along + stand.y]}
    else:
        return None
    return {**found, "gap": params.get("gap", 0.0) + stand.z} if stand.z else found


def _wrapped(deg: float) -> float:
    turned = (deg + 180.0) % 360.0 - 180.0
    return 180.0 if turned == -180.0 else turned

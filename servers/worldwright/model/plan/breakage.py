"""What a plan says of an object that can break: into how many pieces, where, and at which stress; one row for all of them.

In a plan that is read, its pieces `name_1` … `name_N` stand in its place, as the copies of an object with a `count` do: each with the
size of its own box, its share of the mass and its own place. `worldkit.breaking` cuts them; a program that says the same numbers
gets the same pieces.
"""

from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

from pydantic import Field, model_validator

from ..frozen import Frozen
from .object_parts import Vec3

if TYPE_CHECKING:
    from worldkit.breaking import Fragments

MAKERS = {"box": "plate", "cylinder": "rod", "cone": "rod", "lathe": "vessel"}
"""The function of `worldkit.breaking` that cuts each primitive; a box with `columns` is `grooved`."""


class Breaks(Frozen):
    """How an object breaks."""

    pieces: int = Field(ge=2, le=400)
    """So many, called `name_1` … `name_N`."""
    strength: str
    """The constant (Pa) that is the stress at which it breaks."""
    seed: int = 0
    """Of the pattern."""
    struck_at: Vec3 | None = None
    """Of a box: from its middle, m; cracks then run out from there and round it, as in glass."""
    skew: float = Field(0.5, ge=0, le=1)
    """Of a rod: how aslant the cracks run across it."""
    columns: int | None = Field(None, ge=1)
    """Of a box with grooves from above, as chocolate has: so many blocks along x, `pieces` over that along y."""
    groove: float | None = Field(None, gt=0)
    """Metres, of such a box: how deep the grooves are."""
    held: dict[str, tuple[Vec3, ...]] = {}
    """What holds it by its outer faces: an object that is there before, or `world`; directions that those faces look into as it stands
    (after `deg_x` and `deg_y`, before `yaw_deg`)."""
    inside: str | None = None
    """Look of the faces that it breaks along; None: its own."""

    @model_validator(mode="after")
    def _grooved(self) -> "Breaks":
        if (self.columns is None) != (self.groove is None):
            raise ValueError("`columns` and `groove` go together: so many blocks along x, and how deep the grooves are")
        if self.columns is not None and self.pieces % self.columns:
            raise ValueError(f"{self.pieces} pieces do not stand in {self.columns} columns")
        return self

    def call(self, row: Any) -> tuple[str, tuple[Any, ...], dict[str, Any]]:
        """The function of `worldkit.breaking`, and its arguments, for a scene object.

        Raises:
            ValueError: nothing cuts such an object.
        """
        maker = MAKERS.get(row.primitive)
        if maker is None:
            raise ValueError(f"a {row.primitive} cannot break: {', '.join(MAKERS)} can")
        x, _, z = row.size
        if self.columns is not None and maker == "plate":
            return (
                "grooved",
                (row.size,),
                {"columns": self.columns, "rows": self.pieces // self.columns, "groove": self.groove},
            )
        if maker == "plate":
            blow = {} if self.struck_at is None else {"struck_at": self.struck_at}
            return maker, (row.size,), {"shards": self.pieces, "seed": self.seed, **blow}
        if maker == "rod":
            tip = {"tip": row.top_diameter or x / 20} if row.primitive == "cone" else {}
            return maker, (x, z), {"pieces": self.pieces, "seed": self.seed, "skew": self.skew, **tip}
        if not row.wall_thickness:
            raise ValueError("a lathe that breaks is a vessel: give it `wall_thickness`")
        smooth = {"smooth": row.smooth} if row.smooth else {}
        return maker, (row.profile, row.wall_thickness), {"shards": self.pieces, "seed": self.seed, **smooth}


class Piece(NamedTuple):
    """What a piece of an object that breaks is to the whole."""

    extents: Vec3
    """Of its box after the object's `deg_x`, m."""
    offset: Vec3
    """From the middle of the whole to that of this box, m."""
    low_m: float
    """How far its lowest point lies above that of the whole."""
    share: float
    """Of the mass."""
    volume: float
    """m^3."""


def pieces(row: Any) -> list[Piece]:
    """The pieces of a scene object that breaks, in their order.

    Raises:
        ValueError: it cannot be cut so.
    """
    import numpy as np

    if row.fixed or row.visual_only or row.hollow or row.count > 1:
        raise ValueError(
            f"`{row.name}` breaks: it cannot be fixed, hollow, visual_only or counted; `held` says what holds it"
        )
    made = fragments(row).tilted(row.deg_x)
    clouds = [np.concatenate([f.corners for cell in p.cells for f in cell.faces]) for p in made.pieces]
    lowest = min(float(cloud[:, 2].min()) for cloud in clouds)
    found = []
    for piece, cloud in zip(made.pieces, clouds, strict=True):
        low, high = cloud.min(axis=0), cloud.max(axis=0)
        above = round(float(low[2]) - lowest, 9)
        found.append(
            Piece(_rounded(high - low), _rounded((low + high) / 2), above, piece.volume / made.volume, piece.volume)
        )
    return found


def check(plan: Any) -> None:
    """Refuse objects that break at a constant, or are held by an object, that the plan does not have.

    Raises:
        ValueError: the message names it.
    """
    constants, there = plan.simulation_parameters.constants, {"world", *(row.name for row in plan.scene_objects)}
    for row in plan.scene_objects:
        if row.breaks is None:
            continue
        strength = constants.get(row.breaks.strength)
        if strength is None or isinstance(strength.value, tuple) or strength.unit != "Pa" or not strength.value > 0:
            raise ValueError(
                f"`{row.name}` breaks at `{row.breaks.strength}`: add it to simulation_parameters.constants, one number above 0 in Pa"
            )
        if unknown := [name for name in row.breaks.held if name not in there - {row.name}]:
            raise ValueError(
                f"`{row.name}` is held by `{unknown[0]}`: name an object of the plan that stands before it, or `world`"
            )


def as_objects(row: Any) -> list[Any]:
    """The pieces of a scene object as scene objects: boxes of their extents."""
    plain = {
        "primitive": "box",
        "deg_x": 0.0,
        "breaks": None,
        "profile": (),
        "wall_thickness": None,
        "top_diameter": None,
        "smooth": 0,
    }
    return [
        row.model_copy(update={**plain, "name": name, "size": piece.extents})
        for name, piece in zip(row.instances, pieces(row), strict=True)
    ]


def weights(rows: Any, parameters: Any) -> dict[str, float]:
    """Kilograms of each piece of the objects that break: its share of the whole's mass, or volume times density."""
    found = {}
    for row in rows:
        material = parameters.materials.get(row.material or "")
        mass, density = parameters.masses.get(row.name), material.density if material else None
        for name, piece in zip(row.instances, pieces(row), strict=True):
            if mass is not None:
                found[name] = piece.share * mass
            elif density:
                found[name] = piece.volume * density
    return found


def stated_masses(plan: Any) -> dict[str, float]:
    """Kilograms of the objects that break and do not weigh what their material's density says."""
    masses, found = plan.simulation_parameters.masses, {}
    for name, row in plan.broken.items():
        material = plan.simulation_parameters.materials.get(row.material or "")
        total = sum(masses.get(piece, 0.0) for piece in row.instances)
        dense = (material.density or 0.0) * fragments(row).volume if material else 0.0
        if total and abs(total / dense - 1 if dense else 1) > 1e-6:
            found[name] = round(total, 9)
    return found


def fragments(row: Any) -> "Fragments":
    """What a scene object is cut into, in the frame of its box."""
    name, values, keywords = row.breaks.call(row)
    return _made(name, values, tuple(sorted(keywords.items())))


@lru_cache(maxsize=16)
def _made(name: str, values: tuple[Any, ...], keywords: tuple[tuple[str, Any], ...]) -> "Fragments":
    from worldkit import breaking  # it computes with numpy, which no server loads before it must

    made: Fragments = getattr(breaking, name)(*values, **dict(keywords))
    return made


def _rounded(values: Any) -> Vec3:
    x, y, z = (round(float(v), 9) for v in values)
    return (x, y, z)

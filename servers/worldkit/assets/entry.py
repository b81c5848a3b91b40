"""One catalog entry as data: what it is, how big and heavy, how it looks, collides and carries."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

Vec2 = tuple[float, float]
Vec3 = tuple[float, float, float]
Quat = tuple[float, float, float, float]


@dataclass(frozen=True)
class Support:
    """A place where things can rest, in the asset's own axes (z up, +X front), metres.

    z: height of the plane above the asset's lowest point. extents, centre: the free area and where its middle is,
    relative to the centre of the asset's bounding box (x, y). shape: `rectangle`, or `ellipse` inside the extents.
    """

    name: str
    z: float
    z_fraction: float
    extents: Vec2
    centre: Vec2 = (0.0, 0.0)
    shape: str = "rectangle"
    default: bool = False


@dataclass(frozen=True)
class Piece:
    """One convex collision shape at native size, in the frame of the bounding box's centre.

    type: `hull` (mesh in `file`), `sphere` (diameter), `box` (full extents), `cylinder` or `capsule` (diameter; full
    height along its own z, a capsule's caps included). contact: constants that differ from the whole asset's.
    """

    type: str
    name: str
    file: Path | None = None
    pos: Vec3 = (0.0, 0.0, 0.0)
    quat: Quat = (1.0, 0.0, 0.0, 0.0)
    extents: Vec3 | None = None
    diameter: float | None = None
    height: float | None = None
    contact: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Asset:
    """An entry, from whatever source. Lengths are metres, masses kilograms."""

    key: str
    folder: Path
    category: str
    description: str
    source: str
    licence: str
    native_extents: Vec3
    """Bounding box of the mesh as stored; every other length of the entry is at this size too."""
    metric_height: float
    """Typical height in the real world; `metric_height_source` says whose."""
    metric_height_source: str
    mass: float | None
    """At `metric_height`; None when the entry gives a density."""
    density: float | None
    """kg/m^3 of `solid_volume`; None when the entry gives a mass."""
    mass_source: str
    solid_volume: float
    """m^3 of substance at native size (hollows not counted)."""
    inertia_com: Vec3
    """Centre of mass, from the bounding box's centre."""
    inertia_per_kg: tuple[float, ...]
    """Inertia about the centre of mass for one kilogram: xx, yy, zz, xy, xz, yz (m^2)."""
    contact: Mapping[str, float]
    """Arguments for `worldkit.contacts.surface`: friction, restitution, torsional, rolling."""
    contact_source: str
    facing: str
    visual: tuple[tuple[Path, str], ...]
    """Drawn meshes, each with the name of its material."""
    materials: Mapping[str, Mapping[str, Any]]
    looks: Mapping[str, Mapping[str, Mapping[str, Any]]]
    """Named variants: for each the materials that change."""
    default_look: str | None
    recolour: tuple[str, ...]
    """Materials that a look of `worldkit.materials` (or `#rrggbb`) replaces."""
    collision: tuple[Piece, ...]
    supports: tuple[Support, ...]
    """At native size; `support()` scales them."""
    thumbnail: Path
    creator: str = ""
    """Who made it, as its licence wants to be named."""
    mended: tuple[str, ...] = ()
    """What was mended and what was assumed when it was taken in."""
    visual_pos: Vec3 = (0.0, 0.0, 0.0)
    """Where the drawn meshes' own origin lies, from the centre of the bounding box, at native size."""

    @property
    def friction(self) -> float:
        """Sliding friction coefficient."""
        return self.contact["friction"]

    @property
    def restitution(self) -> float | None:
        """Rebound speed over impact speed, or None when the entry does not say."""
        return self.contact.get("restitution")

    @property
    def hulls(self) -> tuple[Path, ...]:
        """The files of the convex collision meshes."""
        return tuple(piece.file for piece in self.collision if piece.file is not None)

    def scale(self, height: float) -> float:
        """The factor that makes the asset `height` metres high."""
        if not 0 < height < float("inf"):
            raise ValueError(f"asset {self.key}: height must be a positive, finite number of metres, got {height}")
        return height / self.native_extents[2]

    def extents(self, height: float | None = None) -> Vec3:
        """Full extents (x, y, z) of the bounding box at `height` (default: `metric_height`)."""
        height = self.metric_height if height is None else height
        s = self.scale(height)
        return (self.native_extents[0] * s, self.native_extents[1] * s, height)

    def mass_at(self, height: float | None = None) -> float:
        """Mass in kilograms at `height` (default: `metric_height`); the substance stays, so it grows with the cube."""
        height = self.metric_height if height is None else height
        if self.mass is not None:
            return self.mass * (height / self.metric_height) ** 3
        assert self.density is not None  # reading.py accepts no entry without one of the two
        return self.density * self.solid_volume * self.scale(height) ** 3

    def support(self, name: str | None = None, *, height: float | None = None) -> Support:
        """Where things rest on this asset when it is `height` metres high (default: `metric_height`).

        Without a name: the entry's default support (the bed of a pool table, the seat of a chair, the inside of a bowl);
        an entry that declares none is supported by its top, `top`: the upper face of its bounding box. An object of height
        `h` resting on it has its centre at `asset_centre_z - height / 2 + support.z + h / 2`.

        Raises:
            KeyError: no support of that name; the message lists the ones there are.
        """
        height = self.metric_height if height is None else height
        s = self.scale(height)
        top = Support("top", self.native_extents[2], 1.0, self.native_extents[:2], default=not self.supports)
        known = {row.name: row for row in (top, *self.supports)}
        if name is None:
            row = next((row for row in self.supports if row.default), known["top"])
        elif name in known:
            row = known[name]
        else:
            raise KeyError(f"asset {self.key} has no support {name!r}; it has: {', '.join(known)}")
        return Support(
            name=row.name,
            z=row.z_fraction * height,
            z_fraction=row.z_fraction,
            extents=(row.extents[0] * s, row.extents[1] * s),
            centre=(row.centre[0] * s, row.centre[1] * s),
            shape=row.shape,
            default=row.default,
        )

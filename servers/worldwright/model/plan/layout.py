"""The resolved layout: every object with its size, its pose and where each number came from."""

from functools import cached_property

from ..finding import Finding
from ..frozen import Frozen
from .committed import Vec3


class PlacedObject(Frozen):
    """One object in the world frame (z up, +X front, metres)."""

    name: str
    kind: str
    """`scene_object` or the catalog key."""
    size: Vec3
    """Full extents along the object's own axes."""
    position: Vec3
    """Centre of its bounding box."""
    deg_z: float = 0.0
    """Yaw, degrees counter-clockwise from +X."""
    round: bool = False
    """Its extents do not change with yaw (spheres, upright cylinders)."""
    fixed: bool = False
    supported_by: str | None = None
    weight: str = ""
    """The mass of a compound, and its centre of mass before its yaw."""
    provenance: tuple[str, ...] = ()
    """The rows and formulas that gave its numbers, first to last."""

    def bounds(self) -> tuple[Vec3, Vec3]:
        """The world AABB (min, max) of the yawed box, metres."""
        from math import cos, radians, sin

        yaw = 0.0 if self.round else radians(self.deg_z)
        c, s = abs(cos(yaw)), abs(sin(yaw))
        half = (
            (self.size[0] * c + self.size[1] * s) / 2,
            (self.size[0] * s + self.size[1] * c) / 2,
            self.size[2] / 2,
        )
        x, y, z = self.position
        return (x - half[0], y - half[1], z - half[2]), (x + half[0], y + half[1], z + half[2])


class PlacedCamera(Frozen):
    """A camera that a relation template placed, world frame, metres."""

    name: str
    template: str
    position: Vec3
    target: Vec3
    """The point it looks at."""
    fovy_deg: float
    """Vertical field of view."""
    provenance: tuple[str, ...] = ()


class Scene(Frozen):
    """The resolved layout (ResolvedPlan): objects in dependency order and the problems found on the way."""

    objects: tuple[PlacedObject, ...] = ()
    cameras: tuple[PlacedCamera, ...] = ()
    """Cameras that geometry_relations place; the others frame what they show when the world runs."""
    findings: tuple[Finding, ...] = ()

    @cached_property
    def _by_name(self) -> dict[str, PlacedObject]:
        return {placed.name: placed for placed in self.objects}

    @property
    def ok(self) -> bool:
        """Whether every object has a pose."""
        return not any(f.severity == "error" for f in self.findings)

    def __getitem__(self, name: str) -> PlacedObject:
        placed = self._by_name.get(name)
        if placed is not None:
            return placed
        raise KeyError(f"{name} is not placed; placed: {', '.join(o.name for o in self.objects)}")

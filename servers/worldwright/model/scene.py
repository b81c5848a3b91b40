"""The resolved layout: every object with its size, its pose and where each number came from."""

from .finding import Finding
from .frozen import Frozen
from .plan import Vec3


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


class Scene(Frozen):
    """The resolved layout (ResolvedPlan): objects in dependency order and the problems found on the way."""

    objects: tuple[PlacedObject, ...] = ()
    findings: tuple[Finding, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether every object has a pose."""
        return not any(f.severity == "error" for f in self.findings)

    def __getitem__(self, name: str) -> PlacedObject:
        for placed in self.objects:
            if placed.name == name:
                return placed
        raise KeyError(f"{name} is not placed; placed: {', '.join(o.name for o in self.objects)}")

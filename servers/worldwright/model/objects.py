"""What a plan is made of: primitives with a size, and catalog assets.

Full extents in metres along the object's own axes (z up, +X front); see `plan` for the frame and for who owns which number.
"""

import math
from typing import Literal

from pydantic import Field, field_validator, model_validator

from .frozen import Frozen

Vec3 = tuple[float, float, float]
Primitive = Literal["box", "sphere", "cylinder", "capsule", "ellipsoid", "plane", "box_container"]


def tilted(primitive: str, size: Vec3, deg_x: float) -> Vec3:
    """Full extents of a primitive's bounding box when it is turned about its own x by `deg_x` degrees.

    With c = |cos deg_x| and s = |sin deg_x|: a box takes size_y c + size_z s along y; an ellipsoid twice the root of
    (r_y c)^2 + (r_z s)^2; a cylinder of radius r takes height s + 2 r c; a capsule (height - 2 r) s + 2 r.
    Along z the same with c and s exchanged.
    """
    x, y, z = size
    turn = deg_x % 180
    c, s = abs(math.cos(math.radians(turn))), math.sin(math.radians(turn))
    c, s = (0.0, 1.0) if turn == 90 else (1.0, 0.0) if turn == 0 else (c, s)
    if primitive == "cylinder":
        return (x, z * s + y * c, z * c + y * s)
    if primitive == "capsule":
        return (x, (z - x) * s + x, (z - x) * c + x)
    if primitive in ("sphere", "ellipsoid"):
        return (x, math.hypot(y * c, z * s), math.hypot(y * s, z * c))
    return (x, y * c + z * s, y * s + z * c)


class SceneObject(Frozen):
    """A procedural primitive or a generated boundary."""

    name: str
    role: str = ""
    construction_source: Literal["procedural_primitive", "generated_boundary"] = "procedural_primitive"
    primitive: Primitive
    size: Vec3
    """Full extents in metres along the object's own x, y, z (never half extents)."""
    wall_thickness: float | None = Field(None, gt=0)
    """Metres, for `box_container` only."""
    deg_x: float = Field(0.0, ge=-180, le=180)
    """Tilt about its own x, degrees, before any yaw: 90 lays a cylinder along y. Not for containers and planes."""
    fixed: bool = False
    dynamic: bool = True
    material: str | None = None
    """Key into `simulation_parameters.materials`."""
    look: str | None = None
    """Name of a worldkit look, e.g. `wood_oak`; or `#rrggbb`."""
    visual_only: str | None = None
    """Why the object is drawn without being simulated, when it is."""
    description: str = ""

    @field_validator("size")
    @classmethod
    def _positive(cls, value: Vec3) -> Vec3:
        if not all(0 < extent < float("inf") for extent in value):
            raise ValueError(f"every extent must be a positive, finite number of metres, got {value}")
        return value

    @model_validator(mode="after")
    def _walled(self) -> "SceneObject":
        if (self.primitive == "box_container") != (self.wall_thickness is not None):
            raise ValueError("`wall_thickness` is needed by a box_container, and only by it")
        if self.deg_x and self.primitive in ("box_container", "plane"):
            raise ValueError(f"a {self.primitive} cannot be tilted: remove `deg_x`")
        return self

    @property
    def extents(self) -> Vec3:
        """Full extents of its bounding box along its own x, y, z after the tilt, metres."""
        return self.size if not self.deg_x else tilted(self.primitive, self.size, self.deg_x)


class AssetRow(Frozen):
    """A catalog mesh or a simulator-native wrapper, `count` times."""

    name: str
    type: Literal["mesh", "mjcf", "urdf", "wrapper"] = "mesh"
    filename: str
    """The exact catalog key."""
    count: int = Field(1, ge=1, le=10_000)
    fixed: bool = False
    is_dynamic: bool = True
    material: str | None = None
    """Key into `simulation_parameters.materials`; None: the catalog's own constants."""
    look: str | None = None

    @property
    def instances(self) -> tuple[str, ...]:
        """Object names: `name` alone, or `name_1` … `name_N`."""
        return (self.name,) if self.count == 1 else tuple(f"{self.name}_{i + 1}" for i in range(self.count))

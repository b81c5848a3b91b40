"""The parts of a compound object: primitives that together are one rigid body, as a plan lists them.

A suitcase with wheels and a handle, a ladder of rails and rungs, a goal of posts. Offsets may be measured from any one
point of the object, such as the middle of its base; the whole is centred on the box around its parts afterwards.
"""

from dataclasses import replace
from typing import Literal

from pydantic import Field, model_validator

from worldkit.parts import Part, Vec3, pieces

from ..frozen import Frozen

Shape = Literal["box", "sphere", "cylinder", "capsule", "ellipsoid", "box_container"]


class Repeat(Frozen):
    """Copies of a part in a row or in a ring."""

    count: int = Field(ge=2, le=200)
    step: Vec3 = (0.0, 0.0, 0.0)
    """Metres from one to the next, in the object's frame."""
    deg_z: float = 0.0
    """Degrees that each is turned further about the object's z, through the point that offsets are measured from."""

    @model_validator(mode="after")
    def _apart(self) -> "Repeat":
        if not any(self.step) and not self.deg_z:
            raise ValueError("copies need a `step` (m) or a turn `deg_z` from one to the next")
        return self


class ObjectPart(Frozen):
    """One primitive of a compound object."""

    name: str
    primitive: Shape
    size: Vec3
    """Full extents in metres along the part's own axes; round ones [d, d, d] or [d, d, height]."""
    offset: Vec3 = (0.0, 0.0, 0.0)
    """Metres to its centre, in the object's frame, from any one point of the object: the whole is centred on its box."""
    deg_x: float = Field(0.0, ge=-360, le=360)
    """Degrees about the object's axes, through the part's centre: first x, then y, then z."""
    deg_y: float = Field(0.0, ge=-360, le=360)
    deg_z: float = Field(0.0, ge=-360, le=360)
    wall_thickness: float | None = Field(None, gt=0)
    """Metres, for `box_container` only."""
    mass: float | None = Field(None, gt=0)
    """kg of each copy; None: its share of `masses`, or its volume times its material's density."""
    material: str | None = None
    """Key into `simulation_parameters.materials`; None: the object's."""
    look: str | None = None
    """None: the object's."""
    visual_only: str | None = None
    """Why the part is drawn without mass and contact, when it is."""
    repeat: Repeat | None = None

    @model_validator(mode="after")
    def _shaped(self) -> "ObjectPart":
        if (self.primitive == "box_container") != (self.wall_thickness is not None):
            raise ValueError("`wall_thickness` is needed by a box_container, and only by it")
        if self.visual_only is not None and self.mass is not None:
            raise ValueError("a part that is only drawn has no mass: remove `mass` or `visual_only`")
        pieces(self.name, self.part())
        return self

    def part(self) -> Part:
        """As `worldkit.parts` takes it, without look and surface."""
        one = Part(
            name=self.name,
            shape="container" if self.primitive == "box_container" else self.primitive,
            size=self.size,
            offset=self.offset,
            deg_x=self.deg_x,
            deg_y=self.deg_y,
            deg_z=self.deg_z,
            wall=self.wall_thickness,
            mass=self.mass,
            visual_only=self.visual_only is not None,
        )
        if self.repeat is None:
            return one
        return replace(one, count=self.repeat.count, step=self.repeat.step, turn_deg=self.repeat.deg_z)

"""Rows of `topology.joints`: what two bodies of a plan may do against each other."""

from typing import Literal

from pydantic import Field, model_validator

from ..frozen import Frozen
from .pairings import Stop
from .scene_objects import Vec3


class Joint(Frozen):
    """A joint between two bodies (multibody plans)."""

    name: str
    type: Literal["hinge", "slide", "ball", "weld"]
    parent: str = "world"
    child: str
    anchor: Vec3 | None = None
    """World-frame metres; None: the child's centre."""
    step: Vec3 = (0.0, 0.0, 0.0)
    """Metres that `anchor` moves from one copy to the next, where the child is an object with a `count`."""
    axis: Vec3 = (0.0, 0.0, 1.0)
    """World-frame direction at the initial pose."""
    range: tuple[float, float] | None = None
    """Degrees for a hinge, metres for a slide."""
    stiffness: float = Field(0.0, ge=0)
    """N·m/rad or N/m."""
    damping: float = Field(0.0, ge=0)
    """N·m·s/rad or N·s/m."""
    frictionloss: float = Field(0.0, ge=0)
    """N·m or N."""
    spring_rest: float = 0.0
    """Degrees or metres."""
    stop: Stop | None = None
    """How the ends of `range` stop it."""
    beside: bool = False
    """Another freedom of a child beside its earlier joint, between the same two bodies; else a second joint closes a loop."""
    built: bool = False
    """Written down from the program's world."""

    @model_validator(mode="after")
    def _stopped(self) -> "Joint":
        if self.stop is not None and self.range is None:
            raise ValueError("`stop` says how the ends of `range` stop it: give the `range`")
        if self.beside and self.type == "weld":
            raise ValueError("a weld leaves no freedom that another joint could stand beside: remove `beside`")
        return self

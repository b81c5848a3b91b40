"""What a plan's `topology` fastens and drives: ropes and springs between bodies, motors and servos on joints."""

from typing import Literal

from pydantic import Field, model_validator

from ..frozen import Frozen
from .scene_objects import Vec3

Side = Literal["center", "top", "bottom", "left", "right", "front", "back"]


class End(Frozen):
    """Where a tendon is fastened: the middle of a side of a body (of its `size`), or a point of the world."""

    body: str = "world"
    at: Side = "center"
    """Of the body itself, turned with it: front is its own +X, left +Y, top +Z, before `deg_x` and the yaw."""
    offset: Vec3 = (0.0, 0.0, 0.0)
    """Metres from there, along the same axes; for `world`, the point itself."""
    step: Vec3 = (0.0, 0.0, 0.0)
    """Metres that `offset` grows from one copy to the next, where an end of the tendon is an object with a `count`."""


class Tendon(Frozen):
    """A rope (no longer than `length`), a spring (`stiffness`) or a rod (`rod`) from one body to another."""

    name: str
    ends: tuple[End, ...] = Field(min_length=2)
    """From first to last; those between are guides it runs through."""
    length: float | None = Field(None, gt=0)
    """Metres: a rope cannot be longer, a spring rests at it; None: as long as it is at the start."""
    slack: float = Field(0.0, ge=0)
    """Metres that a rope is longer than the way at the start; only without `length`."""
    rod: bool = False
    """It keeps the length that it has as laid out, pulled or pushed, turns freely at its two ends, and has no mass."""
    stiffness: float = Field(0.0, ge=0)
    """N/m: makes it a spring, which pulls when longer than `length` and pushes when shorter."""
    damping: float = Field(0.0, ge=0)
    """N·s/m; of a spring only: a slack rope brakes nothing."""
    time_constant: float | None = Field(None, gt=0)
    """s; not of a spring: how soon it holds when it runs taut. None: a rope's 16 ms, which tows quietly (a swing wants four
    steps); a rod's four steps."""
    pretension: float = Field(0.0, ge=0)
    """N with which a spring pulls at the start; instead of `length`."""
    diameter: float = Field(0.01, gt=0)
    """Metres, as it is drawn."""
    look: str | None = None

    @model_validator(mode="after")
    def _one_length(self) -> "Tendon":
        if self.rod and (len(self.ends) > 2 or self.length or self.slack or self.stiffness or self.pretension):
            raise ValueError(
                "a `rod` has two ends and the length between them as laid out: give it no guides, `length`, `slack`, `stiffness` "
                "or `pretension`"
            )
        if self.length is not None and self.slack:
            raise ValueError("give `length` or `slack`, not both: slack is measured from the length at the start")
        if not self.stiffness and self.damping:
            raise ValueError("`damping` needs `stiffness`: a rope or rod only holds, a spring is damped")
        if self.pretension and (not self.stiffness or self.length is not None):
            raise ValueError(
                "`pretension` is a spring's, and stands for its `length`: give one of them, and `stiffness`"
            )
        if self.stiffness and self.time_constant is not None:
            raise ValueError("`time_constant` is a rope's: a spring has its stiffness and damping")
        return self


class Actuator(Frozen):
    """A motor or servo on a joint. What it does is an intervention of kind `control`: declare it too."""

    name: str
    joint: str
    kind: Literal["motor", "position", "velocity", "imported"] = "motor"
    """A motor's control is its force, N or N·m; a servo's, the position (m or rad) or velocity it holds. `imported`: it comes
    with a model file, which owns its gains; those of a file that no row names are left out."""
    control: float | str | None = None
    """A number, or the name of one of `constants`, given at every step; None: the code role writes the law."""
    gain: float | None = Field(None, gt=0)
    """Of a servo: N/m or N·m/rad (position), N·s/m or N·m·s/rad (velocity)."""
    damping: float = Field(0.0, ge=0)
    """Of a position servo, N·s/m or N·m·s/rad."""
    limit: float | None = Field(None, gt=0)
    """The most it can exert, N or N·m."""

    @model_validator(mode="after")
    def _geared(self) -> "Actuator":
        if (self.kind in ("position", "velocity")) != (self.gain is not None):
            raise ValueError("`gain` is needed by a position or velocity servo, and only by them")
        if self.kind == "imported" and (self.damping or self.limit):
            raise ValueError("the file of an imported actuator owns its damping and limit: remove them here")
        return self

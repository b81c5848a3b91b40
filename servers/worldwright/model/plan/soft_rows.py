"""What a plan says of an object that is soft: cloth that hangs and stretches, jelly that is squashed; `worldkit.softs` makes them."""

from typing import Any, Literal

from pydantic import Field, model_validator

from ..frozen import Frozen

Side = Literal["-x", "+x", "-y", "+y", "-z", "+z", "corners"]
SHAPES = {"cloth": ("box",), "jelly": ("box", "sphere", "ellipsoid", "cylinder")}
"""Primitives that each kind may be."""


class Soft(Frozen):
    """How an object is soft."""

    kind: Literal["cloth", "jelly"]
    modulus: str
    """The constant (Pa) that is its Young's modulus."""
    thickness_m: float | None = Field(None, gt=0)
    """Of a cloth's stuff, metres; its `size` is how thick it is seen."""
    poisson: float | None = Field(None, ge=0, lt=0.5)
    damping_s: float | None = Field(None, ge=0)
    """As a time: 0.02 s flutters on, 0.1 s calms within two seconds."""
    points: int | None = Field(None, ge=3, le=41)
    """Along its longest side."""
    held: tuple[Side, ...] = ()
    """Sides that are held where they are; of a cloth edges, or `corners`."""

    @model_validator(mode="after")
    def _of_its_kind(self) -> "Soft":
        if self.kind == "jelly" and self.thickness_m is not None:
            raise ValueError("a jelly is as thick as its `size`: remove `thickness_m`")
        none = {"corners"} if self.kind == "jelly" else {"-z", "+z"}
        if wrong := [side for side in self.held if side in none]:
            raise ValueError(f"a {self.kind} is not held by `{wrong[0]}`")
        return self

    def numbers(self) -> dict[str, Any]:
        """What the plan states of it besides the modulus, by the names of `worldkit.softs`."""
        told = {key: getattr(self, key) for key in ("thickness_m", "poisson", "damping_s", "points")}
        return {key: value for key, value in told.items() if value is not None} | (
            {"held": self.held} if self.held else {}
        )


def fits(row: Any) -> None:
    """Refuse what no soft object can be besides.

    Raises:
        ValueError: the message names the field.
    """
    of = SHAPES[row.soft.kind]
    if row.primitive not in of:
        raise ValueError(f"a soft {row.soft.kind} is a {' or '.join(of)}, not a {row.primitive}")
    others = {"fixed": row.fixed, "hollow": row.hollow, "deg_x": row.deg_x, "count": row.count > 1, "breaks": row.breaks,
              "visual_only": row.visual_only, "dynamic: false": not row.dynamic}  # fmt: skip
    if given := [key for key, value in others.items() if value]:
        raise ValueError(
            f"a soft {row.soft.kind} cannot have `{given[0]}`: remove it (`held` of `soft` says what holds it)"
        )
    x, y, z = row.size
    if row.soft.kind == "cloth" and not z < min(x, y):
        raise ValueError("a cloth lies flat at the start: its third extent is how thick it is seen, and the smallest")


def check(plan: Any) -> None:
    """Refuse soft objects whose modulus or mass the plan does not have, that hang on a joint, or that its integrator cannot step.

    Raises:
        ValueError: the message names it.
    """
    given = plan.simulation_parameters
    jointed = {joint.child for joint in plan.topology.joints}
    for row in plan.scene_objects:
        if row.soft is None:
            continue
        modulus = given.constants.get(row.soft.modulus)
        if modulus is None or isinstance(modulus.value, tuple) or modulus.unit != "Pa" or not modulus.value > 0:
            raise ValueError(
                f"`{row.name}` is as stiff as `{row.soft.modulus}`: add it to simulation_parameters.constants, one number above 0 in Pa"
            )
        if row.name not in given.masses:
            raise ValueError(f"`{row.name}` is soft: give its mass in simulation_parameters.masses, kg")
        if row.name in jointed:
            raise ValueError(
                f"`{row.name}` is soft and hangs on no joint: name the sides that are `held` in its `soft`"
            )
        if given.integrator != "discrete":
            raise ValueError(
                f"`{row.name}` is soft, which `integrator: {given.integrator}` cannot step: write `discrete`"
            )

"""What holds of what meets: two things that rub otherwise than their materials say, or overlap; a joint's stops; the air."""

from collections.abc import Iterable
from typing import TypeVar

from pydantic import Field

from ..frozen import Frozen
from .object_parts import Vec3


class Touch(Frozen):
    """What two surfaces do to each other where they touch."""

    friction: float = Field(0.5, ge=0)
    """Sliding friction coefficient, unitless."""
    torsional_friction: float = Field(0.005, ge=0)
    """Metres (MuJoCo's convention: a coefficient times a contact radius). Of two surfaces the larger acts; unsaid, it is never
    larger than the smallest that a material says of which a thing of the plan is made."""
    rolling_friction: float = Field(0.0001, ge=0)
    """Metres; unsaid as above."""
    restitution: float | None = Field(None, ge=0, le=1)
    """Ratio of rebound to impact speed along the normal; None: the engine's default (nearly dead) contact."""
    source: str = ""
    """Where the constants come from."""


class SurfaceConstants(Touch):
    """Physical constants of one material, referred to by objects as `material`."""

    density: float | None = Field(None, gt=0)
    """kg/m^3."""
    adhesion: float = Field(0.0, ge=0)
    """N with which it sticks at each contact point; a box's face has four of them, a ball one.
    What hangs by it alone is not held sideways: a breath of wind moves it."""


Row = TypeVar("Row", bound=Touch)
FRICTIONS = ("friction", "torsional_friction", "rolling_friction")
YIELDING = FRICTIONS[1:]
"""What rubs where a thing spins or rolls on the spot: few plans say it, and a default is no claim. Sliding friction is always meant."""


def least_said(rows: Iterable[Touch]) -> dict[str, float]:
    """The smallest value that these rows say of each of `YIELDING` which any of them says.

    Where two surfaces meet, the engine lets the larger value act (MuJoCo manual, "Contact parameters"): a row that says
    nothing must not overrule one that does, so it takes this value where its own default is larger.
    """
    told = list(rows)
    said = {name: [float(getattr(row, name)) for row in told if name in row.model_fields_set] for name in YIELDING}
    return {name: min(values) for name, values in said.items() if values}


def said(row: Touch) -> dict[str, float]:
    """What a row says of `YIELDING`, the default's value too."""
    return {name: float(getattr(row, name)) for name in YIELDING if name in row.model_fields_set}


def yielded(row: Row, least: dict[str, float]) -> Row:
    """The row, with what it leaves unsaid no larger than `least`."""
    changed = {k: v for k, v in least.items() if k not in row.model_fields_set and v < getattr(row, k)}
    if not changed:
        return row
    made = row.model_copy(update=changed)
    made.__pydantic_fields_set__.difference_update(changed)  # it is still unsaid
    return made


class PairSurface(Touch):
    """Physical constants between two things, instead of those of their materials."""

    between: tuple[str, str]
    """Two objects, or one and `ground`."""


class Overlap(Frozen):
    """Two things that belong together may be inside each other by so much: a pin in its hole, a lid on its rim."""

    between: tuple[str, str]
    """Two objects."""
    up_to_m: float = Field(gt=0, le=0.1)
    """Metres, of their solid shapes, at any time; at most half of the smallest extent of the thinner one."""
    why: str = Field(min_length=3)


class Stop(Frozen):
    """How a joint is stopped at the ends of its range."""

    time_constant: float | None = Field(None, gt=0)
    """s: shorter is harder, four time steps are as hard as holds; None: 20 ms."""
    restitution: float | None = Field(None, ge=0, le=1)
    """Ratio of the speeds after and before; None: it hardly rebounds."""


class Medium(Frozen):
    """What everything moves in: air, or water that fills the world; it drags, and moves with the wind."""

    density: float = Field(1.2, ge=0)
    """kg/m^3; air at 20 degrees Celsius."""
    viscosity: float = Field(1.8e-5, ge=0)
    """Pa·s."""
    wind: Vec3 = (0.0, 0.0, 0.0)
    """m/s, world frame, the same everywhere and always."""
    source: str
    """Where the constants come from."""

"""What a file itself says of its axes and its unit: COLLADA and USD have words for it, the other formats have none."""

from dataclasses import dataclass
from pathlib import Path

from . import collada_claims, declared_sizes, usd_stage


@dataclass(frozen=True)
class Told:
    """up, front: axes such as `+y`, empty where the file does not say. unit_m: metres in one unit, 0 where it does not say."""

    up: str = ""
    front: str = ""
    unit_m: float = 0.0


NOTHING = Told()
COLLADA_AXES = {"X_UP": ("+x", "+z"), "Y_UP": ("+y", "+z"), "Z_UP": ("+z", "-y")}
"""COLLADA 1.5 specification, `up_axis`: up, and the front, which is the axis that it calls `in`: from the thing to who looks at it."""
USD_AXES = {"Y": ("+y", "+z"), "Z": ("+z", "+x")}
"""USD says which way is up; the front is what programs of that axis mostly take."""


def of(path: Path) -> Told:
    """What the file says.

    Raises:
        IntakeError: it cannot be read.
    """
    if path.suffix.lower() == ".dae":
        claims = collada_claims.scan(path)
        return Told(*COLLADA_AXES[claims.up], claims.unit_m)
    if path.suffix.lower() in declared_sizes.USD:
        up, unit = usd_stage.frame(path)
        return Told(*USD_AXES[up], unit)
    return NOTHING

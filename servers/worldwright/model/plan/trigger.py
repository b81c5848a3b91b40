"""A trigger that can be checked: `QUANTITY [of NAME] > NUMBER UNIT` or `while A touches B`, as a plan's intervention states it.

Quantities: `load` (force of the equality that is switched, N), `stress` (of a bond that is switched, Pa), `tension` (of a tendon, N), `contact force` (summed on a
body, N), `speed` (m/s), `height` (m).
"""

import re
from typing import NamedTuple

TRIGGER = re.compile(
    r"\b(?P<quantity>load|stress|tension|contact force|speed|height)\b(?:\s+(?:of|on|in)\s+(?:the\s+)?(?P<name>[\w./-]+))?"
    r"\s*(?P<sign>>=?|<=?|exceeds|above|over|below|under)\s*(?P<number>\d+(?:\.\d*)?(?:e-?\d+)?)\s*"
    r"(?P<unit>kN|N|kPa|MPa|Pa|mm|cm|m/s|m)?\b",
    re.IGNORECASE,
)
TOUCH = re.compile(r"\bwhile\s+(?:the\s+)?([\w./-]+)\s+touches\s+(?:the\s+)?([\w./-]+)", re.IGNORECASE)
ALWAYS = re.compile(
    r"^\s*(always|throughout|at all times|(at )?every step|constant(ly)?|continuous(ly)?|(during |for )?the (whole|entire) time|"
    r"from (the )?(very )?(start|beginning)( (on|to the end))?|(at )?(t|time)\s*(>=?|≥)\s*0+(\.0*)?\s*(s|seconds)?|)\s*\.?\s*$",
    re.IGNORECASE,
)
SCALE = {"kn": 1e3, "kpa": 1e3, "mpa": 1e6, "mm": 1e-3, "cm": 1e-2}


class Threshold(NamedTuple):
    """A trigger that can be checked."""

    quantity: str
    name: str
    rising: bool
    number: float


def always(trigger: str) -> bool:
    """Whether it acts from the beginning to the end: no moment and no state is waited for."""
    return ALWAYS.match(trigger) is not None


def threshold(trigger: str) -> Threshold | None:
    """The checkable part of a declared trigger, or None."""
    found = TRIGGER.search(trigger)
    if not found:
        return None
    number = float(found["number"]) * SCALE.get((found["unit"] or "").lower(), 1.0)
    rising = found["sign"].lower() in (">", ">=", "exceeds", "above", "over")
    return Threshold(found["quantity"].lower(), found["name"] or "", rising, number)


def touching(trigger: str) -> tuple[str, str] | None:
    """The two that touch as long as it acts (`while hand touches box`), or None."""
    found = TOUCH.search(trigger)
    return (found[1].rstrip("."), found[2].rstrip(".")) if found else None

"""What the words of an intervention's law bind: its largest magnitude, its direction, and that it only brakes.

A law is written for people. A number with a unit, an axis and a direction against the motion are binding; other words are not.
"""

import re
from collections.abc import Mapping
from math import hypot

from .committed import Constant
from .declared_inputs import RATE

__all__ = ["BRAKES", "direction", "interval", "limit", "named", "numbers", "said"]
NUMBER = r"(?P<number>\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)\s*"
FORCE = NUMBER + r"(?P<prefix>[kKmM]?)N(?![\w·*/.-]*m\b)(?!\s*[·*]?\s*m\b)(?!\w)" + RATE
TORQUE = NUMBER + r"(?P<prefix>[kKmM]?)N\s?[·* .]?\s?m(?!\w)" + RATE
SPEED = NUMBER + r"(?P<prefix>[kcm]?)(?:m|rad)/s(?![\w²^])"
GRAVITY = NUMBER + r"(?P<prefix>)m/s(?:\^2|\*\*2|²|2)"
UNITS = {
    "force": re.compile(FORCE),
    "torque": re.compile(TORQUE),
    "velocity": re.compile(SPEED),
    "gravity": re.compile(GRAVITY),
    "density": re.compile(NUMBER + r"(?P<prefix>)kg/m(?:\^3|\*\*3|³|3)"),
    "viscosity": re.compile(NUMBER + r"(?P<prefix>)Pa\s?[·* ]?\s?s\b"),
}
PREFIX = {"": 1.0, "k": 1e3, "K": 1e3, "c": 1e-2, "m": 1e-3, "M": 1e6}
RANGE = re.compile(r"^\s*(?:to|and|up to|\.\.|-|–)\s*$", re.IGNORECASE)
"""What stands between the two ends of a range."""
BRAKES = re.compile(
    r"^\W*(?:\w+\W+){0,2}(?:brak\w*|resist\w*|drag)\b|\bagainst (?:its|the) (?:motion|movement|velocity|speed)\b",
    re.IGNORECASE,
)
"""Beginnings and phrases of a law that only brakes; "weight of the water, and drag while wet" does more than that."""
ALONG = re.compile(r"(?:along|towards?|in)\s+(?:the\s+)?(?P<sign>[+-])\s?(?P<axis>[xyzXYZ])\b")


def numbers(law: str, kind: str) -> tuple[float, ...]:
    """Every magnitude that a law states in the unit of its kind (N, N·m, m/s or rad/s; `gravity`: m/s^2), in its order."""
    return tuple(float(m["number"]) * PREFIX[m["prefix"]] for m in UNITS[kind].finditer(law)) if kind in UNITS else ()


def said(law: str, kind: str, constants: Mapping[str, Constant]) -> tuple[float, ...]:
    """Every magnitude that a law states in the unit of its kind, itself or by the name of a constant; of a vector its length, too."""
    found = list(numbers(law, kind))
    for name, constant in constants.items():
        if re.search(rf"\b{re.escape(name)}\b", law):
            given = constant.value if isinstance(constant.value, tuple) else (constant.value,)
            given = (*given, hypot(*given)) if len(given) > 1 else given
            found += [v for one in given for v in numbers(f"{abs(one):.17g} {constant.unit}", kind)]
    return tuple(found)


def limit(law: str, kind: str) -> float | None:
    """The magnitude that a law binds its kind to: the first one stated, or the greater end of a range that begins there.

    A later number ("far below its weight of 49 N") does not count. None: the law states no such number.
    """
    if kind not in UNITS:
        return None
    found = [*UNITS[kind].finditer(law)]
    if not found:
        return None
    first, *others = found
    said = [float(first["number"]) * PREFIX[first["prefix"]]]
    if others and RANGE.match(law[first.end() : others[0].start()]):
        said.append(float(others[0]["number"]) * PREFIX[others[0]["prefix"]])
    return max(said)


def interval(law: str, kind: str) -> tuple[float, float]:
    """The range that a law states first (`from 9.81 m/s^2 to 4 m/s^2`, a unit at both ends); (inf, -inf) without one."""
    first, second = ([*UNITS[kind].finditer(law), None, None])[:2] if kind in UNITS else (None, None)
    if first is None or second is None or not RANGE.match(law[first.end() : second.start()]):
        return float("inf"), float("-inf")
    ends = [float(m["number"]) * PREFIX[m["prefix"]] for m in (first, second)]
    return min(ends), max(ends)


def direction(law: str) -> tuple[float, float, float] | None:
    """The axis of the world along which a law acts (`along +X`); None where it names none, or several."""
    found = {(m["sign"], m["axis"].lower()) for m in ALONG.finditer(law)}
    if len(found) != 1:
        return None
    sign, axis = found.pop()
    unit = [0.0, 0.0, 0.0]
    unit["xyz".index(axis)] = 1.0 if sign == "+" else -1.0
    return unit[0], unit[1], unit[2]


def named(law: str, constants: Mapping[str, Constant]) -> bool:
    """Whether a law speaks of a constant of the plan."""
    return any(re.search(rf"\b{re.escape(name)}\b", law) for name in constants)

"""Every number that a plan gives, with the dimension that its key tells: `min_m` lengths, `window_s` times, `masses` kilograms."""

import re
from collections.abc import Collection, Iterator
from typing import Any

from .spoken_quantities import FORCE, KG, NONE, PRESSURE, Dimension, K, M, S, quantities

ENDS: tuple[tuple[str, Dimension, float], ...] = (
    ("kg_m_s", (1, 1, -1, 0, 0), 1.0),
    ("n_s", (1, 1, -1, 0, 0), 1.0),
    ("rad_s2", NONE, 1.0),
    ("rad_s", (0, 0, -1, 0, 0), 1 / 6.283185307),
    ("m_s2", (0, 1, -2, 0, 0), 1.0),
    ("m_s", (0, 1, -1, 0, 0), 1.0),
    ("n_m", (1, 0, -2, 0, 0), 1.0),
    ("nm", (1, 2, -2, 0, 0), 1.0),
    ("m3", (0, 3, 0, 0, 0), 1.0),
    ("m2", (0, 2, 0, 0, 0), 1.0),
    ("pa", PRESSURE, 1.0),
    ("hz", (0, 0, -1, 0, 0), 1.0),
    ("kg", KG, 1.0),
    ("deg", NONE, 1.0),
    ("px", NONE, 1.0),
    ("m", M, 1.0),
    ("s", S, 1.0),
    ("n", FORCE, 1.0),
    ("k", K, 1.0),
)
"""By the end of a key, the longest first: the dimension, and the scale to SI."""
BY_NAME: dict[str, Dimension] = {
    **dict.fromkeys(("size", "position", "radius", "width", "diameter", "top_diameter", "wall_thickness", "profile", "path"), M),
    **dict.fromkeys(("low", "high", "center", "place", "x", "y", "z", "height", "thickness"), M),
    **dict.fromkeys(("mass", "masses"), KG),
    **dict.fromkeys(("time_step", "simulation_duration"), S),
    "linear": (0, 1, -1, 0, 0),
    "angular": (0, 0, -1, 0, 0),
    "gravity": (0, 1, -2, 0, 0),
    "density": (1, -3, 0, 0, 0),
}  # fmt: skip
PURE = re.compile(
    r"(^|_)(tolerance|share|ratio|ratios|times|count|turns|cycles|strain|friction|restitution|cosine|loss|axis|direction|exponent|seed"
    r"|impratio|integrator|smooth|each|apart|before|deg|damping)(_|$)"
)
"""Numbers without a unit."""


def numbers(
    value: Any, skipping: Collection[str] = (), told: Dimension | None = None
) -> Iterator[tuple[float, Dimension | None]]:
    """Each number in a value, with its dimension: None where its key tells none, so that it may be of any.

    Args:
        value: mappings, lists and numbers.
        skipping: keys that are left out with what they lead to: the names of other things.
        told: the dimension that the key of `value` tells.
    """
    if isinstance(value, bool):
        return
    if isinstance(value, int | float):
        if told != NONE:
            yield float(value), told
    elif isinstance(value, dict) and isinstance(value.get("unit"), str) and "value" in value:
        unit = next((one.meant[0] for one in quantities(f"1 {value['unit']}")), (1.0, None))
        for number, _ in numbers(value["value"], skipping):
            yield number * unit[0], unit[1]
    elif isinstance(value, dict):
        for key, inner in value.items():
            if key not in skipping:
                scale, dimension = _of_key(str(key), told)
                for number, own in numbers(inner, skipping, dimension):
                    yield number * scale, own
    elif isinstance(value, list | tuple):
        for inner in value:
            yield from numbers(inner, skipping, told)


def _of_key(key: str, outer: Dimension | None) -> tuple[float, Dimension | None]:
    if key in BY_NAME:
        return 1.0, BY_NAME[key]
    for end, dimension, scale in ENDS:
        if key == end or key.endswith("_" + end):
            return scale, dimension
    return 1.0, NONE if PURE.search(key) else outer

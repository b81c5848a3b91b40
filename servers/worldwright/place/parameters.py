"""The parameters of a predicate: each has a kind and a meaning, and no default but those in the predicate's docstring."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any, Literal

Kind = Literal["number", "pair", "point", "name", "height", "flag", "object", "objects"]
_WORDS = {
    "number": "a number",
    "pair": "a list of 2 numbers [dx, dy]",
    "point": "a list of 3 numbers [x, y, z]",
    "name": "a name",
    "height": "a number, or the name of a layer of topology.reference_heights",
    "flag": "true or false",
    "object": "the name of an object",
    "objects": "a list of names of objects, each once",
}


@dataclass(frozen=True)
class Parameter:
    """One parameter: its kind and its meaning."""

    kind: Kind
    meaning: str
    minimum: float | None = None
    choices: tuple[str, ...] = ()
    """For a name: the values that it may have."""
    required: bool = False


def read(
    given: Mapping[str, Any], spec: Mapping[str, Parameter], heights: Mapping[str, float]
) -> tuple[dict[str, Any], list[tuple[str, str]]]:
    """Check parameters against their specification.

    Args:
        given: the row's `params`.
        spec: the parameters of the predicate.
        heights: named reference heights, metres.

    Returns:
        the values (numbers as floats, names of heights replaced by their metres), and (cause, fix) pairs.
    """
    values: dict[str, Any] = {}
    problems: list[tuple[str, str]] = []
    for key, raw in given.items():
        if key not in spec:
            near = get_close_matches(key, spec, n=1, cutoff=0.6)
            known = ", ".join(spec) or "none"
            problems.append(
                (f"it takes no parameter `{key}`", (f"did you mean `{near[0]}`? " if near else "") + f"known: {known}")
            )
            continue
        value = _read(raw, spec[key].kind, heights)
        if value is None:
            fix = f"{key}: {spec[key].meaning}"
            if spec[key].kind == "height" and isinstance(raw, str):
                fix = f"known layers: {', '.join(heights) or '(none)'}"
            problems.append((f"`{key}` must be {_WORDS[spec[key].kind]}, got {raw!r}", fix))
            continue
        low = spec[key].minimum
        if low is not None and any(v < low for v in _numbers(value)):
            problems.append((f"`{key}` must be at least {low:g}, got {raw!r}", f"{key}: {spec[key].meaning}"))
            continue
        if spec[key].choices and value not in spec[key].choices:
            problems.append(
                (f"`{key}` must be one of {', '.join(spec[key].choices)}, got {raw!r}", f"{key}: {spec[key].meaning}")
            )
            continue
        values[key] = value
    problems += [
        (f"it needs `{key}`", f"add `{key}`: {parameter.meaning}")
        for key, parameter in spec.items()
        if parameter.required and key not in given
    ]
    return values, problems


def _read(raw: Any, kind: Kind, heights: Mapping[str, float]) -> Any:
    if kind in ("name", "object"):
        return raw if isinstance(raw, str) and raw else None
    if kind == "objects":
        fits = isinstance(raw, list | tuple) and raw and all(isinstance(name, str) and name for name in raw)
        return tuple(raw) if fits and len(set(raw)) == len(raw) else None
    if kind == "flag":
        return raw if isinstance(raw, bool) else None
    if kind == "height" and isinstance(raw, str):
        return heights.get(raw)
    if kind in ("number", "height"):
        return _number(raw)
    if kind == "point" and isinstance(raw, Mapping) and raw.keys() == {"x", "y", "z"}:
        raw = [raw["x"], raw["y"], raw["z"]]
    count = 2 if kind == "pair" else 3
    if not isinstance(raw, list | tuple) or len(raw) != count:
        return None
    numbers = tuple(_number(item) for item in raw)
    return None if None in numbers else numbers


def _number(raw: Any) -> float | None:
    if isinstance(raw, bool) or not isinstance(raw, int | float):
        return None
    try:
        value = float(raw)
    except OverflowError:
        return None
    return value if math.isfinite(value) and abs(value) <= 1e6 else None


def _numbers(value: Any) -> Iterator[float]:
    if isinstance(value, tuple):
        yield from value
    elif isinstance(value, float):
        yield value

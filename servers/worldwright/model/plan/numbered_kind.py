"""A thing of a kind, made of its kind's own numbers but for those that a plan states: what rows of vehicles and plants share."""

import importlib
from dataclasses import fields
from difflib import get_close_matches
from functools import lru_cache
from typing import Any


@lru_cache(maxsize=64)
def made(package: str, kind: str, numbers: tuple[tuple[str, Any], ...], not_its: frozenset[str] = frozenset()) -> Any:
    """The thing, whose class `package` holds by the kind's name with a capital.

    Args:
        package: such as `worldkit.plants`; it is loaded here, for plans without such things.
        kind: its word in a plan.
        numbers: name and value of each that the plan states, sorted.
        not_its: numbers of the class that this kind does without.

    Raises:
        ValueError: a number that it does not have, or one with which none can be made.
    """
    of_kind = getattr(importlib.import_module(package), kind.capitalize())
    known = {field.name for field in fields(of_kind)} - not_its
    for name, _ in numbers:
        if name not in known:
            near = get_close_matches(name, known, n=1)
            hint = f"did you mean `{near[0]}`?" if near else f"it has: {', '.join(sorted(known))}"
            raise ValueError(f"a {kind} has no number `{name}`: {hint}")
    try:
        return of_kind(**dict(numbers))
    except TypeError as error:
        raise ValueError(f"a {kind} cannot be made of these numbers: {error}") from error

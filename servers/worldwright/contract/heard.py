"""What one event of a headless harness says, in words that all harnesses share.

Each harness's own forms are read in its file under `harnesses/`. Only the standard library is imported, as there.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Heard:
    """Of one event: what it cost, what was said, how it ended."""

    of: str = ""
    """The step that the figures are of: a later event of the same step replaces them. Empty: they are of all steps together."""
    read: int = 0
    """Tokens that the model was given, those from its cache among them."""
    cached: int = 0
    """Of these, from the cache."""
    written: int = 0
    """Tokens that it wrote, its thinking among them."""
    usd: float | None = None
    """US dollars as the harness reckons them; None where it tells none."""
    counted: bool = False
    """Whether there are figures in it at all."""
    said: str = ""
    """What the model, or the harness, said."""
    wrong: bool = False
    """What was said is why the harness could not go on."""
    ended: bool = False
    """It is the last word of a session that came to its end."""
    over_usd: bool = False
    """The harness ended it, since it cost as much as it may."""


def whole(value: Any) -> int:
    """A count as it stands in a harness's JSON; 0 for what is none."""
    return value if isinstance(value, int) and not isinstance(value, bool) and value > 0 else 0


def money(value: Any) -> float | None:
    """Dollars as they stand in a harness's JSON; None for what is no sum."""
    told = isinstance(value, int | float) and not isinstance(value, bool) and 0 <= value < 1e9
    return float(value) if told else None


def mapping(value: Any) -> dict[str, Any]:
    """An object of a harness's JSON; an empty one for what is none."""
    return value if isinstance(value, dict) else {}

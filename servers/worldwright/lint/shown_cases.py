"""Cases of a rule as a reader wants them: few, short, and of a long one only what makes it bad or good."""

import difflib
import json
from collections.abc import Iterator, Sequence

MOST, LONG = 3, 900
"""So many cases of each kind are shown, none longer than so many characters."""
AS_A_CLEAN_ONE = "as a clean case, but:"


def shown(bad: Sequence[object], good: Sequence[object]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Some of the cases that a rule finds fault with, and of those that are clean."""
    clean = [text(case) for case in good]
    faulty = [_beside(text(case), clean) for case in bad]
    return tuple(_few(faulty)), tuple(_few([case for case in clean if len(case) <= LONG], len(clean)))


def text(case: object) -> str:
    """All of a case: a program, a plan's fields, or a program and a plan."""
    if isinstance(case, tuple):
        return "\n".join(map(text, case))
    if isinstance(case, dict):
        return json.dumps(case, indent=1)
    return str(getattr(case, "source", case))


def _beside(case: str, clean: list[str]) -> str:
    """A case; of a long one, where it differs from the clean case that is most like it."""
    if len(case) > LONG and clean:
        found = min((list(_differing(other, case)) for other in clean), key=lambda lines: sum(map(len, lines)))
        case = "\n".join([AS_A_CLEAN_ONE, *found])
    return case if len(case) <= LONG else case[:LONG] + " …"


def _differing(one: str, other: str) -> Iterator[str]:
    for line in difflib.unified_diff(one.splitlines(), other.splitlines(), n=1, lineterm=""):
        if not line.startswith(("---", "+++", "@@")):
            yield line


def _few(cases: list[str], count: int | None = None) -> list[str]:
    """The shortest of some cases; a last line says how many more there are."""
    few = sorted(dict.fromkeys(cases), key=len)[:MOST]
    left = (len(cases) if count is None else count) - len(few)
    return [*few, f"({left} more)"] if few and left else few

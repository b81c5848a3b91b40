"""One check's outcome, in the words the doctor prints."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Diagnosis:
    """The finding of a check, and the fix if it is a problem."""

    name: str
    ok: bool
    found: str
    fix: str = ""
    essential: bool = True
    """Whether a build fails without it; otherwise it is only weaker, or a harness lacks something."""


def last_line(text: str) -> str:
    """The last line of an output, in which programs say what went wrong."""
    return (text.strip().splitlines() or ["no message"])[-1]

"""What has to be looked up before the program is run again: a name the installed simulator does not know.

Patching such a name from memory repeats the memory's mistake, so the journal must hold a citation newer than the error.
"""

from collections.abc import Iterable
from typing import Any

SYMBOLS = ("WL101", "WL102", "WL103", "WL104", "WL105")
"""Lint rules about names that the installed build lacks."""


def owed(entries: Iterable[dict[str, Any]]) -> str:
    """The latest unknown name that nothing was read about since; empty when nothing is owed.

    Args:
        entries: of the journal, oldest first.
    """
    found = ""
    for entry in entries:
        action, message = entry.get("action"), str(entry.get("message", ""))
        codes = entry.get("codes")
        if action == "cite":
            found = ""
        elif action == "lint" and isinstance(codes, list) and (unknown := [c for c in codes if c in SYMBOLS]):
            found = f"lint finding {', '.join(unknown)}"
        elif action == "stage" and entry.get("ok") is False and "AttributeError" in message and "mujoco" in message:
            found = message
    return found

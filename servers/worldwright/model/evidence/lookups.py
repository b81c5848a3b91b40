"""What has to be looked up before the program is run again: a name the installed simulator does not know.

Patching such a name from memory repeats the memory's mistake, so the journal must hold a citation newer than the error.
"""

from collections.abc import Iterable
from typing import Any


def owed(entries: Iterable[dict[str, Any]]) -> str:
    """The latest unknown name about which nothing has been read since; empty when nothing is owed.

    Args:
        entries: the lines of the journal, oldest first. A line of lint lists the codes of its findings about such names
            as `unknown`.
    """
    found = ""
    for entry in entries:
        action, message = entry.get("action"), str(entry.get("message", ""))
        if action == "cite":
            found = ""
        elif action == "lint" and isinstance(unknown := entry.get("unknown"), list) and unknown:
            found = f"lint finding {', '.join(map(str, unknown))}"
        elif action == "stage" and entry.get("ok") is False and "AttributeError" in message and "mujoco" in message:
            found = message
    return found

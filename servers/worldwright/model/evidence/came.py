"""How an approval, a description or a review was sent.

The name in it (`by`, `author`, `reviewer`) is what its sender claims. How it was sent is what the receiver saw: a terminal,
at which a person or a program may sit (anybody can open a pseudo-terminal), a command line without one, a harness over MCP,
or code that called by itself. The role inside a harness
is known where its hook ran: before the call, the write-scope guard leaves a note with the role's name under `runs/.spoken`,
which the server takes away. None of this stops somebody who controls the machine; it keeps an agent's approval from
standing in the stamp as a person's.
"""

import json
import sys
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Any, Literal

from ..frozen import Frozen

SPOKEN = Path(__file__).resolve().parents[4] / "runs" / ".spoken"
"""Where the guard leaves its notes: one file a call, `TOOL-TIME.json`, with `agent` and `run`."""
FRESH_S = 60.0
TERMINAL = "confirmed at a terminal"
OLDER = "a person at a terminal"
"""How older versions told it, who could not know."""


class Came(Frozen):
    """What the receiver saw of how it was sent."""

    how: Literal["terminal", "command_line", "client", "automation"]
    client: str = ""
    """The name that the MCP client gave itself, or the harness in whose shell the command was typed."""
    role: str | None = None
    """The role that the harness's hook named (`main` for the main thread); None when no hook left a note."""

    def text(self) -> str:
        """A few words for the stamp, the status and the report."""
        if self.how == "terminal":
            return TERMINAL
        if self.how == "command_line":
            return "a command line without a terminal" + (f", inside {self.client}" if self.client else "")
        if self.how == "automation":
            return "automation"
        role = f"its hook says {self.role}" if self.role else "no hook said which role"
        return f"{self.client or 'an MCP client without a name'}, {role}"


_NOW: ContextVar[Came | None] = ContextVar("came", default=None)


def current() -> Came:
    """How the present call was sent; automation when nothing is known."""
    return _NOW.get() or Came(how="automation")


@contextmanager
def entered(came: Came) -> Iterator[None]:
    """Remember, within the block, that the call was sent this way."""
    before = _NOW.set(came)
    try:
        yield
    finally:
        _NOW.reset(before)


def by_command(inside: str) -> Came:
    """How a command came: at a terminal, unless a harness opened it, whose name is then `inside`."""
    try:
        terminal = sys.stdin.isatty() and sys.stdout.isatty()
    except (AttributeError, ValueError):  # closed, or not there
        terminal = False
    return Came(how="terminal") if terminal and not inside else Came(how="command_line", client=inside)


def by_client(name: str, tool: str, arguments: Mapping[str, Any], folder: Path | None = None) -> Came:
    """How a call over MCP was sent: by which client, and by which role according to the note that its hook left."""
    return Came(how="client", client=name, role=_spoken(tool, str(arguments.get("run", "")), folder or SPOKEN))


def _spoken(tool: str, run: str, folder: Path) -> str | None:
    """Take away the newest fresh note about this tool and run, and every stale one; returns the role that it names."""
    found = None
    for path in sorted(folder.glob(f"{tool}-*.json")):
        try:
            fresh = time.time() - path.stat().st_mtime <= FRESH_S
            word = json.loads(path.read_bytes())
            same = str(word["run"]) == run
            if fresh and same:
                found = str(word["agent"] or "main")[:80]
            if same or not fresh:
                path.unlink()
        except (OSError, ValueError, KeyError, TypeError):
            continue
    return found


def of(entry: Mapping[str, Any] | None) -> str:
    """How the entry of a journal line was sent, in words; empty for lines of older versions."""
    try:
        return Came.model_validate((entry or {})["came"]).text()
    except (KeyError, ValueError):
        return ""


def told(said: str) -> str:
    """The words of a stamp, which may be an older version's, as they are said now."""
    return TERMINAL if said == OLDER else said

"""What a scripted model says: turns by agent. Which agent asks is read off its instructions.

A script maps an agent (`main`, or a role's name) to its turns; a turn is a list of steps: `Say(text)` or `Call(tool, input)`.
What the tools answered is kept, so that a test can look at it.
"""

import threading
from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

ROLES = ("plan", "code", "visual", "review")


@dataclass(frozen=True)
class Say:
    """The model says something."""

    text: str


@dataclass(frozen=True)
class Call:
    """The model calls a tool; `given` is its input, an object or (a patch) plain text."""

    tool: str
    given: dict[str, Any] | str


Turn = list[Say | Call]
Lazy = Callable[[], Turn]
"""A turn that is made when its time comes, from what lies on disk by then."""


@dataclass(frozen=True)
class Request:
    """One request as the script sees it, whatever the wire's format."""

    agent: str
    tools: set[str]
    """Names of the tools it offers; empty for titles, summaries and topic checks."""
    results: list[str]
    """What its tools answered so far, in order."""
    before: str
    """All that stands before the agent's first word: instructions, tool definitions, listed skills."""


@dataclass
class Script:
    """Turns by agent; an agent without turns left says that it is done."""

    turns: dict[str, list[Turn | Lazy]]
    results: dict[str, list[str]] = field(default_factory=lambda: defaultdict(list))
    """What the tools answered, by agent, in order."""
    tools: dict[str, set[str]] = field(default_factory=lambda: defaultdict(set))
    """The tools each agent was offered."""
    first: dict[str, str] = field(default_factory=dict)
    """What stood before each agent's first word."""
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def next(self, request: Request) -> Turn:
        """The agent's next turn; notes what came back."""
        if not request.tools:
            return [Say("A world.")]
        with self._lock:
            agent, results = request.agent, request.results
            self.first.setdefault(agent, request.before)
            self.tools[agent] |= request.tools
            known = self.results[agent]
            known += results[len(known) :] if results[: len(known)] == known else results
            queue = self.turns.get(agent, [])
            turn = queue.pop(0) if queue else [Say("Done.")]
        return turn() if callable(turn) else turn


def agent_of(instructions: str) -> str:
    """`main`, or the role whose instructions these are."""
    return next((name for name in ROLES if f"You are the {name} role of one run" in instructions), "main")

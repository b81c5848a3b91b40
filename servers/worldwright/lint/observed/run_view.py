"""The view of a run rule: the events, and how the run ended."""

from collections.abc import Iterator
from typing import Any

from ...model.finding import Severity
from ..problem import Problem
from .observing import Observation


class Run:
    """One observed run."""

    def __init__(self, seen: Observation, lines: int = 10**9) -> None:
        self.seen = seen
        self.lines = lines

    def events(self, *codes: str) -> Iterator[dict[str, Any]]:
        """Events of these kinds, in the order they happened."""
        for event in self.seen.events:
            if event["code"] in codes and event["line"] <= self.lines:
                yield event

    def say(self, code: str, message: str, fix: str, severity: Severity | None = None) -> Iterator[Problem]:
        """One problem for each event of a kind; the message may name the event's values in braces."""
        for event in self.events(code):
            yield Problem(message.format_map(_Values(event)), fix, event["line"], severity=severity)


class _Values(dict[str, Any]):
    def __missing__(self, key: str) -> str:
        return "?"

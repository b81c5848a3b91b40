"""What a headless harness printed, read as it comes: tokens, money, its last words, and whether they are words of a harness at all."""

import json
from pathlib import Path

from ..contract import harnesses
from ..contract.heard import Heard
from .author_words import Author

MOST_BYTES = 1 << 28
"""Of a transcript: a session of hours has a few million bytes."""
MOST_LINE = 1 << 24
LOGIN = (
    "not logged in",
    "please run /login",
    "invalid api key",
    "authentication_error",
    "authentication_failed",
    "401 unauthorized",
    "missing bearer",
    "api key is missing",
    "incorrect api key",
)
"""What the harnesses say when they have no account, in lower case."""


class Talk:
    """A transcript that grows.

    Args:
        path: the file that the harness prints to.
        author: who it is.
    """

    def __init__(self, path: Path, author: Author) -> None:
        self.path, self.author = path, author
        self.harness = harnesses.find(author.harness)
        self.events = self.rubbish = 0
        """Lines that are JSON objects, and lines that are not."""
        self.last, self.wrong, self.ended, self.over_usd = "", "", False, False
        self._steps: dict[str, Heard] = {}
        self._whole: list[Heard] = []
        self._at = 0

    def read(self, whole: bool = False) -> "Talk":
        """Read what was printed since; `whole`: it has ended, and a line without an end is one."""
        try:
            with self.path.open("rb") as stream:
                stream.seek(self._at)
                while line := stream.readline(MOST_LINE):
                    if not (whole or line.endswith(b"\n") or len(line) == MOST_LINE):
                        break  # it is still being written
                    self._at += len(line)
                    self._take(line)
        except OSError:
            pass
        return self

    def _take(self, line: bytes) -> None:
        if not line.strip():
            return
        try:
            event = json.loads(line)
        except (ValueError, RecursionError):
            event = None
        if not isinstance(event, dict) or not isinstance(event.get("type"), str):
            self.rubbish += 1
            return
        self.events += 1
        heard = self.harness.heard(event)
        if heard.counted and heard.of:
            self._steps[heard.of] = heard
        elif heard.counted:
            self._whole.append(heard)
        self.last = heard.said or self.last
        self.wrong = (heard.said or "it says no more") if heard.wrong else "" if heard.ended else self.wrong
        self.ended |= heard.ended
        self.over_usd |= heard.over_usd

    @property
    def too_long(self) -> bool:
        """Whether it printed more than any session does."""
        return self._at > MOST_BYTES

    def cost(self) -> Heard:
        """All of it so far: what the harness told of the whole, else the sum of its steps."""
        told = self._whole or list(self._steps.values())
        heard = Heard(
            read=sum(one.read for one in told),
            cached=sum(one.cached for one in told),
            written=sum(one.written for one in told),
            counted=bool(told),
        )
        usd = [one.usd for one in told if one.usd is not None]
        prices = self.author.prices
        money = prices.of(heard) if prices and told else sum(usd) if usd else None
        return Heard(read=heard.read, cached=heard.cached, written=heard.written, counted=heard.counted, usd=money)

    def login(self, errors: str) -> bool:
        """Whether it says that nobody is logged in."""
        said = f"{self.wrong}\n{errors}".lower()
        return any(words in said for words in LOGIN)

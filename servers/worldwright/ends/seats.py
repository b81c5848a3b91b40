"""Who drives a live world and who watches it: one driver at a time, whose words are checked before they reach the world.

A message is a JSON object:

    {"kind": "drive", "n": 17, "values": {"car.throttle": 0.4}}    `n` grows; what is late is not used
    {"kind": "take"}     drive, where nobody does
    {"kind": "release"}  watch

What is wrong with one is answered by a refusal that names cause and next move, and the world goes on: with the last good word
until it is too old, then with the failsafes that the plan names.
"""

import json
import math
import threading
import time
from collections import deque
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from worldengine.inputs.commands import MOST_NUMBER, heard

MOST_HZ = 200
"""Messages a second from one peer; who sends more is shown the door."""
MOST_SEATS = 16
MOST_NAME = 40
TURN_S = 0.5
"""The wheel is given so seldom, s of the wall clock: who takes and releases it in turn fills nobody's disk."""
MOST_SPANS = 1000
"""Stretches that are remembered, the newest ones; all of them are noted."""


@dataclass(frozen=True)
class Refusal:
    """Why a message is not used."""

    cause: str
    next_move: str
    leave: bool = False
    """Whether the peer must go."""

    def told(self) -> dict[str, Any]:
        """As a message."""
        return {"kind": "refused", "cause": self.cause, "next": self.next_move}


@dataclass
class Span:
    """A stretch of a drive and who drove it, by the name that was given; nothing proves a name."""

    driver: str
    where: str
    from_s: float
    to_s: float | None = None

    def told(self) -> dict[str, Any]:
        """Plain words for the files of the drive."""
        return dict(vars(self))


class Seats:
    """The seats of one world.

    Args:
        names: of the commands.
        command: sends commands on to the world.
        left: lets the failsafes act at once.
        time_s: the simulated time, s.
        note: called with (what, more) for everything that whoever keeps the drive should know; where it cannot write, the drive
            goes on.
        clock: of the wall, s.
    """

    def __init__(
        self,
        names: Collection[str],
        command: Callable[[dict[str, float]], object],
        left: Callable[[], object],
        time_s: Callable[[], float],
        note: Callable[[str, dict[str, Any]], object] = lambda what, more: None,  # noqa: ARG005
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.names, self.command, self.left = frozenset(names), command, left
        self.time_s, self._note, self.clock = time_s, note, clock
        self.driver: Seat | None = None
        self.taken: list[Seat] = []
        self.spans: deque[Span] = deque(maxlen=MOST_SPANS)
        self._given = -math.inf
        self.lock = threading.RLock()

    def sit(self, name: str, where: str, watches: bool = False) -> "Seat | Refusal":
        """Take a seat: the driver's where it is free and wanted, else one of those who watch."""
        with self.lock:
            if len(self.taken) >= MOST_SEATS:
                return Refusal(f"all {MOST_SEATS} seats are taken", "wait until somebody leaves", leave=True)
            said = "".join(c for c in name if c.isprintable())[:MOST_NAME].strip() or "somebody"
            seat = Seat(self, said, where)
            self.taken.append(seat)
            self.note("came", {"name": said, "where": where})
            if not watches and self.driver is None and not self._too_soon():
                self._give(seat)
            return seat

    def note(self, what: str, more: dict[str, Any]) -> None:
        """Tell whoever keeps the drive; a full disk or a closed terminal ends nothing here."""
        with suppress(OSError, ValueError):
            self._note(what, more)

    def _too_soon(self) -> bool:
        return 0 <= self.clock() - self._given < TURN_S

    def _give(self, seat: "Seat") -> None:
        self.driver, self._given = seat, self.clock()
        self.spans.append(Span(seat.name, seat.where, self.time_s()))
        self.note("drives", {"name": seat.name, "where": seat.where, "from_s": self.spans[-1].from_s})

    def take(self, seat: "Seat") -> Refusal | None:
        """Give the wheel to a seat."""
        with self.lock:
            if self.driver is seat:
                return None
            if self.driver is not None:
                return Refusal(f"{self.driver.name} drives", "watch, and take the wheel when it is free")
            if self._too_soon():
                return Refusal("the wheel was given a moment ago", f"take it again after {TURN_S:g} s")
            self._give(seat)
            return None

    def release(self, seat: "Seat") -> None:
        """Take the wheel from a seat that has it."""
        with self.lock:
            if self.driver is not seat:
                return
            self.driver = None
            self.left()
            self.spans[-1].to_s = self.time_s()
            self.note("released", {"name": seat.name, "to_s": self.spans[-1].to_s})

    def stand_up(self, seat: "Seat") -> None:
        """Leave."""
        with self.lock:
            self.release(seat)
            if seat in self.taken:
                self.taken.remove(seat)
                self.note("left", {"name": seat.name, "where": seat.where, "refused": seat.refused})


NO_OTHERS: "Mapping[str, Callable[[dict[str, Any]], Refusal | None]]" = {}


@dataclass(eq=False)
class Seat:
    """One peer."""

    seats: Seats
    name: str
    where: str
    refused: int = 0
    last: int = -1
    """The number of its last message."""
    _second: float = field(default=-math.inf)
    _heard: int = 0

    @property
    def drives(self) -> bool:
        """Whether it has the wheel."""
        return self.seats.driver is self

    def say(
        self, text: str | bytes, others: "Mapping[str, Callable[[dict[str, Any]], Refusal | None]]" = NO_OTHERS
    ) -> Refusal | None:
        """Take a message; returns why it is not used, if it is not.

        Args:
            text: the message.
            others: what takes further kinds of messages, by kind: they count as the seat's own do.
        """
        now = self.seats.clock()
        if not 0 <= now - self._second < 1.0:
            self._second, self._heard = now, 0
        self._heard += 1
        if self._heard > MOST_HZ:
            cause = f"more than {MOST_HZ} messages in a second"
            refusal: Refusal | None = Refusal(cause, "send 30 a second; the newest is what counts", leave=True)
        else:
            refusal = self._take(text, others)
        if refusal is not None:
            self.refused += 1
            if self.refused == 1 or refusal.leave:
                self.seats.note("refused", {"name": self.name, "cause": refusal.cause})
        return refusal

    def _take(
        self, text: str | bytes, others: "Mapping[str, Callable[[dict[str, Any]], Refusal | None]]"
    ) -> Refusal | None:
        try:
            said = json.loads(text)
        except (ValueError, RecursionError):
            return Refusal("this is no JSON", 'send {"kind": "drive", "n": 1, "values": {…}}')
        kind = said.get("kind") if isinstance(said, dict) else None
        if isinstance(kind, str) and kind in others:
            return others[kind](said)
        if kind == "take":
            return self.seats.take(self)
        if kind == "release":
            self.seats.release(self)
            return None
        if kind != "drive":
            return Refusal(
                f"there is no message {str(kind)[:40]!r}",
                f"send one of: {', '.join(('drive', 'take', 'release', *others))}",
            )
        if not self.drives:
            who = self.seats.driver.name if self.seats.driver else "nobody"
            return Refusal(f"{who} drives, you watch", 'send {"kind": "take"} when nobody drives')
        number, values = said.get("n"), said.get("values")
        if type(number) is not int or not isinstance(values, dict) or not values:
            return Refusal(
                "a drive has a number `n` and `values` by name", "see the commands that the world told first"
            )
        if unknown := [str(name)[:40] for name in values if name not in self.seats.names]:
            return Refusal(
                f"there is no command {', '.join(unknown[:4])}", f"name some of: {', '.join(sorted(self.seats.names))}"
            )
        if bad := [name for name, value in values.items() if not heard(value)]:
            return Refusal(f"{', '.join(bad[:4])}: no finite number below {MOST_NUMBER:g}", "send numbers")
        if number <= self.last:
            return Refusal(f"message {number} is late: {self.last} came before", "let `n` grow")
        self.last = number
        self.seats.command({name: float(value) for name, value in values.items()})
        return None

    def leave(self) -> None:
        """Stand up."""
        self.seats.stand_up(self)

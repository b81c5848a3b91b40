"""What a server is asked for: its terms, its price, and the work that it has begun, which is asked after and never paid twice."""

import os
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from worldkit.files import write_atomic

from ..model.errors import NotFoundError
from ..model.storage import writing
from .web_calls import OR_SCULPT, MintError, Server


@dataclass(frozen=True)
class Price:
    """What one answer costs; `amount` is None where it is not known here."""

    amount: float | None = 0.0
    unit: str = ""
    source: str = ""
    """What it is for, and of when; from public lists, in part at second hand."""

    def text(self) -> str:
        """As a person reads it."""
        if self.amount is None:
            return "not known here"
        return f"{self.amount:g} {self.unit}, as known when this was written ({self.source}); the service's own list decides"

    def confirm(self, told: float | None, place: str) -> None:
        """Pass when nothing is to be paid, or the price was confirmed.

        Raises:
            MintError: `price`: it was not, or another than this.
        """
        if self.amount == 0 or (told is not None and told >= 0 and self.amount in (None, told)):
            return
        said = f"{self.amount:g}" if self.amount is not None else "PRICE"
        known = "" if self.amount is not None else ", with PRICE as the service's own list has it"
        raise MintError(
            f"it costs money that was not confirmed: {self.text()}", code="price", place=place,
            next_move=f"if you are willing to pay, ask again with --confirm-price {said}{known}; {OR_SCULPT}",
        )  # fmt: skip


@dataclass(frozen=True)
class Terms:
    """How a server is come by, and what it costs."""

    variable: str
    """Of the environment: holds its address."""
    starting: str
    """How a user comes by one, in a few words."""
    address: str = ""
    """Where it listens if nothing else is said; empty for one that a user runs."""
    key_variable: str = ""
    """Of the environment: holds the key to it."""
    key_header: str = "Authorization"
    price: Price = Price()

    def ready(self) -> bool:
        """Whether the environment names all that it needs."""
        named = self.address or os.environ.get(self.variable)
        return bool(named and (not self.key_variable or os.environ.get(self.key_variable)))

    def server(self, name: str, address: str | None = None) -> Server:
        """It, at an address, or where the environment has it.

        Raises:
            NotFoundError: no address is named anywhere.
            MintError: `no_key`: the environment does not hold the key.
        """
        where = address or os.environ.get(self.variable, "") or self.address
        if not where:
            raise NotFoundError(
                f"no {name} server is named", place=f"--address, or {self.variable}",
                next_move=f"{self.starting}; {OR_SCULPT}",
            )  # fmt: skip
        key = os.environ.get(self.key_variable, "").strip() if self.key_variable else ""
        if self.key_variable and (not key or not key.isascii() or not key.isprintable()):
            raise MintError(
                f"{self.key_variable} holds no key for {name}", code="no_key", place=self.key_variable,
                next_move=f"{self.starting}; {OR_SCULPT}",
            )  # fmt: skip
        return Server(where, self.starting, key, self.key_header)


@dataclass
class Order:
    """One piece of work at a server: it is begun once, even if whoever asked for it went away meanwhile."""

    file: Path
    """Where the work's name at the server is kept until its fruit is here."""
    hears: Callable[[str], None] = lambda _said: None
    said: list[str] = field(default_factory=list)
    """What is to be told of it afterwards."""

    def begun(self, begin: Callable[[], str]) -> str:
        """The work's name: of what was begun before, or what is begun now."""
        kept = self.file.read_text(encoding="utf-8").strip() if self.file.is_file() else ""
        if kept:
            return kept
        name = begin()
        with writing("what was ordered", self.file):
            write_atomic(self.file, name.encode())
        return name

    def done(self) -> None:
        """Forget the work: it is here, or the server has given it up."""
        self.file.unlink(missing_ok=True)

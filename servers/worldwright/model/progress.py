"""How long work reports its progress, whatever transport listens."""

from typing import Protocol


class Progress(Protocol):
    """Called with the amount done, the total (0 when unknown) and a short message."""

    def __call__(self, done: float, total: float, message: str = "") -> None:
        """Report `done` of `total`."""
        ...


def silent(done: float, total: float, message: str = "") -> None:
    """Report to nobody."""

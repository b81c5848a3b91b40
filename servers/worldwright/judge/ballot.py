"""Votes on one film, counted field by field: the majority decides, and where half say Yes and half No nothing is decided."""

from collections.abc import Mapping, Sequence

from ..model.errors import WorldwrightError
from ..model.frozen import Frozen
from .criteria import EVENT, OBJECTS


class TieError(WorldwrightError):
    """As many votes say Yes as say No: no verdict is made of it by a coin, nor by an order of the votes."""

    code = "tie"


class Decided(Frozen):
    """The verdict on one film."""

    fields: dict[str, bool]
    yes: dict[str, int]
    """By field, how many of the votes said Yes."""
    votes: int

    @property
    def adheres(self) -> bool:
        """SA: the objects are there and the event happens."""
        return self.fields[OBJECTS] and self.fields[EVENT]

    @property
    def correct(self) -> bool:
        """PC: every key standard holds."""
        return all(held for name, held in self.fields.items() if name not in (OBJECTS, EVENT))

    @property
    def both(self) -> bool:
        """Everything correct."""
        return self.adheres and self.correct


def decide(votes: Sequence[Mapping[str, bool]], fields: Sequence[str], place: str) -> Decided:
    """Count votes that answer the same fields.

    Args:
        votes: answers by field.
        place: the film, for the message.

    Raises:
        TieError: a field has as many Yes as No, which is so also where nobody voted.
    """
    yes = {name: sum(vote[name] for vote in votes) for name in fields}
    if tied := [name for name in fields if 2 * yes[name] == len(votes)]:
        said = ", ".join(f"{name} {yes[name]} of {len(votes)}" for name in tied)
        raise TieError(
            f"the votes are tied: {said}",
            place=place,
            next_move="ask for one vote more, an odd number: worldwright judge run … --votes N; what was voted stays",
        )
    return Decided(fields={name: 2 * yes[name] > len(votes) for name in fields}, yes=yes, votes=len(votes))

"""What a film is judged by, in PhyWorldBench's form: objects, an event, key standards; each field is answered Yes or No.

Source: PhyWorldBench (Gu et al., arXiv 2507.13428), `Basic_Standards` and `Key_Standards`; the reference's paper, "Judging
Protocol and Metrics".
"""

import hashlib

from ..model.errors import WorldwrightError
from ..model.frozen import Frozen

OBJECTS, EVENT, STANDARD = "Objects", "Event", "Standard_"
"""The fields as the benchmark calls them; standards are numbered from 1."""


class CriteriaError(WorldwrightError):
    """A file of criteria cannot be used; `code`: `not_json`, `too_large`, `unreadable`, `incomplete` or `twice`."""

    def __init__(self, cause: str, *, code: str, place: str, next_move: str) -> None:
        super().__init__(cause, place=place, next_move=next_move)
        self.code = code


class Criteria(Frozen):
    """Of one scenario: what must be seen (`objects`, `event`: SA), and what must be physically so (`standards`: PC)."""

    objects: tuple[str, ...]
    event: str
    standards: tuple[str, ...]

    @property
    def fields(self) -> tuple[str, ...]:
        """What is answered, in order: Objects, Event, Standard_1, …"""
        return (OBJECTS, EVENT, *(f"{STANDARD}{number}" for number in range(1, len(self.standards) + 1)))

    @property
    def sha256(self) -> str:
        """Over all of it."""
        return hashlib.sha256(self.model_dump_json().encode()).hexdigest()


class Scenario(Frozen):
    """One row of a benchmark."""

    id: str
    """Its number as it is printed, such as `039`."""
    category: str = ""
    subcategory: str = ""
    prompts: tuple[str, ...] = ()
    """The sentences that films of it are made from, as the set words them."""
    criteria: Criteria

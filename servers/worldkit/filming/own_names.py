"""Whose a name of what a film draws is: its author's, or a set's, which has things of its own."""

import re
from collections.abc import Iterable, Iterator

from ..errors import ProgramError

LONGEST = 60
_NUMBERED = re.compile(r"(.*?)[ _](\d+)")


class OwnNames:
    """The names that are taken, each with the set that took it; empty is the author."""

    def __init__(self) -> None:
        self.owners: dict[str, str] = {}
        self.building = ""
        """The set that is being built."""

    def take(self, name: object) -> None:
        """Take a name.

        Raises:
            ProgramError: it is none, or something else has it.
        """
        if not isinstance(name, str) or not 0 < len(name) <= LONGEST:
            raise ProgramError(f"what is drawn needs a name of its own, not {name!r}", "film.py", "name it anew")
        if name not in self.owners:
            self.owners[name] = self.building
            return
        owner = self.owners[name]
        cause, move = f"what is drawn needs a name of its own, not {name!r}", "name it anew"
        if owner != self.building:
            kind = owner or self.building
            cause += f", which the set {kind!r} gives to what it draws itself"
            move = "name yours otherwise"
            if owner:
                move += f"; the set has {', '.join(_shortly(n for n, of in self.owners.items() if of == owner))}"
        raise ProgramError(cause, "film.py", move)


def _shortly(names: Iterable[str]) -> Iterator[str]:
    """Names, those that only a number tells apart as one."""
    counted: dict[str, int] = {}
    for name in names:
        stem = found[1] if (found := _NUMBERED.fullmatch(name)) else name
        counted[stem] = counted.get(stem, 0) + 1
    for stem, count in counted.items():
        yield f"'{stem} 1' to '{stem} {count}'" if count > 1 else repr(stem)

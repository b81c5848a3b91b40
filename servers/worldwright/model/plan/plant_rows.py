"""Plants as rows of a plan: `type: plant`, whose root is held and whose limbs bend; `worldkit.plants` owns the numbers of each kind."""

from typing import TYPE_CHECKING, Literal

from pydantic import model_validator

from ..frozen import Frozen
from . import numbered_kind

if TYPE_CHECKING:
    from worldkit.plants import Plant as Made

Kind = Literal["bough", "tree", "bush"]


class Plant(Frozen):
    """What an asset of type `plant` is."""

    kind: Kind
    numbers: dict[str, int | float] = {}
    """What differs from the kind's own numbers, by their names in `worldkit.plants`."""
    source: str = ""
    """Where `numbers` come from."""

    @model_validator(mode="after")
    def _can_grow(self) -> "Plant":
        if self.numbers and not self.source.strip():
            raise ValueError("its `numbers` need a `source`: the prompt, a table, a measurement")
        self.made()
        return self

    def made(self) -> "Made":
        """The plant, of `worldkit.plants`.

        Raises:
            ValueError: a number that it does not have, or one with which none can grow.
        """
        not_its = frozenset({"height_m" if self.kind == "bough" else "length_m"})
        plant: Made = numbered_kind.made("worldkit.plants", self.kind, tuple(sorted(self.numbers.items())), not_its)
        try:
            _ = plant.limbs  # grown once, and kept with it
        except (ZeroDivisionError, IndexError) as error:
            raise ValueError(f"a {self.kind} cannot be grown of these numbers: {error}") from error
        return plant

"""Plants as rows of a plan: `type: plant`, whose root is held and whose limbs bend; `worldkit.plants` owns the numbers of each kind."""

from dataclasses import fields
from difflib import get_close_matches
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Literal

from pydantic import model_validator

from ..frozen import Frozen

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
        return _made(self.kind, tuple(sorted(self.numbers.items())))


@lru_cache(maxsize=64)
def _made(kind: str, numbers: tuple[tuple[str, Any], ...]) -> "Made":
    from worldkit import plants

    made = getattr(plants, kind.capitalize())
    known = {field.name for field in fields(made)} - {"height_m" if kind == "bough" else "length_m"}
    for name, _ in numbers:
        if name not in known:
            near = get_close_matches(name, known, n=1)
            hint = f"did you mean `{near[0]}`?" if near else f"it has: {', '.join(sorted(known))}"
            raise ValueError(f"a {kind} has no number `{name}`: {hint}")
    try:
        plant: Made = made(**dict(numbers))
        _ = plant.limbs
    except (TypeError, ZeroDivisionError, IndexError) as error:
        raise ValueError(f"a {kind} cannot be grown of these numbers: {error}") from error
    return plant

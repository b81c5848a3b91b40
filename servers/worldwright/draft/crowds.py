"""Name the copies of one object together: a crowd is written once, as a constant of the program, however many lists name it."""

from collections.abc import Sequence

from ..model.plan.committed import Plan
from .python_text import Raw, constant_name, literal

CROWD = 8
"""So many copies of one object are a crowd."""


class Crowds:
    """The crowds of a plan, and which of them the program names."""

    def __init__(self, plan: Plan) -> None:
        said = (*plan.simulation_parameters.constants, *plan.simulation_parameters.materials)
        self._families, self._constants, taken = plan.families, dict[str, str](), {constant_name(name) for name in said}
        for family, names in plan.families.items():
            constant = f"{constant_name(family)}_NAMES"
            if len(names) >= CROWD and constant not in taken:
                self._constants[family] = constant
                taken.add(constant)
        self._named: set[str] = set()

    def listed(self, names: Sequence[str]) -> Raw:
        """A tuple of names, in which a crowd's constant stands for its copies where all follow each other."""
        items, rest = list[str](), tuple(names)
        while rest:
            whole = (f for f in self._constants if rest[: len(self._families[f])] == self._families[f])
            if (family := next(whole, None)) is None:
                items.append(literal(rest[0]))
                rest = rest[1:]
                continue
            self._named.add(family)
            items.append(f"*{self._constants[family]}")
            rest = rest[len(self._families[family]) :]
        if len(items) == 1:
            return Raw(items[0].removeprefix("*") if items[0].startswith("*") else f"({items[0]},)")
        return Raw(f"({', '.join(items)})")

    def written(self) -> str:
        """The constants of the crowds that were listed, in plan order."""
        return "".join(
            f'{constant} = tuple(f"{family}_{{n}}" for n in range(1, {len(self._families[family]) + 1}))\n'
            for family, constant in self._constants.items()
            if family in self._named
        )

"""What a plan declares to act on the state besides the engine's own step, and the constants of its laws."""

import re
from collections.abc import Mapping
from typing import Any, Literal

from pydantic import Field, model_validator

from ..frozen import Frozen

RATE = r"(?!\s*/|\s*[·*]?\s*s\b|\s+per\s+(?:unit|[kcm]?[msg]|rad|deg|met|sec|turn))"
"""Behind a force or a torque of its own: not of a spring's or a damper's (`N/m`, `N s/m`, `N per m`, `N m/rad`)."""
POWER = r"[-−+]?\d[\d.]*(?:[eE][-+]?\d+)?"
TWO_WAYS = re.compile(
    rf"(?:(?<![\w.])\d[\d.]*(?:(?P<product>\s?[/×·*x]\s?)|\s?\^\s?|,){POWER}|\d⁻?[⁰¹²³⁴-⁹]+)"
    r"\s*(?P<unit>[kKcmM]?(?:N|Pa|m/s|rad/s|kg/m)(?!\w))"
)
"""Numbers that a reader and we would read otherwise: a decimal comma, a fraction, a product, a power of ten in words."""
FREE_PRODUCT = re.compile(rf"(?P<unit>[kKcmM]?N(?!\w))(?!{RATE})|kg/m")
"""Units of which a product holds nobody to its last number: of a spring, a damper, a density (`0.5 * 1.2 kg/m^3`)."""


def two_ways(law: str, kind: str) -> str:
    """The first number of a law of this kind that reads in two ways; empty where none does.

    A product or fraction (`1/2 * 40 N/m`) is one only where we would hold the world to its last factor.
    """
    for found in TWO_WAYS.finditer(law):
        free = FREE_PRODUCT.match(law, found.start("unit")) if found["product"] else None
        if free is None or (not free["unit"] and kind == "parameter"):
            return found[0]
    return ""


class Constant(Frozen):
    """A named physical constant with its unit and source."""

    value: float | tuple[float, ...]
    unit: str
    source: str


class Beside(Frozen):
    """What steps beside the engine: a solver of the suite (`worldengine.solvers`), or with a `file` the author's own law."""

    name: str
    file: str = ""
    """The author's, beside the program: `laws/rubber.py` (`worldkit.laws`)."""
    constants: dict[str, str] = {}
    """What it reads, by its own names: each the name of a row of `constants`."""
    container: str = ""
    """Of water: the object that holds it, which the draft fills up to its `level` (`worldkit.waters`)."""
    shown_by: str = ""
    """An object that is `visual_only` and shows it: the water's surface, the flex or the geoms that a law moves."""


class Live(Frozen):
    """What acts in a live drive where its driver says nothing."""

    failsafe: Literal["hold", "brake"] | float | None = None
    """`hold`: the last command; `brake`: a car brakes, with its wheels steered as they are, and any other control is 0; a number: of
    what is no car. None: a servo of position holds, all else brakes."""
    timeout_s: float = Field(0.5, gt=0)
    """It acts so long after the last word, s of the wall clock; at once where the driver leaves."""
    ends_after_s: float | None = Field(None, gt=0)
    """So long after the last word the drive ends, s; None: never for that."""


class Intervention(Frozen):
    """Something the plan means to do to the state besides the engine's own step."""

    kind: Literal["force", "torque", "control", "pose", "velocity", "mocap", "constraint", "parameter", "solver"]
    bodies: tuple[str, ...]
    law: str
    """The law in words or a formula."""
    trigger: str = "always"
    source: str
    """Where its constants come from."""
    solver: Beside | None = None
    """Of the kind `solver`: the one beside the engine that works it out. None: the program's `control` does."""

    live: Live | None = None
    """Of the kind `control`: what acts in a live drive (`worldwright live`) where its driver falls silent."""

    @model_validator(mode="after")
    def _of_its_kind(self) -> "Intervention":
        if self.live is not None and self.kind != "control":
            raise ValueError(f"a row of kind `{self.kind}` has no `live`: nobody drives it; use the kind `control`")
        if self.solver is not None and self.kind != "solver":
            raise ValueError(f"a row of kind `{self.kind}` has no `solver`; use the kind `solver`")
        if found := two_ways(self.law, self.kind):
            raise ValueError(
                f"its law has the number `{found}`, which reads in two ways; write it as 1011 or 0.01 or 1e-2"
            )
        return self

    def beside(self, constants: Mapping[str, Constant]) -> dict[str, Any]:
        """What the engine is told of its solver, with the values of its constants; empty where it has none."""
        if self.solver is None:
            return {}
        if self.solver.file:
            return {"law": {"name": self.solver.name, "file": self.solver.file, "shown_by": self.solver.shown_by}}
        values = {own: constants[name].value for own, name in self.solver.constants.items() if name in constants}
        return {"solver": {"name": self.solver.name, "constants": values, "shown_by": self.solver.shown_by}}

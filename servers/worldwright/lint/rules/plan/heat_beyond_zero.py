"""A source of heat takes more from a body than there is.

What it does: adds up, for each body of the solver `heat` whose `source` is below 0, all the heat that it has above 0 K, that air can
bring over its surface until the end, and that the other bodies of the row have and get where they conduct; and compares it with what
the source takes until then. Bodies without a mass in the plan, or cooled over a surface that is no plain shape's, are left to the scan.

Why is this bad: a source does not ask what is left. The temperature falls below 0 K, which nothing has, and draws heat from all it touches.

Use instead: a smaller source, a shorter simulation, or a `cooling` to something cold, which ends by itself.
"""

from collections.abc import Iterator, Mapping
from typing import Any

from ....model.plan.declared_inputs import Constant, Intervention
from ...case import Changes
from ...harm import Measured
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP136"
SEVERITY = "error"
UNITS = {
    "warm": "K", "around": "K", "specific_heat": "J/(kg K)", "cooling": "W/(m^2 K)", "contact": "W/K", "source": "W",
    "latent": "J/kg", "melts": "K", "expansion": "1/K",
}  # fmt: skip
CONVEX = ("box", "sphere", "ellipsoid", "cylinder", "capsule", "cone", "wedge")
"""No larger on their surface than the box around them."""
ALSO = {"mug": 0.35, "crate": 2.0, "stove": 2.0}


def _heated(**told: Any) -> dict[str, Any]:
    """A crate and a stove of 2 kg, from 300 K on, for 3 s."""
    numbers = {"warm": 300.0, "around": 290.0, "specific_heat": 500.0, **told}
    constants = {name: {"value": value, "unit": UNITS[name], "source": "a table"} for name, value in numbers.items()}
    ramp = {"name": "ramp", "primitive": "box", "size": [2, 1, 0.2], "fixed": True, "dynamic": False}
    crate = {"name": "crate", "primitive": "box", "size": [0.4, 0.3, 0.2], "material": "wood"}
    row = {"kind": "solver", "bodies": ["crate", "stove"], "law": "Newton", "source": "a table"}
    said = {"name": "heat", "constants": {name: name for name in numbers}}
    return {
        "scene_objects": [ramp, crate, {**crate, "name": "stove"}],
        "simulation_parameters": {"masses": ALSO, "constants": constants, "interventions": [{**row, "solver": said}]},
    }


GOOD: Changes = (
    _heated(),
    _heated(source=(-9e4, 0.0)),
    _heated(source=(-1.1e5, 0.0), cooling=1000.0),
    _heated(source=(-1.1e5, 0.0), contact=1e4),
    _heated(source=1e6),
)
BAD: Changes = (
    _heated(source=(-1.1e5, 0.0)),
    _heated(source=-1.1e5, contact=1e4),
    _heated(source=(0.0, -2e5), cooling=10.0),
)


def _coldest(change: Mapping[str, Any]) -> float:
    """K: the coldest body of a case after its 3 s, by the solver's own law."""
    import numpy as np

    from worldkit.fields.lumped_heat import Warmth

    told = {name: row["value"] for name, row in change["simulation_parameters"]["constants"].items()}

    def each(name: str) -> np.ndarray:
        return np.broadcast_to(np.asarray(told.get(name, 0.0), float), 2).copy()

    loss, never = each("cooling") * 0.52, np.full(2, np.inf)
    warmth = Warmth(each("warm"), 2.0 * each("specific_heat"), loss, 290.0, each("source"), never, np.zeros(2))
    contact = told.get("contact", 0.0) * (1 - np.eye(2))
    for _ in range(300):
        warmth.advance(0.01, contact)
    return float(warmth.temperature.min())


EVIDENCE = Measured("a body is colder than anything can be", _coldest, 40.0, "K", good=1)


def check(view: PlanView) -> Iterator[Problem]:
    """Check every row of the solver."""
    parameters = view.plan.simulation_parameters
    if isinstance(parameters.simulation_duration, str):
        return
    for index, row in enumerate(parameters.interventions):
        if row.solver is None or row.solver.file or row.solver.name != "heat":
            continue
        told = {
            own: _each(parameters.constants[name], row)
            for own, name in row.solver.constants.items()
            if name in parameters.constants
        }
        for body, takes, most in _taken(view, row, told, float(parameters.simulation_duration)):
            what = f"the source of {body} takes {takes:.3g} J until the end, and there are at most {most:.3g} J to take"
            fix = "give it a smaller source, or let it cool to something cold: nothing is below 0 K"
            yield view.at(("simulation_parameters", "interventions", index), what, fix)


def _each(told: Constant, row: Intervention) -> tuple[float, ...]:
    """A constant for each body."""
    return told.value if isinstance(told.value, tuple) else (told.value,) * len(row.bodies)


def _taken(
    view: PlanView, row: Intervention, told: dict[str, tuple[float, ...]], seconds: float
) -> Iterator[tuple[str, float, float]]:
    """Body, what its source takes and what there is at most, J, of each for which that is known and too little."""
    count, none = len(row.bodies), (0.0,) * len(row.bodies)
    if {len(told.get(name, none)) for name in UNITS} != {count}:
        return  # another rule says that the numbers do not fit the bodies
    source, around = told.get("source", none), told.get("around", none)
    has: list[float] = []
    for n, body in enumerate(row.bodies):
        area = _surface(view, body) if told.get("cooling", none)[n] > 0 else 0.0
        heat = told.get("warm", none)[n] * told.get("specific_heat", none)[n] + told.get("latent", none)[n]
        air = told.get("cooling", none)[n] * around[n] * seconds
        mass = view.plan.simulation_parameters.masses.get(body)
        has.append(mass * heat + (air * area if air else 0.0) if mass is not None else float("inf"))
    shared = sum(own + max(power, 0.0) * seconds for own, power in zip(has, source, strict=True))
    touching = count > 1 and told.get("contact", none)[0] > 0
    for n, body in enumerate(row.bodies):
        most = (
            shared - sum(max(-power, 0.0) * seconds for m, power in enumerate(source) if m != n) if touching else has[n]
        )
        if source[n] < 0 and -source[n] * seconds > max(most, 0.0):
            yield body, -source[n] * seconds, max(most, 0.0)


def _surface(view: PlanView, body: str) -> float:
    """m^2: no body of that box and kind has more; infinite where that is not known."""
    thing = view.rows.get(body)
    size = getattr(thing, "size", None)
    if size is None or getattr(thing, "primitive", "") not in CONVEX:
        return float("inf")
    x, y, z = size
    return float(2 * (x * y + y * z + z * x))

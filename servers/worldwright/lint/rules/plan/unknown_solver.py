"""A solver beside the engine does not exist, or is not given what it reads.

What it does: for each row of `interventions` with a `solver`: compares its name with the solvers that are installed, its
`constants` with what that solver reads, each with the plan's constant of that name, its unit and how many numbers it has, its `bodies`
with the plan's objects (those that move, but of a field or of heat), and `shown_by` with the objects that are only drawn. A row with a `file` is the author's own law: the file
is called after it, it has no `constants` (they stand in the file), its `bodies` are objects of the plan or `world`, each named once,
something shows it, and it is the only row of its name. A `container` is an object that stands still, filled to a `level`, and shown.

Why is this bad: the physics pass refuses the world when it starts; and a constant in another unit gives another world,
without a word.

Use instead: the solver's own names, each with the name of a row of `simulation_parameters.constants` in the unit that it reads.
"""

from collections.abc import Iterator, Mapping
from typing import Any

from worldkit.laws import WORLD

from ....model.plan.declared_inputs import Beside, Constant, Intervention
from ....model.plan.imported import inner
from ...case import Changes
from ...harm import Measured
from ...plan_view import Place, PlanView
from ...problem import Problem

CODE = "WP130"
SEVERITY = "error"
_READ = {"density": "kg/m^3", "area": "m^2", "floor": "m", "volume": "m^3", "inflow": "m^3/s", "damping": "1/s"}


def _with(bodies: tuple[str, ...] = ("crate",), **solver: Any) -> dict[str, Any]:
    constants = {name: {"value": 1.0, "unit": unit, "source": "the prompt's bath"} for name, unit in _READ.items()}
    said = {"name": "basin", "constants": {name: name for name in _READ}, **solver}
    row = {"kind": "solver", "bodies": bodies, "law": "Archimedes", "source": "the prompt's bath", "solver": said}
    return {"simulation_parameters": {"constants": constants, "interventions": [row]}}


def _law(bodies: tuple[str, ...] = ("crate",), **solver: Any) -> dict[str, Any]:
    said = {"name": "rubber", "file": "laws/rubber.py", **solver}
    row = {"kind": "solver", "bodies": bodies, "law": "Hooke", "source": "the prompt's band", "solver": said}
    return {"simulation_parameters": {"interventions": [row]}}


def _banded(*bodies: str) -> dict[str, Any]:
    """A law that is shown."""
    ramp = {"name": "ramp", "primitive": "box", "size": [2, 1, 0.2], "fixed": True, "dynamic": False}
    crate = {"name": "crate", "primitive": "box", "size": [0.4, 0.3, 0.2], "material": "wood"}
    band = {**ramp, "name": "band", "visual_only": "what the law moves"}
    return {"scene_objects": [ramp, crate, band], **_law(bodies, shown_by="band")}


def _twice(plan: dict[str, Any]) -> dict[str, Any]:
    """Its rows once more."""
    return {**plan, "simulation_parameters": {"interventions": plan["simulation_parameters"]["interventions"] * 2}}


HAND = {"name": "hand", "type": "sculpt", "filename": "sculpt/hand.py", "size": [0.2, 0.1, 0.1], "material": "wood"}
NAMELESS = {"kind": "solver", "bodies": ["crate"], "law": "3 N of air", "source": "a table"}


def _filled(container: str = "ramp", level: str = "level", **ramp: Any) -> dict[str, Any]:
    """Water in a container."""
    objects = _banded("crate")["scene_objects"]
    objects[0] = {**objects[0], **ramp}
    constants = {
        "density": {"value": 998, "unit": "kg/m^3", "source": "CRC"},
        "level": {"value": 0.1, "unit": "m", "source": "the prompt"},
    }
    told = {"density": "density"} | ({"level": level} if level else {})
    said = {"name": "water", "container": container, "constants": told, "shown_by": "band"}
    row = {"kind": "solver", "bodies": ["crate"], "law": "Archimedes", "source": "the prompt's bath", "solver": said}
    return {"scene_objects": objects, "simulation_parameters": {"constants": constants, "interventions": [row]}}


def _charged(*charges: float, bodies: tuple[str, ...] = ("crate", "ramp")) -> dict[str, Any]:
    """Charges on a crate and on what stands fast, one of each."""
    change = _banded("crate")
    constants = {"charges": {"value": charges, "unit": "C", "source": "the prompt"}}
    said = {"name": "charges", "constants": {"charge": "charges"}}
    row = {"kind": "solver", "bodies": bodies, "law": "Coulomb", "source": "constants.charges", "solver": said}
    return {**change, "simulation_parameters": {"constants": constants, "interventions": [row]}}


GOOD: Changes = (
    {},
    _with(),
    _banded("crate"),
    _banded("crate", "world"),
    {**_banded("crate", "hand_thumb"), "assets": [HAND]},
    _filled(),
    _charged(1e-6, -2e-6),
)
BAD: Changes = (
    _with(name="tide"),
    _with(constants={}),
    _with(constants={**{name: name for name in _READ}, "salt": "density"}),
    _with(constants={**{name: name for name in _READ}, "area": "acreage"}),
    _with(constants={**{name: name for name in _READ}, "area": "volume"}),
    _with(shown_by="crate"),
    _with(bodies=("whale",)),
    {"simulation_parameters": {"interventions": [NAMELESS]}},
    _law(),  # nothing shows it
    _banded("crate", "whale"),
    _law(name="honey", shown_by="crate"),
    _law(file="/tmp/rubber.py"),
    _banded("crate", "crate"),
    _twice(_banded("crate")),
    _filled("lake"),
    _filled("crate"),
    _filled(level=""),
    _charged(1e-6, -2e-6, 0.0),
    _charged(1e-6, -2e-6, bodies=("crate", "whale")),
)


def _taken(change: Mapping[str, Any]) -> float:
    """1 when the engine's process takes the case's solver, else 0."""
    from worldengine.solvers import Row, check
    from worldkit.errors import ProgramError

    parameters = change["simulation_parameters"]
    row = Intervention.model_validate(parameters["interventions"][0])
    told = {name: Constant.model_validate(value) for name, value in parameters["constants"].items()}
    try:
        check(Row.read({"bodies": row.bodies, **row.beside(told)}))
    except ProgramError:
        return 0.0
    return 1.0


EVIDENCE = Measured("the engine refuses the solver", _taken, 0.5, good=1)


def check(view: PlanView) -> Iterator[Problem]:
    """Check every row of a solver."""
    parameters = view.plan.simulation_parameters
    for index, row in enumerate(parameters.interventions):
        place = ("simulation_parameters", "interventions", index)
        if row.solver is not None:
            yield from _row_problems(view, row, place)
        elif row.kind == "solver":
            what = f"the solver on {', '.join(row.bodies)} has no name, so that nothing steps it"
            yield view.at(
                place, what, "name it under `solver`; for a law that `control` computes, declare its force or torque"
            )


def _row_problems(view: PlanView, row: Intervention, place: Place) -> Iterator[Problem]:
    from worldengine.solvers import SEAM, odd_list, reads

    said, rows = row.solver, view.rows
    assert said is not None
    drawn = {name for name, thing in rows.items() if getattr(thing, "visual_only", None) is not None}
    if said.file:
        yield from _law_problems(view, row, said, drawn, place)
        return
    if said.name not in SEAM.names():
        yield view.at(place, f"there is no solver `{said.name}`", f"name one of: {', '.join(SEAM.names())}")
        return
    must, read = SEAM.find(said.name).CONSTANTS, reads(SEAM.find(said.name))
    own = view.plan.simulation_parameters.constants
    listed = ", ".join(f"{name} ({unit}: {meaning})" for name, (unit, meaning) in read.items())
    for name in sorted({*read, *said.constants}):
        if name not in said.constants and name not in must:
            continue
        if name not in said.constants:
            yield view.at(place, f"`{said.name}` is not told its {name}", f"it reads {listed}")
        elif name not in read:
            yield view.at(place, f"`{said.name}` has no use for `{name}`", f"it reads {listed}")
        elif (found := own.get(said.constants[name])) is None:
            what = f"the {name} of `{said.name}` is `{said.constants[name]}`, which is no constant of the plan"
            yield view.at(place, what, f"known: {', '.join(own) or '(none)'}")
        elif found.unit != read[name][0]:
            what = f"`{said.name}` reads its {name} in {read[name][0]}, and {said.constants[name]} is in {found.unit}"
            yield view.at(place, what, f"give it in {read[name][0]}")
        elif isinstance(found.value, tuple) and (
            odd := odd_list(SEAM.find(said.name), name, found.value, len(row.bodies))
        ):
            yield view.at(place, f"`{said.name}` {odd}", "give one number, or where it reads that one for each body")
    standing = getattr(SEAM.find(said.name), "STANDING", False)
    for body in row.bodies:
        if body not in rows or not (standing or view.moves(rows[body])):
            yield view.at(place, f"`{said.name}` acts on `{body}`, which does not move", "name objects that can move")
    if said.container:
        yield from _container_problems(view, said, place)
    if said.shown_by and said.shown_by not in drawn:
        what = f"`{said.name}` is shown by `{said.shown_by}`, which is no object that is only drawn"
        yield view.at(place, what, "name one with `visual_only`: what is simulated is not moved by a picture")


def _container_problems(view: PlanView, said: Beside, place: Place) -> Iterator[Problem]:
    if "level" not in said.constants:
        yield view.at(
            place, f"`{said.name}` has no level, up to which to fill `{said.container}`", "leave `container` out"
        )
    if (holds := view.rows.get(said.container)) is None:
        what = f"`{said.name}` fills `{said.container}`, which the plan does not have"
        yield view.at(place, what, "name an object that holds it")
    elif view.moves(holds):
        what = f"`{said.name}` fills `{said.container}`, which can move, and its water could not"
        yield view.at(place, what, "give it `fixed: true`")
    if not said.shown_by:
        what = f"nothing shows the water in `{said.container}`"
        yield view.at(place, what, "name an object with `visual_only` in `shown_by`, as large as the water")


def _law_problems(view: PlanView, row: Intervention, said: Beside, drawn: set[str], place: Place) -> Iterator[Problem]:
    parts = said.file.split("/")
    if parts[-1] != f"{said.name}.py" or ".." in parts or not parts[0]:
        what = f"the law `{said.name}` has the file `{said.file}`"
        yield view.at(place, what, f"name a file beside the program that is called after it: `laws/{said.name}.py`")
    if said.constants:
        what = f"the law `{said.name}` is told constants, which nobody reads to it"
        yield view.at(place, what, "write them into its file, and their origin into `source`")
    laws = [one.solver.name for one in view.plan.simulation_parameters.interventions if one.solver and one.solver.file]
    if laws.count(said.name) > 1:
        what = f"the law `{said.name}` has two rows, of which the program could give only one"
        yield view.at(place, what, "write one row, with all its bodies")
    for body in dict.fromkeys(row.bodies):
        if row.bodies.count(body) > 1:
            yield view.at(
                place, f"`{said.name}` acts on `{body}` twice", "name it once: its forces are one row for each body"
            )
        if (
            body != WORLD and body not in view.rows and not body.startswith(inner(view.plan))
        ):  # a part of a sculpture is known later
            yield view.at(
                place, f"`{said.name}` acts on `{body}`, which the plan does not have", "name its objects, or `world`"
            )
    if said.shown_by not in drawn:
        what = f"the law `{said.name}` is shown by `{said.shown_by}`, which is no object that is only drawn"
        yield view.at(
            place, what, "name one with `visual_only`: the flex, or the body with geoms, whose points it moves"
        )

"""What a solver beside the engine reads of a body's shape is not what it would read of the plan's.

What it does: of each body that is a magnet, compares its magnetisation with that of its draft: which way it points at the start, sign
and all (half a degree), how much of it there is (3 %), and where (3 % of the body and 1 mm); of soft iron how much and where; of each tube
that conducts its radii, wall, length, axis and middle, of each plate its three sizes and how it lies (3 %). Of each body that cools, its
surface (5 %), and of each that water lifts its volume (1 %), by kinds of geoms. Of water its level and floor (1 % of the depth), its
area (3 %) and middle, by what shows it.

Why is this bad: a bar turned end to end in its own box attracts what it should push away, and has the same size, mass and inertia. A
drawn mesh that touches nothing has no mass, and what it is drawn on cools over it. A small pipe that is a millimetre narrower outside
and inside is as heavy, is as large as sizes are compared, and brakes a magnet half as hard again. A block a fortieth larger each way,
with the plan's mass and inertia, floats where the plan's sinks. What shows water only is drawn, and nothing else holds it against the plan.

Use instead: geoms that lie as the plan's primitive does; decoration that is no mesh, or in the film.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from worldkit.fields.filaments import axis_of

from .....model.plan.declared_inputs import Constant
from ....compiled.view import ModelView
from ....harm import Measured, outcome_of
from ....problem import Problem
from ._twins import changed, shown, twins

CODE = "WM176"
SEVERITY = "error"
SCOPE = "acts"
BAR = (
    "bodies.box(spec, 'bar', size=(0.3, 0.1, 0.1), pos=(0, 3, 0.05), mass=2, surface=SURFACE)",
    "bodies.box(spec, 'stove', size=(0.3, 0.2, 0.1), pos=(0, 4, 0.05), mass=2, surface=SURFACE)",
)
TURNED = "spec.body('bar').geoms[0].quat = (0, 0, 0, 1)"
HALVES = (
    "g = spec.body('bar').geoms[0]; g.size, g.pos, g.mass = (0.075, 0.05, 0.05), (-0.075, 0, 0), 1",
    "spec.body('bar').add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=g.size, pos=(0.075, 0, 0), mass=1, quat=QUAT, **SURFACE)",
)
FIN = (
    "spec.add_mesh(name='fin', uservert=[0, 0, 0, .5, 0, 0, 0, .5, 0, 0, 0, .5])",
    "spec.body('stove').add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname='fin', contype=0, conaffinity=0, mass=0)",
)
PAINT = "spec.body('stove').add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.2, 0.2, 0.2), contype=0, conaffinity=0, mass=0)"


def _fields(*lines: str, bar: str = BAR[0]) -> tuple[str, dict[str, object]]:
    """A case with a magnet and something hot, as the plan has them but for these statements."""
    text, plan = changed(bar, BAR[1], *lines)
    boxes = {"bar": [0.3, 0.1, 0.1], "stove": [0.3, 0.2, 0.1]}
    rows = [{"name": name, "primitive": "box", "size": size, "material": "wood"} for name, size in boxes.items()]
    topology, parameters = plan["topology"], plan["simulation_parameters"]
    assert isinstance(topology, dict) and isinstance(parameters, dict)
    places = topology["body_positions"] | {"bar": {"x": 0, "y": 3, "z": 0.05}, "stove": {"x": 0, "y": 4, "z": 0.05}}
    units = {"remanence": "T", "warm": "K", "around": "K", "specific_heat": "J/(kg K)", "cooling": "W/(m^2 K)"}
    constants = {name: {"value": 1.0, "unit": unit, "source": "a table"} for name, unit in units.items()}
    heat = {name: name for name in units if name != "remanence"}
    told = (("magnets", "bar", {"remanence": "remanence"}), ("heat", "stove", heat))
    beside = [
        {"kind": "solver", "bodies": [body], "law": "a field", "source": "a table", "solver": {"name": name, "constants": own}}
        for name, body, own in told
    ]  # fmt: skip
    return text, plan | {
        "scene_objects": [*plan["scene_objects"], *rows],  # type: ignore[misc]
        "topology": topology | {"body_positions": places},
        "simulation_parameters": parameters
        | {"masses": parameters["masses"] | {"bar": 2, "stove": 2}, "constants": constants, "interventions": beside},
    }


HALVED, OPPOSED = ((HALVES[0], HALVES[1].replace("QUAT", quat)) for quat in ("(1, 0, 0, 0)", "(0, 0, 0, 1)"))
PIPE = "bodies.formed(spec, 'bar', form=forms.tube(path=[(0, 0, -0.05), (0, 0, 0.05)], diameter={}, wall={}), pos=(0, 3, 0.05), mass=2, surface=SURFACE)"
PLATE = "bodies.box(spec, 'bar', size=(0.3, 0.1, {}), pos=(0, 3, 0.05), mass=2, surface=SURFACE)"
ROW: dict[str, object] = {"material": "wood", "name": "bar"}
TUBE: dict[str, object] = {
    **ROW,
    "primitive": "tube",
    "path": [[0, 0, -0.05], [0, 0, 0.05]],
    "diameter": 0.019,
    "wall_thickness": 0.002,
}
SHEET: dict[str, object] = {**ROW, "primitive": "box", "size": [0.3, 0.1, 0.002]}


def _conducts(row: dict[str, object], bar: str, *lines: str) -> tuple[str, dict[str, object]]:
    """A case with something that conducts, built by these statements."""
    text, plan = _fields(*lines, bar=bar)
    text = text.replace("import bodies", "import bodies, forms", 1)
    rows: list[dict[str, object]] = plan["scene_objects"]  # type: ignore[assignment]
    known: dict = plan["simulation_parameters"]  # type: ignore[assignment]
    constants = known["constants"] | {"conducts": {"value": 5.8e7, "unit": "S/m", "source": "a table"}}
    beside = known["interventions"][0] | {"solver": {"name": "magnets", "constants": {"conductivity": "conducts"}}}
    return text, plan | {
        "scene_objects": [row if other["name"] == "bar" else other for other in rows],
        "simulation_parameters": known | {"constants": constants, "interventions": [beside]},
    }


def _filled(filled: str, *lines: str) -> tuple[str, dict[str, object]]:
    """A case with a trough that is filled so; by the plan to 0.2 m, and a crate is named that it may lift."""
    walls = "spec, 'trough', size=(0.6, 0.4, 0.3), wall=0.02, pos=(0, 6, 0.15), fixed=True, surface=SURFACE"
    text, plan = _fields(f"bodies.container({walls})", filled, *lines)
    text = text.replace("import bodies", "import bodies, waters", 1)
    rows: list[dict[str, object]] = plan["scene_objects"]  # type: ignore[assignment]
    known: dict = plan["simulation_parameters"]  # type: ignore[assignment]
    topology: dict = plan["topology"]  # type: ignore[assignment]
    trough = {"name": "trough", "primitive": "box_container", "size": [0.6, 0.4, 0.3], "wall_thickness": 0.02}
    water = {"name": "water", "primitive": "box", "size": [0.56, 0.36, 0.18], "visual_only": "the solver moves it"}
    told = {
        "name": "water",
        "container": "trough",
        "constants": {"density": "density", "level": "level"},
        "shown_by": "water",
    }
    beside = {"kind": "solver", "bodies": ["crate"], "law": "Archimedes", "source": "a table", "solver": told}
    said = {"density": ("kg/m^3", 998), "level": ("m", 0.2)}
    constants = {name: {"value": value, "unit": unit, "source": "a table"} for name, (unit, value) in said.items()}
    places = {"trough": {"x": 0, "y": 6, "z": 0.15}, "water": {"x": 0, "y": 6, "z": 0.11}}
    return text, plan | {
        "scene_objects": [*rows, *(row | {"fixed": True, "material": "wood"} for row in (trough, water))],
        "topology": topology | {"body_positions": topology["body_positions"] | places},
        "simulation_parameters": known | {"constants": known["constants"] | constants, "interventions": [beside]},
    }


FILL = "waters.fill(spec, 'water', container='trough', level={})"
GOOD = (
    _fields(),
    _filled(FILL.format(0.2)),
    _fields(PAINT),
    _fields(*HALVED),
    _conducts(TUBE, PIPE.format(0.019, 0.002)),
    _conducts(SHEET, PLATE.format(0.002)),
)
BAD = (
    _fields(TURNED),
    _filled(f"f = {FILL.format(0.2)}; f.vert = [c * (0.9 if n % 3 == 0 else 1) for n, c in enumerate(f.vert)]"),
    _filled(FILL.format(0.2) + ".name = 'other'"),
    _filled(FILL.format(0.2), "spec.geom('crate').size = [1.025 * v for v in (0.2, 0.15, 0.1)]"),
    _fields(*OPPOSED),
    _fields(*FIN),
    _conducts(TUBE, PIPE.format(0.01806, 0.00223)),
    _conducts(SHEET, PLATE.format(0.0022)),
)
EVIDENCE = Measured(
    "a field along +x turns it over where the plan's lies still",
    lambda s: float(_along(s)[0]),
    1.0,
    bad=0,
)
NEAR_RAD, SHARE, LEAST_M, SURFACE, LEVEL, DISPLACED = 0.01, 0.03, 1e-3, 0.05, 0.01, 0.01
FIX = "let its geoms lie as the plan's primitive does"


class Magnetised(NamedTuple):
    """A body's magnetisation at the start, for each tesla of its remanence."""

    moment: np.ndarray
    """(3,) m^3, world frame, of all its geoms together."""
    amount: float
    """m^3, whichever way each geom points."""
    middle: np.ndarray
    """(3,) m: of the amount, from the body's frame, in world axes."""


def check(view: ModelView) -> Iterator[Problem]:
    """Check the bodies of the plan's magnets, of its metal and of what cools, and what shows water."""
    planned, plan = view.planned, view.plan
    assert planned is not None and plan is not None
    parameters, both = (
        plan.simulation_parameters,
        {view.texts["names"]["body"][b]: (b, t) for b, t in twins(view, "body")},
    )
    for row in parameters.interventions:
        if row.solver is None or row.solver.file:
            continue
        if said := _shown(view, planned, row.solver.shown_by):
            yield view.of_world(f"{row.solver.shown_by} {said}", FIX, row.solver.shown_by)
        for (name, own), differs in TOLD.items():
            numbers = _each(parameters.constants.get(row.solver.constants.get(own, "")), len(row.bodies))
            for body in (body for body, number in zip(row.bodies, numbers, strict=False) if number):
                if row.solver.name == name and body in both and (said := differs(view, planned, *both[body])):
                    yield view.at("body", both[body][0], f"{body} {said}", FIX)


def _each(told: Constant | None, bodies: int) -> tuple[float, ...]:
    """A constant for each of so many bodies; 0 where the plan does not have it."""
    value = 0.0 if told is None else told.value
    return value if isinstance(value, tuple) else (value,) * bodies


def _pole(view: ModelView, planned: ModelView, body: int, twin: int) -> str:
    """How a magnet differs from the plan's; empty when it does not."""
    here, there = _magnetised(view, body), _magnetised(planned, twin)
    size = float(np.linalg.norm(planned.touch_high[twin] - planned.touch_low[twin]))
    mine, theirs = float(np.linalg.norm(here.moment)), float(np.linalg.norm(there.moment))
    long = mine * theirs
    turn = float(np.arccos(np.clip(here.moment @ there.moment / long, -1.0, 1.0))) if long else 0.0
    amounts = ((here.amount, there.amount), (mine, theirs))
    if turn > NEAR_RAD:
        return f"is magnetised along {_way(here.moment)}, which is {np.degrees(turn):.3g} degrees from the plan's way"
    if any(abs(h - t) > SHARE * t for h, t in amounts):
        return f"has {here.amount * 1e6:.4g} cm^3 of magnet, by the plan {there.amount * 1e6:.4g}, or some of it the other way round"
    if float(np.linalg.norm(here.middle - there.middle)) > max(SHARE * size, LEAST_M):
        return f"has the middle of its magnet at {shown(here.middle)} m from it, by the plan at {shown(there.middle)} m"
    return ""


def _way(moment: np.ndarray) -> str:
    """The direction (3,) of a moment, in world axes."""
    x, y, z = moment / np.linalg.norm(moment)
    return f"({x:.3g}, {y:.3g}, {z:.3g})"


def _solid(view: ModelView, body: int) -> np.ndarray:
    """The geoms that a solver takes for a body: those that collide, or where none does, all."""
    geoms = np.flatnonzero(view.geom_bodyid == body)
    solid = geoms[(view.geom_contype[geoms] | view.geom_conaffinity[geoms]) != 0]
    return np.asarray(solid if len(solid) else geoms)


def _magnetised(view: ModelView, body: int) -> Magnetised:
    """Of the geoms that the solver takes."""
    geoms = _solid(view, body)
    amounts = view.geom_volume[geoms]
    ways = [view.geom_xmat[g][:, axis_of(view.geom_kind[g] == "box", view.geom_size[g])] for g in geoms]
    total = float(amounts.sum())
    away = view.geom_xpos[geoms] - view.xpos[body]
    return Magnetised(amounts @ np.reshape(ways, (-1, 3)), total, amounts @ away / (total or 1.0))


def _iron(view: ModelView, planned: ModelView, body: int, twin: int) -> str:
    """How soft iron differs from the plan's; empty when it does not."""
    here, there = _magnetised(view, body), _magnetised(planned, twin)
    if abs(here.amount - there.amount) > SHARE * there.amount:
        return f"has {here.amount * 1e6:.4g} cm^3 of iron, by the plan {there.amount * 1e6:.4g}"
    if float(np.linalg.norm(here.middle - there.middle)) > SHARE * there.amount ** (1 / 3):
        return f"has the middle of its iron at {shown(here.middle)} m from it, by the plan at {shown(there.middle)} m"
    return ""


def _metal(view: ModelView, planned: ModelView, body: int, twin: int) -> str:
    """How what conducts differs from the plan's; empty when it does not. What is neither a tube nor a plate the solver refuses."""
    mine, theirs = view.body_bore[body], planned.body_bore[twin]
    (here, way), (there, wanted) = (
        ((*tube[:3], tube[1] - tube[0]), tube[3:6]) if tube.any() else _plate(world, own)
        for world, own, tube in ((view, body, mine), (planned, twin, theirs))
    )
    if mine.any() != theirs.any() or any(abs(h - t) > SHARE * t for h, t in zip(here, there, strict=False)):
        kinds = [
            "a tube of inner and outer radius, length and wall" if t.any() else "a plate of" for t in (mine, theirs)
        ]
        return f"conducts as {kinds[0]} {shown(here)} m, by the plan as {kinds[1]} {shown(there)} m"
    if abs(float(way @ wanted)) < np.cos(NEAR_RAD):
        return f"conducts about its {shown(way)}, by the plan about its {shown(wanted)}"
    if theirs.any() and float(np.linalg.norm(mine[6:] - theirs[6:])) > SHARE * theirs[1]:
        return f"has the middle of its tube at {shown(mine[6:])} m from it, by the plan at {shown(theirs[6:])} m"
    return ""


def _plate(view: ModelView, body: int) -> tuple[tuple[float, ...], np.ndarray]:
    """The sizes of a box that conducts, m, thinnest first, and which way it is thin, in its body's frame; nothing of any other shape."""
    geoms = _solid(view, body)
    if len(geoms) != 1 or view.geom_kind[geoms[0]] != "box":
        return (), np.zeros(3)
    size = 2 * view.geom_size[geoms[0]]
    turn = view.xmat[body].T @ view.geom_xmat[geoms[0]]
    return tuple(map(float, np.sort(size))), turn[:, int(np.argmin(size))]


def _shown(view: ModelView, planned: ModelView, name: str) -> str:
    """How the water that a flex or a geom of this name shows differs from the plan's; empty when it does not, or shows none."""
    flexes, geoms = ([world.texts["names"][kind] for world in (view, planned)] for kind in ("flex", "geom"))
    if name and name in flexes[1]:
        there = planned.flex_water[flexes[1].index(name)]
        here = view.flex_water[flexes[0].index(name)] if name in flexes[0] else np.zeros(5)
        room = LEVEL * (there[0] - there[1])
        apart, wide = np.abs(here - there), np.sqrt(there[2])
        if (apart > (room, room, SHARE * there[2], SHARE * wide, SHARE * wide)).any():
            return f"shows water with its level, floor, area and middle at {shown(here)}, by the plan at {shown(there)}"
    elif name and name in geoms[1]:
        if name not in geoms[0]:
            return "is no geom here, as it is by the plan"
        (size, place), (wanted, put) = (
            (world.geom_size[g], world.geom_xpos[g])
            for world, g in ((w, n.index(name)) for w, n in zip((view, planned), geoms, strict=True))
        )
        kinds = [w.geom_kind[n.index(name)] for w, n in zip((view, planned), geoms, strict=True)]
        room = LEVEL * float(wanted.max())
        if kinds[0] != kinds[1] or (np.abs(size - wanted) > room).any() or (np.abs(place - put) > room).any():
            return f"is a {kinds[0]} of {shown(size)} at {shown(place)} m, by the plan a {kinds[1]} of {shown(wanted)} at {shown(put)} m"
    return ""


def _afloat(view: ModelView, planned: ModelView, body: int, twin: int) -> str:
    """How what water lifts and brakes differs from the plan's; empty when it does not. The drag is that of each kind of geom."""
    here, there = (_by_kind(world, own) for world, own in ((view, body), (planned, twin)))
    total = sum(there.values())
    if all(abs(here.get(kind, 0.0) - there.get(kind, 0.0)) <= DISPLACED * total for kind in {*here, *there}):
        return ""
    told = [", ".join(f"{kind} {litres * 1e3:.4g}" for kind, litres in kinds.items()) for kinds in (here, there)]
    return f"displaces, in litres by kinds of geoms, {told[0]}, by the plan {told[1]}"


def _by_kind(view: ModelView, body: int) -> dict[str, float]:
    """m^3 of what is solid of a body, by the kind of its geoms."""
    found: dict[str, float] = {}
    for geom in _solid(view, body).tolist():
        found[view.geom_kind[geom]] = found.get(view.geom_kind[geom], 0.0) + float(view.geom_solid[geom])
    return found


def _surface(view: ModelView, planned: ModelView, body: int, twin: int) -> str:
    """How what a body cools over differs from the plan's; empty when it does not."""
    here, there = float(view.body_surface[body]), float(planned.body_surface[twin])
    if abs(here - there) <= SURFACE * there:
        return ""
    return f"cools over {here:.4g} m^2, by the plan over {there:.4g}: a drawn mesh counts where nothing collides by it"


TOLD = {
    ("magnets", "remanence"): _pole,
    ("magnets", "saturation"): _iron,
    ("magnets", "conductivity"): _metal,
    ("heat", "cooling"): _surface,
    ("water", "density"): _afloat,
    ("basin", "density"): _afloat,
}
"""By solver, and by the constant without which it reads nothing of a body."""


def _along(source: str) -> np.ndarray:
    """(3,) which way the bar of a case is magnetised."""
    view = ModelView(outcome_of(source))
    moment = _magnetised(view, int(view.root_named("bar") or 0)).moment
    return np.asarray(moment / np.linalg.norm(moment))

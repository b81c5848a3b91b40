"""A soft thing of the plan is as stiff, as heavy or held as the plan does not say.

What it does: compares each flex that the plan calls `soft` with the one of the plan's draft: how its matter stretches and bends, when
it yields, its damping, what its points weigh, where they are at the start, and which of them are held.

Why is this bad: a cloth a hundred times stiffer than its constant carries what it should tear or sag under, and in a picture it is
the same cloth; one more pinned corner holds what the plan lets fall.

Use instead: `softs.add` with the plan's constants and its `held` sides; for other numbers, other constants, which are approved.
"""

from collections.abc import Iterator

import numpy as np

from ....compiled.view import ModelView
from ....harm import Measured, after
from ....problem import Problem
from ._twins import PLAN, changed

CODE = "WM179"
SEVERITY = "error"
SCOPE = "acts"
FIX = "call `softs.add` with the plan's numbers, or change the plan and have it approved"
TABLES = (
    ("stiffness", "flex_stiffness", "flex_stiffnessadr", "stiffness of its matter"),
    ("bending", "flex_bending", "flex_bendingadr", "resistance to bending"),
)
"""Fields that have so many numbers a flex, by where a flex's begin."""
ALONE = (
    ("flex_damping", "damping"),
    ("flex_yield", "yield stress"),
    ("flex_edgestiffness", "edge stiffness"),
    ("flex_edgedamping", "edge damping"),
    ("flex_radius", "radius"),
    ("flex_passive", "way of contact"),
)
RTOL, NEAR_M = 1e-3, 1e-3
_ROW = {
    "name": "sheet", "primitive": "box", "size": [0.6, 0.5, 0.01], "material": "wood",
    "soft": {"kind": "cloth", "modulus": "cotton", "thickness_m": 0.001, "points": 5, "held": ["-x"]},
}  # fmt: skip


def _case(*lines: str, modulus: str = "2e5", held: str = "('-x',)") -> tuple[str, dict[str, object]]:
    """A sheet of cloth beside the crate, held along one edge, and its plan."""
    made = f"softs.Cloth(modulus_pa={modulus}, thickness_m=0.001, points=5, held={held})"
    surface = "contacts.surface(friction=0.3, restitution=0.2, time_constant=0.008)"
    text, plan = changed(
        f"softs.add(spec, 'sheet', {made}, size=(0.6, 0.5, 0.01), pos=(0, 3, 1), mass=0.1, surface={surface})",
        "sheet = next(f for f in spec.flexes if f.name == 'sheet')",
        *lines,
    )
    text = text.replace("import bodies,", "import bodies, softs,").replace(
        "time_step=0.002,", "time_step=0.002, integrator='discrete',"
    )
    known: dict = plan["simulation_parameters"]  # type: ignore[assignment]
    topology: dict = plan["topology"]  # type: ignore[assignment]
    more = known | {
        "integrator": "discrete",
        "masses": known["masses"] | {"sheet": 0.1},
        "constants": {"cotton": {"value": 2e5, "unit": "Pa", "source": "a table"}},
    }
    places = topology["body_positions"] | {"sheet": {"x": 0, "y": 3, "z": 1}}
    return text, plan | {
        "simulation_parameters": more,
        "scene_objects": [*PLAN["scene_objects"], _ROW],  # type: ignore[misc]
        "topology": topology | {"body_positions": places},
    }


GOOD = (_case(),)
BAD = (
    _case(modulus="2e7"),
    _case(held="()"),
    _case(held="('-x', '+x')"),
    _case("sheet.damping = 5"),
    _case("for b in spec.bodies: b.mass *= 3 if b.name.startswith('sheet_') else 1"),
    _case("for b in spec.bodies: b.pos[2] += 0.2 if b.name.startswith('sheet_') else 0"),
)
EVIDENCE = Measured(
    "the free edge of the cloth hangs",
    lambda s: float(after(s, 0.4)[1].flexvert_xpos[:, 2].min()),
    0.02,
    "m",
    bad=_case(held="('-x', '+x')")[0],
    good=_case()[0],
)


def check(view: ModelView) -> Iterator[Problem]:
    """Check each soft thing of the plan that is there."""
    planned = view.planned
    assert planned is not None and view.plan is not None
    here, there = (world.texts["names"]["flex"] for world in (view, planned))
    for row in view.plan.scene_objects:
        if row.soft is None or row.name not in there:
            continue
        if row.name not in here:  # a body of that name is something hard
            yield view.at("body", _body(view, row.name), f"{row.name} is not soft, as the plan says it is", FIX)
            continue
        index = here.index(row.name)
        if told := _differs(view, index, planned, there.index(row.name)):
            yield view.at("flex", index, f"the {told} of {row.name} is not the plan's", FIX)


def _body(view: ModelView, name: str) -> int:
    names = view.texts["names"]["body"]
    return names.index(name) if name in names else 0


def _differs(view: ModelView, index: int, planned: ModelView, twin: int) -> str:
    """What of a flex is otherwise than of the plan's; empty if nothing is."""
    one, other = _points(view, index), _points(planned, twin)
    if one.shape != other.shape or view.flex_dim[index] != planned.flex_dim[twin]:
        return f"mesh ({len(one)} points; `points` of the plan's row makes {len(other)})"
    for _, field, starts, word in TABLES:
        a, b = (_slice(world, field, starts, at) for world, at in ((view, index), (planned, twin)))
        if a.shape != b.shape or not np.allclose(a, b, rtol=RTOL, atol=RTOL * float(np.abs(b).max(initial=1e-9))):
            return word
    for field, word in ALONE:
        if not np.allclose(getattr(view, field)[index], getattr(planned, field)[twin], rtol=RTOL, atol=1e-9):
            return word
    for column, word, near in (
        (slice(0, 1), "mass", 1e-6),
        (slice(1, 2), "hold (`held`)", 0.5),
        (slice(2, 5), "place", NEAR_M),
    ):
        if not np.allclose(one[:, column], other[:, column], rtol=RTOL, atol=near):
            return word
    return ""


def _points(view: ModelView, index: int) -> np.ndarray:
    """(points, 5) of a flex, or of the nodes that carry it: mass, kg; whether it moves; place in the world, m."""
    nodes = int(view.flex_nodenum[index])
    first, count, bodies = (
        (int(view.flex_nodeadr[index]), nodes, view.flex_nodebodyid)
        if nodes
        else (int(view.flex_vertadr[index]), int(view.flex_vertnum[index]), view.flex_vertbodyid)
    )
    own = bodies[first : first + count]
    mass = np.where(view.moving[own], view.body_mass[own], 0.0)
    return np.column_stack([mass, view.moving[own], view.body_pos[own]])


def _slice(view: ModelView, field: str, starts: str, index: int) -> np.ndarray:
    """A flex's own numbers of a field that all share."""
    begins, all_numbers = np.ravel(getattr(view, starts)), np.ravel(getattr(view, field))
    first = int(begins[index])
    if first < 0:  # a flex that has none
        return all_numbers[:0]
    return all_numbers[first : min((int(at) for at in begins if at > first), default=None)]

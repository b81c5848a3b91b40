"""Tell which frictions act between what meets, where the plan's two materials do not say the same.

The engine lets the larger of two values act, and of a pair in `simulation_parameters.pairs` that one's. What a material leaves
unsaid yields to what others say (`model/plan/pairings.py`). Source: MuJoCo manual, "Contact parameters".
"""

from collections.abc import Iterator
from typing import Any

from ...model.plan.committed import AssetRow, Plan, SceneObject
from ...model.plan.pairings import FRICTIONS, YIELDING, Touch, said
from .checked_layout import CheckedLayout

GROUND = "ground"
ENGINES_OWN = Touch(friction=1.0)
"""Of what has no material: MuJoCo's own friction of a geom."""
MOST = 6


def check(layout: CheckedLayout) -> None:
    """Tell the frictions in force of the pairs that matter."""
    lines = [*given_way(layout.plan), *told(layout.plan)]
    layout.at_start += lines[:MOST]
    if len(lines) > MOST:
        layout.at_start.append(f"… and {len(lines) - MOST} more pairs of materials that do not say the same frictions")


def given_way(plan: Plan) -> Iterator[str]:
    """One line for each friction that materials leave unsaid and that another one's word makes smaller than it would be."""
    rows = {name: row for name, row in plan.simulation_parameters.materials.items() if name in plan.made_of}
    for kind in YIELDING:
        usual, unsaid = getattr(Touch(), kind), [name for name, row in rows.items() if kind not in said(row)]
        if smaller := [name for name in unsaid if getattr(rows[name], kind) < usual]:
            value = getattr(rows[smaller[0]], kind)
            who = [name for name, row in rows.items() if said(row).get(kind) == value]
            yield (
                f"{', '.join(smaller)}: {kind.replace('_', ' ')} {value:g} m, unsaid, by the word of {', '.join(who)} "
                f"(else {usual:g} m)"
            )


def told(plan: Plan) -> Iterator[str]:
    """One line for each two materials that meet and say different frictions."""
    parameters, seen = plan.simulation_parameters, set[frozenset[str]]()
    own = {frozenset(row.between): row for row in parameters.pairs}
    for one, other in _pairs(plan):
        if row := own.get(frozenset((one, other))):
            yield f"{one} on {other}: {_shown({k: getattr(row, k) for k in FRICTIONS})}, as its pair says"
            continue
        for first in sorted(_materials(plan, one)):
            for second in sorted(_materials(plan, other)):
                both = frozenset((first, second))
                mine, theirs = (
                    parameters.materials.get(first, ENGINES_OWN),
                    parameters.materials.get(second, ENGINES_OWN),
                )
                unlike = [k for k in FRICTIONS if getattr(mine, k) != getattr(theirs, k)]
                if not unlike or both in seen:
                    continue
                seen.add(both)
                acting = {k: max(getattr(mine, k), getattr(theirs, k)) for k in FRICTIONS}
                winners = [(k, first if getattr(mine, k) > getattr(theirs, k) else second) for k in unlike]
                whose = ", ".join(f"{k.replace('_', ' ')} of {name or 'the engine itself'}" for k, name in winners)
                yield f"{first or one} on {second or other}: {_shown(acting)}; of two the larger acts: {whose}"


def _shown(values: dict[str, float]) -> str:
    return ", ".join(f"{k.replace('_', ' ')} {v:g}{'' if k == 'friction' else ' m'}" for k, v in values.items())


def _pairs(plan: Plan) -> Iterator[tuple[str, str]]:
    """What has a pair of its own; what a claim names together; what stands on what; what moves, and a ground with
    a material, or without one where somebody says how a thing spins or rolls."""
    known, seen = {*plan.object_names(), GROUND}, set[frozenset[str]]()
    named: list[tuple[Any, ...]] = [tuple(row.between) for row in plan.simulation_parameters.pairs]
    for objective in plan.objectives:
        for expected in objective.expect:
            for arguments in expected.values():
                given = arguments if isinstance(arguments, dict) else {}
                named.append(tuple(given.get("bodies") or ()))
                named.append((given.get("body"), given.get("other")))
    named += [(row.subject, row.object) for row in plan.topology.scene_predicates]
    materials = plan.simulation_parameters.materials
    if GROUND in materials or any(map(said, materials.values())):  # else the engine's own may overrule what is said
        named += [(name, GROUND) for name in plan.movers()]
    for pair in named:
        both = frozenset(name for name in pair if isinstance(name, str))
        if len(pair) == 2 and len(both) == 2 and both <= known and both not in seen:
            seen.add(both)
            yield str(pair[0]), str(pair[1])


def _materials(plan: Plan, name: str) -> set[str]:
    """Names of the materials of an object and its parts; an empty name for none."""
    if name == GROUND:
        return {GROUND if GROUND in plan.simulation_parameters.materials else ""}
    rows: dict[str, SceneObject | AssetRow] = {row.name: row for row in plan.scene_objects}
    rows |= {copy: row for row in plan.assets for copy in row.instances}
    row = rows.get(name)
    if row is None or (isinstance(row, AssetRow) and row.material is None):
        return set()  # the catalog's own constants
    parts = row.parts if isinstance(row, SceneObject) else ()
    return {part.material or row.material or "" for part in parts if part.visual_only is None} or {row.material or ""}

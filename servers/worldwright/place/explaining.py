"""The chain of rows and formulas from the base to an object's numbers."""

from ..model.plan.committed import Plan
from ..model.plan.imported import is_model, is_plant, is_road, is_sculpt, is_vehicle
from .placement_results import Explained, Explanation
from .resolution import Resolution


def explain(plan: Plan, resolution: Resolution, name: str) -> Explanation:
    """Explain the pose of `name` by everything that it rests on, in dependency order, the object itself last."""
    needed: set[str] = set()
    waiting = [name]
    references: dict[str, set[str]] = {}
    for row in resolution.statements:
        if row.pins:  # a row that only demands something gives no number
            references.setdefault(row.subject, set()).update(row.needs())
    while waiting:
        current = waiting.pop()
        if current not in needed:
            needed.add(current)
            waiting += references.get(current, ())
    chain = [o for o in resolution.scene.objects if o.name in needed and o.name != name]
    sources = _sizes(plan)
    return Explanation(
        object=name,
        chain=tuple(
            Explained(
                name=o.name,
                kind=o.kind,
                size=o.size,
                size_source=sources.get(o.name, ""),
                position=o.position,
                deg_z=o.deg_z,
                formulas=(*o.provenance, o.weight) if o.weight else o.provenance,
            )
            for o in (*chain, resolution.scene[name])
        ),
    )


def _sizes(plan: Plan) -> dict[str, str]:
    """The owner of each object's size."""
    owners = {
        row.name: f"the box around its {len(row.parts)} parts"
        if row.parts
        else f"the box around the points of its {'path' if row.path else 'profile'}"
        if row.path or row.profile
        else "size given in scene_objects"
        for row in plan.scene_objects
    }
    for row in plan.assets:
        if is_model(row):
            owners |= dict.fromkeys(row.instances, f"the box around the rest pose of {row.filename}")
            continue
        if is_road(row):
            owners |= dict.fromkeys(row.instances, f"the box around the tiles of {row.filename}")
            continue
        if is_vehicle(row):
            owners |= dict.fromkeys(row.instances, "length_m, width_m and height_m of its vehicle")
            continue
        if is_plant(row):
            owners |= dict.fromkeys(row.instances, "the limbs and leaves that its plant's numbers grow")
            continue
        if is_sculpt(row):
            owners |= dict.fromkeys(row.instances, "size given in assets")
            continue
        height = plan.asset_dimensions.get(row.name)
        owners |= dict.fromkeys(
            row.instances, f"catalog `{row.filename}` scaled to {height:g} m height (asset_dimensions)"
        )
    return owners

"""Objects and assets with a `count`: in a plan that is read, `name_1` … `name_N` stand in the place of `name`.

What is said of `name` is said of each copy: its mass, its launch, where it stands, that it moves, the joint it hangs on, the
rope that holds it. A copy of a joint or tendon has the number of its body.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from .breakage import as_objects, weights
from .drives import Tendon
from .implementation_steps import CameraRow, Step
from .object_parts import Vec3

Written = Any
"""A plan, or a part of it, whose module imports this one."""
Families = Mapping[str, tuple[str, ...]]
"""The names of the copies, by the name that the plan gives."""


def families(plan: Written) -> dict[str, tuple[str, ...]]:
    """Of the scene objects and assets of a plan as it is written."""
    made = [row for row in plan.scene_objects if row.count > 1 or row.breaks is not None]
    return {row.name: row.instances for row in (*made, *(row for row in plan.assets if row.count > 1))}


def changes(plan: Written, copied: Families) -> dict[str, Any]:
    """The fields of a plan that differ once its copies stand for themselves; it has some.

    Raises:
        ValueError: a joint or a tendon ties families of different sizes.
    """
    objects, sources = [], []
    for index, row in enumerate(plan.scene_objects):
        if row.breaks is not None:
            objects += as_objects(row)
        else:
            same = row.count == 1
            objects += [row if same else row.model_copy(update={"name": n, "count": 1}) for n in row.instances]
        sources += [index] * len(row.instances)
    pieces = weights([row for row in plan.scene_objects if row.breaks is not None], plan.simulation_parameters)
    joints = [made for row in plan.topology.joints for made in _joint(row, copied)]
    hung = {
        row.name: tuple(f"{row.name}_{k + 1}" for k in range(len(copied[row.child])))
        for row in plan.topology.joints
        if row.child in copied
    }
    tendons = [made for row in plan.topology.tendons for made in _tendon(row, copied)]
    overlaps = _between(plan.topology.overlaps, copied)
    weighed = {name: names for name, names in copied.items() if name not in {row.name for row in plan.assets}}
    changed = {"joints": tuple(joints), "tendons": tuple(tendons), "overlaps": overlaps}
    topology = plan.topology.model_copy(update=changed)
    return {
        "scene_objects": tuple(objects),
        "topology": topology,
        "simulation_parameters": _parameters(plan.simulation_parameters, {**copied, **hung}, weighed, pieces),
        "implementation_steps": tuple(_step(step, copied) for step in plan.implementation_steps),
        "source_rows": tuple(sources),
    }


def named(names: Iterable[str], copied: Families) -> tuple[str, ...]:
    """The names, those of families replaced by their copies'."""
    return tuple(other for name in names for other in copied.get(name, (name,)))


def _spelled(values: Mapping[str, Any], copied: Families) -> dict[str, Any]:
    """By name; what is said of a copy by its own name wins."""
    whole = {other: value for name, value in values.items() for other in copied.get(name, ())}
    return whole | {name: value for name, value in values.items() if name not in copied}


def _parameters(row: Written, copied: Families, weighed: Families, pieces: dict[str, float]) -> Written:
    """A mass of an asset is its row's, which counts for each of its copies: it keeps the row's name."""
    acting = tuple(i.model_copy(update={"bodies": named(i.bodies, copied)}) for i in row.interventions)
    masses, starts = _spelled(row.masses, weighed), _spelled(row.initial_motion, copied)
    pairs = _between(row.pairs, copied)
    changed = {"masses": masses | pieces, "initial_motion": starts, "interventions": acting, "pairs": pairs}
    return row.model_copy(update=changed)


def _between(rows: Iterable[Written], copied: Families) -> tuple[Written, ...]:
    """The rows about two things each, said of every copy of the one and of the other."""
    return tuple(
        row.model_copy(update={"between": (one, other)})
        for row in rows
        for one in copied.get(row.between[0], row.between[:1])
        for other in copied.get(row.between[1], row.between[1:])
        if one != other
    )


def _step(row: Step, copied: Families) -> Step:
    cameras = tuple(camera if isinstance(camera, str) else _camera(camera, copied) for camera in row.cameras)
    objects, movers = named(row.scene_objects, copied), named(row.motion_expectations, copied)
    return row.model_copy(update={"scene_objects": objects, "motion_expectations": movers, "cameras": cameras})


def _camera(row: CameraRow, copied: Families) -> CameraRow:
    return row.model_copy(update={"subjects": named(row.subjects, copied)})


def _joint(row: Written, copied: Families) -> Sequence[Written]:
    if row.child not in copied:
        return (row,)
    children = copied[row.child]
    if row.parent == row.child:  # a chain: each hangs on the one before it
        parents: Sequence[str] = ("world", *children[:-1])
    else:
        parents = _paired(row.name, copied.get(row.parent, (row.parent,) * len(children)), len(children))
    return [
        row.model_copy(
            update={
                "name": f"{row.name}_{k + 1}",
                "child": child,
                "parent": parent,
                "anchor": None if row.anchor is None else _stepped(row.anchor, row.step, k),
            }
        )
        for k, (child, parent) in enumerate(zip(children, parents, strict=True))
    ]


def _tendon(row: Tendon, copied: Families) -> Sequence[Tendon]:
    counts = {len(copied[end.body]) for end in row.ends if end.body in copied}
    if not counts:
        return (row,)
    count = max(counts)
    bodies = [_paired(row.name, copied.get(end.body, (end.body,) * count), count) for end in row.ends]
    return [
        row.model_copy(
            update={
                "name": f"{row.name}_{k + 1}",
                "ends": tuple(
                    end.model_copy(update={"body": names[k], "offset": _stepped(end.offset, end.step, k)})
                    for end, names in zip(row.ends, bodies, strict=True)
                ),
            }
        )
        for k in range(count)
    ]


def _paired(name: str, bodies: Sequence[str], count: int) -> Sequence[str]:
    if len(bodies) != count:
        raise ValueError(f"`{name}` ties {count} copies to {len(bodies)}: give both the same `count`, or name one copy")
    return bodies


def _stepped(start: Vec3, step: Vec3, k: int) -> Vec3:
    x, y, z = (a + k * b for a, b in zip(start, step, strict=True))
    return (round(x, 9), round(y, 9), round(z, 9))

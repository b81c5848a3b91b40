"""What the program draws, nothing can touch and the plan does not have: decoration, or something that passes for a planned body."""

from collections.abc import Mapping
from typing import Any

from ..model.plan.committed import Plan

MOST = 40
"""So many are listed by name."""
ALIKE = 0.1
"""Of the same size is what differs by no more than this share in any side."""


def listed(meta: Mapping[str, Any], plan: Plan) -> tuple[str, ...]:
    """Those of a recorded world, by name, such as `scenery (0.4 m, as large as crate)`; what is on a planned body is not listed.

    Args:
        meta: the facts of the recording, with `bodies` and `geoms`.
        plan: its plan.
    """
    parent = {str(row["name"]): str(row.get("parent") or "") for row in meta.get("bodies") or ()}
    known = set(plan.object_names())
    sizes: dict[str, list[tuple[float, ...]]] = {}
    loose: dict[str, list[tuple[float, ...]]] = {}
    for geom in meta.get("geoms") or ():
        body, sides = str(geom["body"]), tuple(sorted(2 * half for half in geom["aabb"][3:]))
        owner = body
        while owner and not _planned(owner, known):
            owner = parent.get(owner, "")
        if owner:
            sizes.setdefault(owner, []).append(sides)
        elif geom.get("visible") and not geom.get("collides"):
            own = str(geom["name"] or "a shape without a name") if parent.get(body) is None else body
            loose.setdefault(own, []).append(sides)
    said = [f"{name} ({_size(shapes, sizes)})" for name, shapes in loose.items()]
    return tuple(said[:MOST]) + ((f"and {len(said) - MOST} more",) if len(said) > MOST else ())


def _planned(name: str, known: set[str]) -> bool:
    """Whether it is a planned thing, or a numbered copy of one: `crate`, `crate_2`, but no `crate_ghost`."""
    head, _, tail = name.rpartition("_")
    return name in known or (head in known and tail.isdigit())


def _size(shapes: list[tuple[float, ...]], planned: dict[str, list[tuple[float, ...]]]) -> str:
    """The largest side of some shapes, and the planned thing that has one of the same size."""
    largest = max(shapes, key=max)
    like = next((name for name, others in planned.items() if any(_alike(a, b) for a in shapes for b in others)), "")
    return f"{max(largest):.2g} m" + (f", as large as {like}" if like else "")


def _alike(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    return all(abs(a - b) <= ALIKE * max(a, b) for a, b in zip(one, other, strict=True))

"""How far two bodies may be inside each other because the plan says that they belong together: one answer for all who ask."""

from collections.abc import Collection, Mapping

from .committed import Plan


class Belonging:
    """What a plan lets overlap (`topology.overlaps`), asked by the names of bodies.

    Args:
        plan: the plan; None lets nothing overlap.
        parents: by the name of a body that of the body that carries it, so that a part stands for its object.
    """

    def __init__(self, plan: Plan | None, parents: Mapping[str, str] | None = None) -> None:
        rows = plan.topology.overlaps if plan else ()
        self.parents = parents or {}
        self.objects = frozenset(plan.object_names()) if plan else frozenset()
        self.up_to = {frozenset(row.between): row.up_to_m for row in rows}

    def allowed_m(self, one: str, other: str) -> float:
        """How deep one may be inside the other, m; 0 where the plan says nothing of it."""
        if not self.up_to:
            return 0.0
        return self.up_to.get(frozenset(owner(name, self.parents, self.objects) for name in (one, other)), 0.0)


def welded(plan: Plan) -> dict[str, str]:
    """Each object that a plan welds to another (`topology.joints`, `type: weld`), and one name for all that hold together so.

    A weld to the world joins nothing: two things that stand fast are still two.
    """
    head: dict[str, str] = {}

    def first(name: str) -> str:
        while name != head.setdefault(name, name):
            name = head[name]
        return name

    for joint in plan.topology.joints:
        if joint.type == "weld" and joint.parent != "world":
            head[first(joint.child)] = first(joint.parent)
    return {name: first(name) for name in list(head)}


def owner(body: str, parents: Mapping[str, str], objects: Collection[str]) -> str:
    """The object that a body belongs to: the nearest one that carries it; the outermost body where none does."""
    seen = body
    while body not in objects and body in parents and parents[body] != "world":
        body = parents[body]
    return body if body in objects else seen

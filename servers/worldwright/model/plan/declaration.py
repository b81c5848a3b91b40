"""Which row of the plan declares an intervention: the rule by which the engine's process opens inputs."""

from collections.abc import Iterable

from worldengine.inputs.openings import opens, owner

from .committed import Intervention

__all__ = ["declaration", "owner"]


def declaration(kind: str, target: str, declared: Iterable[Intervention]) -> Intervention | None:
    """The plan's row that declares this kind on this target."""
    return next((row for row in declared if opens(row.kind, frozenset(row.bodies), kind, target)), None)

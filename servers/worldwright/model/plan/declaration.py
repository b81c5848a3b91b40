"""Which row of the plan declares an intervention: the rule by which the engine's process opens inputs."""

from collections.abc import Iterable, Mapping

from worldengine.inputs.flex_points import covered
from worldengine.inputs.openings import opens, owner

from .committed import Intervention

__all__ = ["DRIVES", "covering", "declaration", "owner"]

DRIVES = ("force", "parameter", "control", "solver")
"""Kinds by which a plan declares that something pushes, or that a surface runs or sticks."""


def declaration(kind: str, target: str, declared: Iterable[Intervention]) -> Intervention | None:
    """The plan's row that declares this kind on this target."""
    return next((row for row in declared if opens(row.kind, frozenset(row.bodies), kind, target)), None)


def covering(declared: Iterable[Intervention], points: Mapping[str, tuple[str, ...]]) -> tuple[Intervention, ...]:
    """The plan's rows, each with the points of the flexes that it names (`Trajectory.flex_points`)."""
    return tuple(
        row.model_copy(update={"bodies": covered(row.bodies, points)}) if points.keys() & set(row.bodies) else row
        for row in declared
    )

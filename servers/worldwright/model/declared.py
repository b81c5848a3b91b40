"""Which row of the plan declares an intervention: one rule for every server."""

from collections.abc import Iterable

from .plan import Intervention

BY_SOLVER = ("force", "torque", "callback", "velocity", "pose")
"""What a declared `solver` (an engine outside MuJoCo) may write or install."""


def owner(target: str) -> str:
    """The body, actuator or constraint inside a target such as `gate/hinge` or `gate.geom_friction[skin]`."""
    return target.replace("/", ".").replace("[", ".").split(".")[0]


def names_of(target: str) -> frozenset[str]:
    """Names by which a plan may declare a target: itself, its body, its joint or actuator (`load/winch`: `winch`)."""
    inner = target.partition("/")[2] or target
    return frozenset((target, owner(target), inner, inner.partition("[")[0]))


def declaration(kind: str, target: str, declared: Iterable[Intervention]) -> Intervention | None:
    """The plan's row that declares this kind on this target."""
    kinds = {kind, "solver"} if kind in BY_SOLVER else {kind}
    names = names_of(target)
    return next((row for row in declared if row.kind in kinds and names.intersection(row.bodies)), None)

"""Decide which declaration opens which input: one rule for the engine's process and for every server.

A plan declares rows of a kind and some names; the ledger speaks of a kind and a target, such as `gate/hinge` or
`gate.geom_friction[skin]`. A row opens a target of its kind that it names, or whose body it names.
"""

from worldkit.model_arrays import LOOKS

BY_SOLVER = ("force", "torque", "velocity", "pose")
"""What a declared `solver` (an engine beside MuJoCo) may write."""


def owner(target: str) -> str:
    """The body, actuator or constraint inside a target such as `gate/hinge` or `gate.geom_friction[skin]`."""
    return target.replace("/", ".").replace("[", ".").split(".")[0]


def names_of(target: str) -> frozenset[str]:
    """Names by which a plan may declare a target: itself, its body, its joint or actuator (`load/winch`: `winch`)."""
    inner = target.partition("/")[2] or target
    bare = target.partition("[")[0]
    return frozenset((target, bare, owner(target), inner, inner.partition("[")[0]))


def opens(row_kind: str, names: frozenset[str], kind: str, target: str) -> bool:
    """Whether a row of this kind with these names declares this kind on this target."""
    if kind == "parameter":
        return row_kind == kind and not _parameter(target).isdisjoint(names)
    kinds = {kind, "solver"} if kind in BY_SOLVER else {kind}
    return row_kind in kinds and not names_of(target).isdisjoint(names)


def _parameter(target: str) -> frozenset[str]:
    """Names by which a plan may declare an array of the model: `crate.body_mass`, with its element or without.

    A body alone (`crate`) opens its looks, and nothing that decides its weight, contacts or motion.
    """
    bare = target.partition("[")[0]
    looks = any(part in bare.rpartition(".")[2] for part in LOOKS)
    return frozenset((target, bare)) | (names_of(target) if looks else frozenset())

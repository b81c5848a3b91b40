"""Watch six numbers in two halves: which half is the rotation, and what the program calls it."""

from typing import Any

import called_names
import numpy as np
from said import SAID

ROTATION_FIRST = {"mj_objectVelocity", "mj_objectAcceleration", "cvel", "cacc"}


def part(note: Any, array: Any, at: Any) -> None:
    """Look at a half that is taken of six numbers with the rotation first."""
    if at is None or at.size != 3 or array.shape[-1:] != (6,):
        return
    labels = note.store["labels"] if note.store is not None else {note.field}
    source = next(iter(sorted(labels & ROTATION_FIRST)), None)
    if source is None:
        return
    second = int(np.ravel(at)[0]) % 6 == 3
    for name in called_names.halves(SAID.line(), second):
        linear, angular = bool(called_names.LINEAR.search(name)), bool(called_names.ANGULAR.search(name))
        if linear != angular and linear != second:
            SAID.event("rotation_first" if linear else "rotation_taken_last", SAID.line(), name=source)


def _torque(names: str) -> bool | None:
    """Whether the names speak of a torque (and of no force), of a force, or of neither."""
    force, torque = bool(called_names.FORCE.search(names)), bool(called_names.TORQUE.search(names))
    return None if force == torque else torque


def forces(field: str, places: Any, line: int) -> None:
    """Look at a half that is written of a force in the world, which has the force first."""
    if field != "xfrc_applied" or np.size(places) not in (3, 6):
        return
    import ast

    node = called_names.innermost(line)
    if not isinstance(node, ast.Assign | ast.AugAssign):
        return
    if np.size(places) == 6:
        parts = node.value.args[0] if isinstance(node.value, ast.Call) and node.value.args else node.value
        if isinstance(parts, ast.List | ast.Tuple) and len(parts.elts) == 2:
            one, other = (called_names.words(p) for p in parts.elts)
            if _torque(one) and _torque(other) is False:
                SAID.event("force_first", line, what="torque")
        return
    second = int(np.ravel(places)[0]) % 6 == 3
    names = called_names.words(node.value)
    force, torque = bool(called_names.FORCE.search(names)), bool(called_names.TORQUE.search(names))
    if force != torque and force == second and not isinstance(node.value, ast.Call):
        SAID.event("force_first", line, what="torque" if torque else "force")

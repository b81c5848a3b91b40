"""What a program writes into the state and the model: shared by the rules about staging."""

import ast
from collections.abc import Iterator
from typing import NamedTuple

from ...program_view import Program

POSE = frozenset({"qpos"})
MOTION = frozenset({"qvel", "qacc"})
MOCAP = frozenset({"mocap_pos", "mocap_quat"})
FORCE = frozenset({"xfrc_applied", "qfrc_applied"})
CONTROL = frozenset({"ctrl", "act"})
SWITCH = frozenset({"eq_active"})
_DERIVED_WORDS = """
    xpos xquat xmat xipos ximat xiquat geom_xpos geom_xmat site_xpos site_xmat cam_xpos cam_xmat light_xpos
    light_xdir subtree_com cvel cacc cfrc_ext cfrc_int qacc sensordata energy actuator_force actuator_length
    actuator_velocity ten_length xanchor xaxis efc_force qfrc_constraint qfrc_passive qfrc_bias qfrc_actuator
"""
DERIVED = frozenset(_DERIVED_WORDS.split())
"""Fields of MjData that the engine computes from the state: what a program writes there is overwritten, or never felt."""


class Write(NamedTuple):
    """One write."""

    field: str
    owner: str
    """`MjData` or `MjModel`."""
    node: ast.AST


def writes(program: Program) -> Iterator[Write]:
    """Writes to fields of the data or the model: plain, sliced, by named access, augmented, `np.copyto`, `.fill`."""
    for target, _, statement in program.stores():
        found = field_of(program, target)
        if found is not None:
            yield Write(*found, statement)
    for full, call in program.calls("numpy.copyto", "mujoco.mj_setState", "mujoco.mju_copy"):
        if full != "mujoco.mj_setState" and call.args and (found := field_of(program, call.args[0])) is not None:
            yield Write(*found, call)
    for call in program.method_calls("fill", "put", "itemset"):
        if (found := field_of(program, call.func.value)) is not None:  # type: ignore[attr-defined]
            yield Write(*found, call)


def field_of(program: Program, node: ast.AST) -> tuple[str, str] | None:
    """The (field, owner) an expression writes to, e.g. `data.qpos[3:7]` -> ("qpos", "MjData")."""
    while isinstance(node, ast.Subscript):
        node = node.value
    if isinstance(node, ast.Name):  # a view: `force = data.body("x").xfrc_applied; force[2] = 9`
        bound = program.scopes.bound(node)
        if len(bound) != 1 or not isinstance(bound[0], ast.Attribute | ast.Subscript):
            return None
        parent = program.parent(node)
        if not isinstance(parent, ast.Subscript | ast.AugAssign):
            return None
        return field_of(program, bound[0])
    if not isinstance(node, ast.Attribute):
        return None
    owner = program.type_of(node.value)
    if owner is None:
        return None
    if owner.startswith("_MjData") or owner == "MjData":
        return node.attr, "MjData"
    if owner.startswith("_MjModel") or owner in ("MjModel", "MjOption", "MjVisual"):
        return (f"opt.{node.attr}" if owner == "MjOption" else node.attr), "MjModel"
    return None

"""What poses alone do not show of the bodies of a recording: size, mass, joints, what else acts on them.

Read from a recording's `meta.json`, or from an MJCF model that lies beside foreign data. Every fact is optional: a
check that needs a missing one says so instead of guessing.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from worldkit.turning import matrices

from . import assemblies, laws_told, linkage
from .linkage import Joint, Rope, Tie

Array = np.ndarray
INFINITE_M = 1e6
"""A half extent beyond this is a plane or a height field's: it bounds nothing."""


@dataclass(frozen=True)
class Mechanics:
    """Facts about B bodies (the world is not one of them) and their G geoms; None where unknown."""

    mass: Array | None = None
    """(B,) kg."""
    com: Array | None = None
    """(B, 3) centre of mass in the body's own frame, m."""
    inertia: Array | None = None
    """(B, 3) principal moments, kg·m^2."""
    inertia_quat: Array | None = None
    """(B, 4) wxyz, principal axes in the body's own frame."""
    center: Array | None = None
    """(B, 3) centre of the bounding box of the body's geoms in the body's own frame, m; nan without geoms."""
    half_extents: Array | None = None
    """(B, 3) half extents of that box, m; nan without geoms."""
    dynamic: Array | None = None
    """(B,) bool: has at least one degree of freedom above it."""
    free: Array | None = None
    """(B,) bool: one loose rigid body: a free joint, no children that move, no tie to anything."""
    unforced: Array | None = None
    """(B,) bool: nothing but gravity and contact acts on it (no actuator, fluid, damping, gravity compensation …)."""
    mocap: Array | None = None
    """(B,) bool: posed by the program."""
    visual_only: Array | None = None
    """(B,) bool: drawn without being simulated."""
    parent: Array | None = None
    """(B,) index of the parent body, -1 for the world."""
    jointed: Array | None = None
    """(B,) bool: has a joint of its own; a body without is welded to its parent (see `model.assemblies`)."""
    whole_free: Array | None = None
    """(B,) bool: `free` is true of the rigid assembly that each belongs to."""
    whole_unforced: Array | None = None
    """(B,) bool: `unforced` is true of that assembly."""
    geom_names: tuple[str, ...] = ()
    geom_body: Array | None = None
    """(G,) index of the body that owns each geom, -1 for the world."""
    geom_half_extents: Array | None = None
    """(G, 3) m, in the geom's own frame; inf for planes."""
    geom_type: tuple[str, ...] = ()
    """Shape of each geom: `sphere`, `box`, `plane`, `mesh` …"""
    geom_pos: Array | None = None
    """(G, 3) m, centre of each geom's box in its body's frame."""
    geom_quat: Array | None = None
    """(G, 4) wxyz, in its body's frame."""
    geom_collides: Array | None = None
    """(G,) bool: its masks let it touch something."""
    geom_drawn: Array | None = None
    """(G,) bool: pictures show it."""
    geom_friction: Array | None = None
    """(G,) sliding friction; 0 where contacts are frictionless (condim 1)."""
    joints: tuple[Joint, ...] = ()
    """Hinges and slides with limits."""
    ropes: tuple[Rope, ...] = ()
    """Tendons with limits."""
    ties: tuple[Tie, ...] = ()
    """Welds and connects that hold at the start."""
    ground_z: float | None = None
    """Height of the world's highest level, collidable plane, m."""
    gravity: Array | None = None
    """(3,) m/s^2, world frame."""
    drives: tuple[str, ...] = ()
    """What can do work on the bodies besides gravity and contact: `actuators`, `fluid`, `surface velocity` …"""
    unmatched: tuple[str, ...] = ()
    """Recorded bodies that the description does not have: nothing but their poses is known."""

    @classmethod
    def from_meta(cls, meta: Mapping[str, Any], names: Sequence[str]) -> "Mechanics":
        """From a recording's `meta.json` (see `worldengine.recording.record`): lists `bodies`, `geoms`, `equalities`, … by row."""
        rows = _rows(meta.get("bodies"))
        by_name = {row.get("name"): row for row in rows}
        unmatched = tuple(name for name in names if name not in by_name)
        if len(unmatched) == len(names):
            return cls(gravity=_vector(meta, "gravity"), unmatched=unmatched)
        bodies = [by_name.get(name) or _stranger(name) for name in names]
        geoms = _Geoms(meta, names)
        center, half = geoms.boxes(len(names))
        parent = np.array([_index(row.get("parent"), names, rows) for row in bodies], dtype=int)
        dynamic = _column(bodies, "dynamic", bool)
        option = meta.get("option") or {}
        drives = _drives(meta, option)
        tied = _tied(meta, names, rows)
        free = unforced = jointed = whole_free = whole_unforced = None
        joints = [row.get("joints", row.get("joint_types")) for row in bodies]
        if all(j is not None for j in joints) and dynamic is not None:
            moving_child = {int(p) for p, d in zip(parent, dynamic, strict=True) if p >= 0 and d}
            free = np.array([_is_free(j) and i not in moving_child for i, j in enumerate(joints)]) & ~tied["bound"]
            still_air = not ({"fluid", "plugins", "flexes"} & set(drives))
            quiet = np.array([not row.get("gravcomp") and not row.get("damping") for row in bodies])
            unforced = free & quiet & ~tied["driven"] & still_air
            kinds = [[_joint_type(joint) for joint in own or ()] for own in joints]
            jointed = np.array([bool(own) for own in kinds], dtype=bool)
            head = assemblies.heads(parent, jointed)
            whole_free = assemblies.loose(head, parent, kinds, dynamic, tied["bound"])
            whole_unforced = whole_free & ~assemblies.any_member(head, ~quiet | tied["driven"]) & still_air
        return cls(
            mass=_column(bodies, "mass", float),
            com=_column(bodies, "ipos", float, "com"),
            inertia=_column(bodies, "inertia", float),
            inertia_quat=_column(bodies, "iquat", float, "inertia_quat"),
            center=center,
            half_extents=half,
            dynamic=dynamic,
            free=free,
            unforced=unforced,
            mocap=_column(bodies, "mocap", bool),
            visual_only=_visual_only(meta, bodies, names),
            parent=parent,
            jointed=jointed,
            whole_free=whole_free,
            whole_unforced=whole_unforced,
            geom_names=geoms.names,
            geom_body=geoms.body,
            geom_half_extents=geoms.half,
            **geoms.shapes(),
            joints=linkage.joints(_rows(meta.get("joints")), lambda value: _index(value, names, rows)),
            ropes=linkage.ropes(_rows(meta.get("tendons")), lambda value: _index(value, names, rows)),
            ties=linkage.ties(_rows(meta.get("equalities")), lambda value: _index(value, names, rows)),
            ground_z=geoms.ground_z(),
            gravity=_vector(meta, "gravity", option),
            drives=drives,
            unmatched=unmatched,
        )

    def half_thickness(self) -> Array | None:
        """(B,) half the smallest extent of each body, m; nan without geoms."""
        return None if self.half_extents is None else self.half_extents.min(axis=1)


class _Geoms:
    """The geoms of a `meta.json` as arrays."""

    def __init__(self, meta: Mapping[str, Any], names: Sequence[str]) -> None:
        self.rows = _rows(meta.get("geoms"))
        self.names = tuple(str(row.get("name", "")) for row in self.rows)
        all_bodies = _rows(meta.get("bodies"))
        self.body: Array | None = None
        self.half: Array | None = None
        if not self.rows:
            return
        self.body = np.array([_index(row.get("body"), names, all_bodies) for row in self.rows], dtype=int)
        if all(row.get("aabb") is not None for row in self.rows):
            box = np.array([np.ravel(row["aabb"]) for row in self.rows], dtype=float)
            self.middle, self.half = box[:, :3], np.where(box[:, 3:] > INFINITE_M, np.inf, box[:, 3:])

    def boxes(self, count: int) -> tuple[Array | None, Array | None]:
        """Centre and half extents (count, 3) of each body's geoms in its own frame."""
        if self.half is None or self.body is None:
            return None, None
        low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
        for g, row in enumerate(self.rows):
            if self.body[g] < 0 or not np.all(np.isfinite(self.half[g])):
                continue
            turn = matrices(np.asarray(row.get("quat", (1, 0, 0, 0)), dtype=float))
            middle = np.asarray(row.get("pos", (0, 0, 0)), dtype=float) + turn @ self.middle[g]
            reach = np.abs(turn) @ self.half[g]
            low[self.body[g]] = np.minimum(low[self.body[g]], middle - reach)
            high[self.body[g]] = np.maximum(high[self.body[g]], middle + reach)
        empty = ~np.all(np.isfinite(low), axis=1)
        low[empty], high[empty] = np.nan, np.nan
        return (low + high) / 2, (high - low) / 2

    def shapes(self) -> dict[str, Any]:
        """Where each geom's box stands in its body, and what it is; nothing when the rows do not say."""
        if self.half is None or not all("pos" in row and "quat" in row for row in self.rows):
            return {}
        quat = np.array([row["quat"] for row in self.rows], dtype=float)
        pos = np.array([row["pos"] for row in self.rows], dtype=float)
        collides = [bool(row.get("contype", 1) or row.get("conaffinity", 1)) for row in self.rows]
        found: dict[str, Any] = {
            "geom_type": tuple(str(row.get("type", "")) for row in self.rows),
            "geom_pos": pos
            + np.einsum("gij,gj->gi", matrices(quat), np.where(np.isfinite(self.half), self.middle, 0.0)),
            "geom_quat": quat,
            "geom_collides": np.array([row.get("collides", own) for row, own in zip(self.rows, collides, strict=True)]),
        }
        if all("visible" in row for row in self.rows):
            found["geom_drawn"] = np.array([bool(row["visible"]) for row in self.rows])
        if all(row.get("friction") is not None for row in self.rows):
            slide = [float(np.ravel(row["friction"])[0]) for row in self.rows]
            found["geom_friction"] = np.where([row.get("condim", 3) == 1 for row in self.rows], 0.0, slide)
        return found

    def ground_z(self) -> float | None:
        """The highest level plane of the world that can be touched."""
        heights = []
        for g, row in enumerate(self.rows):
            collides = row.get("contype", 1) or row.get("conaffinity", 1)
            if self.body is None or row.get("type") != "plane" or self.body[g] >= 0 or not collides:
                continue
            if matrices(np.asarray(row.get("quat", (1, 0, 0, 0)), dtype=float))[2, 2] > 0.999:
                heights.append(float(row.get("pos", (0, 0, 0))[2]))
        return max(heights, default=None)


def _stranger(name: str) -> dict[str, Any]:
    """The row of a recorded body that the description does not have: the world itself, or something it leaves out."""
    unknown = [float("nan")] * 3
    return {
        "name": name,
        "mass": float("nan"),
        "ipos": [0.0] * 3,
        "iquat": [1.0, 0.0, 0.0, 0.0],
        "inertia": unknown,
        "joints": ["unknown"],
        "gravcomp": 0.0,
        "damping": 0.0,
        "dynamic": name != "world",
        "mocap": False,
    }


def _rows(value: Any) -> list[dict[str, Any]]:
    """A list of mappings, whatever a foreign file holds; plain names become rows."""
    if not isinstance(value, (list, tuple)):
        return []
    return [row if isinstance(row, dict) else {"name": str(row)} for row in value]


def _index(value: Any, names: Sequence[str], rows: list[dict[str, Any]]) -> int:
    """The position in `names` of a body given by name, or by its row in MuJoCo's order (where 0 is the world)."""
    if isinstance(value, str):
        return names.index(value) if value in names else -1
    if value is None or int(value) < 0:
        return -1
    has_world = bool(rows) and rows[0].get("name") == "world"
    row = int(value) if has_world else int(value) - 1
    return names.index(rows[row]["name"]) if 0 <= row < len(rows) and rows[row].get("name") in names else -1


def _column(rows: list[dict[str, Any]], key: str, kind: type, other: str = "") -> Array | None:
    values = [row.get(key, row.get(other)) for row in rows]
    return None if not values or any(v is None for v in values) else np.array(values, dtype=kind)


def _vector(meta: Mapping[str, Any], key: str, option: Mapping[str, Any] | None = None) -> Array | None:
    value = meta.get(key, (option or {}).get(key))
    return None if value is None else np.asarray(value, dtype=float)


def _only_drawn(meta: Mapping[str, Any]) -> bool:
    """Whether all flexes of a recording only show where the points of an author's law are, or the water of a solver."""
    moved = laws_told.drawn(meta)
    flexes = [row.get("name") for row in _rows(meta.get("flexes"))]
    return bool(flexes) and moved.issuperset(flexes)


def _visual_only(meta: Mapping[str, Any], bodies: list[dict[str, Any]], names: Sequence[str]) -> Array:
    listed = meta.get("visual_only") or ()
    listed = listed if isinstance(listed, (list, tuple)) else ()
    return np.array([bool(row.get("visual_only")) or name in listed for row, name in zip(bodies, names, strict=True)])


def _joint_type(joint: Any) -> str:
    return str(joint.get("type", "") if isinstance(joint, dict) else joint)


def _is_free(joints: Sequence[Any]) -> bool:
    return [_joint_type(joint) for joint in joints] == ["free"]


def _tied(meta: Mapping[str, Any], names: Sequence[str], rows: list[dict[str, Any]]) -> dict[str, Array]:
    """Which bodies an equality or a tendon ties (`bound`), and which an actuator or a tendon pulls (`driven`)."""
    found = {"bound": np.zeros(len(names), dtype=bool), "driven": np.zeros(len(names), dtype=bool)}
    for key, mark in (("equalities", "bound"), ("tendons", "bound"), ("actuators", "driven")):
        for row in _rows(meta.get(key)):
            ends = row.get("bodies")
            if ends is None:
                # An unknown end might be any body: calling none of them loose is the safe reading.
                found[mark][:] = True
                continue
            for end in ends:
                index = _index(end, names, rows)
                if index >= 0:
                    found[mark][index] = True
    found["driven"] |= found["bound"]
    return found


def _drives(meta: Mapping[str, Any], option: Mapping[str, Any]) -> tuple[str, ...]:
    geoms = _rows(meta.get("geoms"))
    bodies = _rows(meta.get("bodies"))
    present = {
        "actuators": bool(_rows(meta.get("actuators"))),
        "fluid": any(np.any(option.get(key, 0)) for key in ("density", "viscosity", "wind")),
        "surface velocity": any(np.any(row.get("surfacevel") or 0) for row in geoms),
        "adhesion": any(np.any(row.get("adhesion") or 0) for row in geoms),
        "mocap": any(row.get("mocap") for row in bodies),
        "gravity compensation": any(row.get("gravcomp") for row in bodies),
        "plugins": bool(meta.get("has_plugin")),
        "flexes": bool(meta.get("has_flex")) and not _only_drawn(meta),
    }
    return tuple(name for name, there in present.items() if there)

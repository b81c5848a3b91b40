"""Named channels of a recording: joints, tendons, constraints, and groups of bodies such as a rope, a cloth, a crowd."""

from collections.abc import Sequence
from fnmatch import fnmatchcase
from typing import Any, NamedTuple

import numpy as np
from pydantic import Field, model_validator

from ...model.errors import NotFoundError
from ...model.recording.trajectory import Trajectory
from .measured import Name, OfBody, UnknowableError, Windowed, body_index, one_of

Array = np.ndarray
AXES = {"x": 0, "y": 1, "z": 2}


class Channel(NamedTuple):
    """One number over time."""

    values: Array
    """(T,)"""
    unit: str
    name: str


def joint(trajectory: Trajectory, name: str) -> Channel:
    """A hinge's angle (deg) or a slide's position (m)."""
    row = _row(trajectory, "joints", "joint", name)[1]
    if trajectory.coordinates is None:
        raise UnknowableError("no joint positions were recorded")
    if row.get("type") not in ("hinge", "slide"):
        raise UnknowableError(f"'{name}' is a {row.get('type')} joint, which has no single position")
    values = trajectory.coordinates.qpos[:, int(row["qpos_address"])]
    return Channel(np.degrees(values), "deg", name) if row["type"] == "hinge" else Channel(values, "m", name)


def tendon(trajectory: Trajectory, name: str) -> Channel:
    """A tendon's length, m."""
    index, _ = _row(trajectory, "tendons", "tendon", name)
    if trajectory.coordinates is None:
        raise UnknowableError("no tendon lengths were recorded")
    return Channel(trajectory.coordinates.tendon_length[:, index], "m", name)


def tension(trajectory: Trajectory, name: str) -> Channel:
    """A tendon's tension by spring, damper and limit, N."""
    index, _ = _row(trajectory, "tendons", "tendon", name)
    if trajectory.loads is None:
        raise UnknowableError("no tensions were recorded")
    return Channel(np.abs(trajectory.loads.tendon_force[:, index]), "N", name)


def constraint_active(trajectory: Trajectory, name: str) -> Array:
    """(T,) bool: whether an equality (a weld, a connection, a pin) holds."""
    index, _ = _row(trajectory, "equalities", "constraint", name)
    if trajectory.loads is None:
        raise UnknowableError("no constraints were recorded")
    return trajectory.loads.eq_active[:, index]


def constraint_load(trajectory: Trajectory, name: str) -> Channel:
    """The force that an equality carries, N; 0 while it is off."""
    index, _ = _row(trajectory, "equalities", "constraint", name)
    if trajectory.loads is None:
        raise UnknowableError("no constraint forces were recorded")
    return Channel(trajectory.loads.eq_force[:, index], "N", name)


def constraint_torque(trajectory: Trajectory, name: str) -> Channel:
    """The torque that a weld carries, N m; 0 while it is off."""
    index, row = _row(trajectory, "equalities", "constraint", name)
    if row.get("type", "weld") != "weld":
        raise UnknowableError(f"{name} is a {row['type']}: only a weld carries a torque of its own")
    if trajectory.loads is None or trajectory.loads.eq_torque is None:
        raise UnknowableError("no constraint torques were recorded; run the physics pass again")
    return Channel(trajectory.loads.eq_torque[:, index], "N m", name)


def bond_stress(trajectory: Trajectory, name: str) -> Channel:
    """The largest tension in a bond between the pieces of what breaks, Pa; 0 once it is broken."""
    index, _ = _row(trajectory, "equalities", "constraint", name)
    if trajectory.loads is None or trajectory.loads.eq_stress is None:
        raise UnknowableError(f"no stress was recorded of {name}: `worldkit.breaking` makes bonds that have one")
    return Channel(trajectory.loads.eq_stress[:, index], "Pa", name)


def distance(trajectory: Trajectory, one: str, other: str) -> Channel:
    """The distance between the origins of two bodies, m."""
    ends = [trajectory.pos[:, body_index(trajectory, name)] for name in (one, other)]
    return Channel(np.linalg.norm(ends[1] - ends[0], axis=1), "m", f"{one} to {other}")


def group(trajectory: Trajectory, parts: str | Sequence[str]) -> list[int]:
    """The indices of bodies, in the recording's order, named by a flex, a pattern such as `rope_*`, or one by one."""
    if not isinstance(parts, str):
        return [body_index(trajectory, name) for name in parts]
    for row in _rows(trajectory, "flexes"):
        if row.get("name") == parts and row.get("bodies"):
            return [trajectory.names.index(name) for name in row["bodies"] if name in trajectory.names]
    found = [i for i, name in enumerate(trajectory.names) if fnmatchcase(name, parts)]
    if not found:
        flexes = [str(row.get("name")) for row in _rows(trajectory, "flexes")]
        raise NotFoundError(
            f"no body is called '{parts}'",
            next_move=f"name a flex ({', '.join(flexes) or 'there is none'}), or a pattern such as `rope_*`; "
            f"bodies: {', '.join(trajectory.names[:20])}",
        )
    return found


class OfParts(Windowed):
    """A body made of parts."""

    parts: str | tuple[Name, ...] = Field(
        description="a flex, what shows a law's points, a pattern such as `rope_*`, or bodies"
    )

    @model_validator(mode="after")
    def _some(self) -> "OfParts":
        if not self.parts:
            raise ValueError("name a flex, a pattern such as `rope_*`, or bodies")
        return self

    def told(self) -> str:
        """The words by which messages call it."""
        return self.parts if isinstance(self.parts, str) else ", ".join(self.parts[:3])


class OfLength(Windowed):
    """Something that has a length."""

    tendon: Name | None = Field(None, description="a tendon; or")
    bodies: tuple[Name, Name] | None = Field(None, description="two bodies, whose origins are so far apart")

    @model_validator(mode="after")
    def _one(self) -> "OfLength":
        one_of(self, "tendon", "bodies")
        return self

    def channel(self, trajectory: Trajectory) -> Channel:
        """Its length over time, m."""
        return tendon(trajectory, self.tendon) if self.tendon else distance(trajectory, *(self.bodies or ("", "")))


class OfSignal(Windowed):
    """Something that swings: a body along a direction, or a joint."""

    body: Name | None = Field(None, description="a body; or")
    joint: Name | None = Field(None, description="a hinge or slide")
    along: str = Field(
        "principal", pattern="^(x|y|z|principal)$", description="of a body: x, y, z, or the direction it moves most in"
    )

    @model_validator(mode="after")
    def _one(self) -> "OfSignal":
        one_of(self, "body", "joint")
        return self

    def channel(self, trajectory: Trajectory, rows: slice) -> Channel:
        """Its coordinate in these rows, m or deg."""
        if self.joint:
            whole = joint(trajectory, self.joint)
            return whole._replace(values=whole.values[rows])
        return coordinate(trajectory, self.body or "", self.along, rows)


def coordinate(trajectory: Trajectory, body: str, along: str, rows: slice) -> Channel:
    """A body's origin along x, y, z, or the direction in which it moves most, m, in the rows of a window."""
    path = trajectory.pos[rows, body_index(trajectory, body)]
    if along in AXES:
        return Channel(path[:, AXES[along]], "m", body)
    apart = path - path.mean(axis=0)
    _, _, axes = np.linalg.svd(apart[:: max(1, len(apart) // 2000)], full_matrices=False)
    axis = axes[0] * (1.0 if axes[0][np.abs(axes[0]).argmax()] > 0 else -1.0)
    return Channel(apart @ axis, "m", body)


def direction_of(trajectory: Trajectory, given: OfBody, axis: str) -> Array:
    """(rows, 3) a body's own x, y or z axis in the world frame, over the window."""
    from worldkit.turning import matrices

    from .measured import window

    quat = trajectory.quat[window(trajectory, given.window_s), body_index(trajectory, given.body)]
    return matrices(quat)[:, :, AXES[axis]]


def _rows(trajectory: Trajectory, key: str) -> list[dict[str, Any]]:
    found = trajectory.meta.get(key) or ()
    return [row for row in found if isinstance(row, dict)]


def _row(trajectory: Trajectory, key: str, kind: str, name: str) -> tuple[int, dict[str, Any]]:
    rows = _rows(trajectory, key)
    for index, row in enumerate(rows):
        if row.get("name") == name:
            return index, row
    known = ", ".join(str(row.get("name")) for row in rows) or "(none)"
    raise NotFoundError(f"there is no {kind} '{name}' in this recording", next_move=f"name one of: {known}")

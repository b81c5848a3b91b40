"""What a recording holds besides one row per instant: contact points, and what acted besides the engine's own step.

Frozen numpy arrays in the units and the frame of `worldwright.model.recording.trajectory`; a body index of -1 is the world.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np

Array = np.ndarray


@dataclass(frozen=True)
class Contacts:
    """N contact points, in the order of their rows."""

    row: Array
    """(N,) recorded row each belongs to."""
    body1: Array
    """(N,) index of the first body."""
    body2: Array
    """(N,) index of the second body."""
    depth_m: Array
    """(N,) penetration depth, positive when the surfaces overlap."""
    normal_force: Array
    """(N,) N, along the normal."""
    force: Array | None = None
    """(N, 3) N, on the second body, world frame."""
    position: Array | None = None
    """(N, 3) m."""
    normal: Array | None = None
    """(N, 3) unit vector from the first to the second body."""
    geom1: Array | None = None
    """(N,) geom rows in the mechanics, when known."""
    geom2: Array | None = None

    @property
    def live(self) -> Array:
        """(N,) bool: pushes or overlaps, rather than only being near."""
        return (self.normal_force > 0) | (self.depth_m > 0)

    def of_pair(self, one: int, other: int) -> Array:
        """(N,) bool: between these two bodies, either way round."""
        return ((self.body1 == one) & (self.body2 == other)) | ((self.body1 == other) & (self.body2 == one))

    def before(self, row: int) -> "Contacts":
        """Those of the rows up to `row`, exclusive."""
        return self.take(slice(0, int(np.searchsorted(self.row, row))))

    def take(self, mask: Array | slice) -> "Contacts":
        """Only the contacts where `mask` (N,) is true, or a stretch of them."""
        columns = {f.name: getattr(self, f.name) for f in fields(self)}
        kept: dict[str, Any] = {name: None if column is None else column[mask] for name, column in columns.items()}
        return Contacts(**kept)


@dataclass(frozen=True)
class Interventions:
    """K records of something acting on the state besides the engine's own step."""

    time: Array
    """(K,) s."""
    kind: Sequence[str]
    """(K,) force, torque, control, pose, velocity, mocap, constraint or parameter."""
    target: Sequence[str]
    """(K,) body, actuator, constraint or model field."""
    value: Array
    """(K, 6) in the kind's own unit, zero-padded."""
    work_j: Array
    """(K,) J done on the system."""

    @cached_property
    def groups(self) -> dict[tuple[str, str], Array]:
        """The rows of each kind on each target, in the order in which they first acted: of a crowd there are millions."""
        number: dict[tuple[str, str], int] = {}
        pairs = zip(self.kind, self.target, strict=True)
        which = np.fromiter((number.setdefault(pair, len(number)) for pair in pairs), np.int32, len(self.time))
        order = np.argsort(which, kind="stable")
        ends = np.searchsorted(which[order], np.arange(len(number) + 1))
        return {(str(k), str(t)): order[ends[n] : ends[n + 1]] for (k, t), n in number.items()}

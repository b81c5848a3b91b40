"""Generalised coordinates of a recording: what joints, tendons and constraints say beyond the poses of bodies."""

from dataclasses import dataclass, fields, replace

import numpy as np

Array = np.ndarray


@dataclass(frozen=True)
class Coordinates:
    """Channels of one recording, T rows; the recording's meta names the joints, tendons and equalities."""

    qpos: Array
    """(T, nq) m, rad, unit quaternions."""
    qvel: Array
    """(T, nv) m/s, rad/s."""
    tendon_length: Array
    """(T, N) m or rad."""
    eq_residual: Array
    """(T, E) m or rad: violation of each equality; nan while it is off."""

    def before(self, row: int) -> "Coordinates":
        """The channels up to `row`, exclusive."""
        return replace(self, **{f.name: getattr(self, f.name)[:row] for f in fields(self)})

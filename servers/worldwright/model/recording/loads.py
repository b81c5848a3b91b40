"""Forces of constraints, tendons and actuators, and what is drawn: the channels that show what carries and what acts."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

Array = np.ndarray


@dataclass(frozen=True)
class Loads:
    """Channels of one recording, T rows; names and bodies of their columns are in the recording's meta."""

    eq_force: Array
    """(T, E) N (N·m where an equality ties hinges): norm of each equality's force, 0 while it is off."""
    eq_active: Array
    """(T, E) bool."""
    tendon_force: Array
    """(T, N) N: tension of each tendon by its spring, damper and limit."""
    actuator_force: Array
    """(T, U) N or N·m."""
    ctrl: Array
    """(T, U)."""
    eq_torque: Array | None = None
    """(T, E) N·m: norm of each weld's torque, 0 for other equalities; None in recordings that do not have it."""
    eq_stress: Array | None = None
    """(T, E) Pa: the largest tension in each bond (`worldkit.breaking`), 0 for other equalities; None where there is no bond."""
    edits: Sequence[tuple[float, str, int, float]] = ()
    """Time in s, name of the model array, flat index, new value: every edit of the model, looks included."""
    overlaps: Sequence[dict[str, Any]] | None = None
    """Visible geoms seen to overlap though they cannot collide; None when nobody looked."""

    def before(self, row: int) -> "Loads":
        """The channels up to `row`, exclusive."""
        cut = {f.name: getattr(self, f.name)[:row] for f in fields(self)[:5]}
        torque, stress = (None if a is None else a[:row] for a in (self.eq_torque, self.eq_stress))
        return replace(self, **cut, eq_torque=torque, eq_stress=stress)

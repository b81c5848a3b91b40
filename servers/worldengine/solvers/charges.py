"""Simulate charged bodies that attract and repel each other, and a uniform field.

    F = q q' / (4 pi epsilon0 r^2), apart where signs agree; F = q E

Each of its bodies carries its charge at its centre of mass, and keeps it: what touches does not share. Bodies that stand fast act and
are acted on, too. Two nearer than 0.1 mm are no points any more, so that none is pushed without end. Source: Jackson, Classical Electrodynamics, sections 1.1 and 1.11 (`worldkit.fields.coulomb`).
"""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from worldkit.fields import EPSILON0, coulomb

from ..recording.columns import Column
from . import Case, each

if TYPE_CHECKING:
    import mujoco
    import numpy as np

CONSTANTS = {"charge": ("C", "of each of its bodies")}
OPTIONAL = {
    "field_x": ("V/m", "of a field from far away, along X"),
    "field_y": ("V/m", "along Y"),
    "field_z": ("V/m", "along Z"),
}
EACH = frozenset({"charge"})
STANDING = True
ENERGY = Column("energy", (), "J", "of the charges in each other's field, and in that from far away")
CASES = (
    Case(
        '<mujoco><option timestep="0.0005" gravity="0 0 0"/><worldbody><body name="a"><freejoint/><geom size="0.01" mass="0.01"/></body>'
        '<body name="b" pos="0.1 0 0"><freejoint/><geom size="0.01" mass="0.03"/></body></worldbody></mujoco>',
        bodies=("a", "b"),
        constants={"charge": (1e-6, 2e-6)},
        # From rest at r0 to r: t = sqrt(mu r0^3 / (2 k)) (sqrt(x (x - 1)) + ln(sqrt(x) + sqrt(x - 1))), x = r / r0, here 2.
        seconds=round(math.sqrt(0.0075 * 0.1**3 * 4 * math.pi * EPSILON0 / (2 * 2e-12)) * 2.295587149392638, 3),
        channel="energy",
        expected=2e-12 / (4 * math.pi * EPSILON0 * 0.2),
        tolerance=0.003 * 2e-12 / (4 * math.pi * EPSILON0 * 0.2),
        because="Kepler's radial fall with a repelling force: how long two charges take from rest to twice their distance",
    ),
)


class Charges:
    """They, at work on some bodies."""

    def __init__(self, bodies: Sequence[int], constants: Mapping[str, Any]) -> None:
        import numpy as np

        self._bodies, self._charge = np.array(bodies), each(constants["charge"], len(bodies))
        self._uniform = np.array([constants.get(f"field_{axis}", 0.0) for axis in "xyz"], float)
        self.channels = {ENERGY: np.zeros(())}

    def look(self, data: "mujoco.MjData") -> "np.ndarray":
        """The energy and the forces (n, 6)."""
        import numpy as np

        forces, energy = coulomb.felt(data.xipos[self._bodies], self._charge, self._uniform)
        self.channels[ENERGY][...] = energy
        return np.concatenate([forces, np.zeros_like(forces)], axis=1)

    def advance(self, step_s: float) -> None:
        """Do nothing: charges stay what they are."""


def start(
    model: "mujoco.MjModel",
    data: "mujoco.MjData",
    bodies: Sequence[int],
    constants: Mapping[str, Any],
    shown_by: str = "",
) -> Charges:
    """Start them where they are."""
    return Charges(bodies, constants)


def show(model: "mujoco.MjModel", data: "mujoco.MjData", geom: int, channels: Mapping[str, Any]) -> None:
    """Do nothing: no field is seen."""

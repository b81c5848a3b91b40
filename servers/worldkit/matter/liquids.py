"""A viscous liquid, from water to honey: slightly compressible, Newtonian, without surface tension.

tau = -J p I + J mu (L + L^T - 2/3 tr L I), p = rho c^2 (1 - J), none where J > 1 (it parts), unless it draws threads: then it
resists being pulled apart as it does being pressed, and a stream grows thin instead. J is drawn slowly towards what the grid says
that the density is, so that what parted and met again neither gains nor loses room. Source: Batchelor, An Introduction to Fluid
Dynamics, section 3.3; equation of state linear in the compression.
"""

from dataclasses import dataclass

import numpy as np

from .beforehand import check_positive
from .kernels import kernel

Array = np.ndarray
PARTED = 1.1
"""J goes no farther: drops that meet again are one liquid soon."""
CORRECTED = 4.0
"""1/s: how fast J follows the density on the grid."""


@dataclass(frozen=True)
class Liquid:
    """What a liquid is.

    Args:
        density: kg/m^3.
        viscosity: Pa s: water 0.001, oil 0.1, honey 10.
        sound: m/s; how stiff it is. None: seven times what it reaches falling; the real one would ask a hundred times the steps.
        sticks: whether it keeps to walls; None: where viscosity reaches a cell in a second.
        threads: whether it holds together when it is pulled, as honey and syrup do.
    """

    density: float = 1000.0
    viscosity: float = 0.001
    sound: float | None = None
    sticks: bool | None = None
    threads: bool = False

    friction, scatter = 0.0, 0.0

    def __post_init__(self) -> None:
        """Refuse what nothing can be (`ProgramError`)."""
        check_positive("a liquid", density=self.density, sound=self.sound)

    def carried(self, pull: float) -> float:  # noqa: ARG002
        """1/s: air does nothing to it."""
        return 0.0

    def aloft(self, crowd: Array) -> Array:
        """(n,) none is carried by air."""
        return np.zeros(len(crowd), bool)

    def fastest(self, falls: float) -> float:
        """m/s: what it reaches falling freely."""
        return falls

    def stiffness(self, sound: float) -> tuple[float, ...]:
        """Numbers of the law, for a speed of sound, m/s; the last one, 1 or 0, is whether it pulls."""
        return (self.density * sound**2, self.viscosity, self.density, float(self.threads))

    def holds(self, cell: float) -> bool:
        """Whether it sticks to walls, on a grid of this side, m."""
        return self.sticks if self.sticks is not None else bool(np.sqrt(self.viscosity / self.density) > cell)

    def longest(self, sound: float, cell: float) -> float:
        """s: the longest stable step, by sound and by viscosity."""
        return min(0.4 * cell / sound, 0.12 * self.density * cell**2 / max(self.viscosity, 1e-12))

    def begins(self, count: int) -> Array:
        """(n, 1): J of each point."""
        return np.ones((count, 1))

    def advance(self, law: Array, state: Array, c: Array, crowd: Array, tau: Array, count: int, dt: float) -> None:
        """Advance the state by dt with the slope of velocity c (n, 3, 3), and write tau (n, 6), Pa."""
        flow(law, state, c, crowd, tau, count, dt)

    def stored(self, law: Array, state: Array) -> Array:
        """(n,) J/m^3 stored."""
        strain = state[:, 0] - 1.0
        return np.asarray(0.5 * law[0] * np.where(strain > 0, law[3], 1.0) * strain**2)

    def room(self, state: Array) -> Array:
        """(n,) its volume, as a share of that at rest; what parts does not grow."""
        return np.minimum(state[:, 0], 1.0)


@kernel
def flow(law, state, c, crowd, tau, count, dt):
    """Advance the points of a liquid; arguments as `Liquid.advance`."""
    stiff, mu, rho, pulls = law[0], law[1], law[2], law[3]
    for p in range(count):
        spread = c[p, 0, 0] + c[p, 1, 1] + c[p, 2, 2]
        j = state[p, 0] * (1.0 + dt * spread)
        seen = crowd[p]
        if seen > rho / max(j, 0.5):
            j += dt * CORRECTED * (min(max(rho / seen, 0.8), PARTED) - j)
        j = min(max(j, 0.5), PARTED)
        state[p, 0] = j
        push = -j * stiff * (1.0 - j) * (1.0 if j < 1.0 else pulls)
        push -= j * mu * 2.0 / 3.0 * spread
        tau[p, 0] = push + 2.0 * j * mu * c[p, 0, 0]
        tau[p, 1] = push + 2.0 * j * mu * c[p, 1, 1]
        tau[p, 2] = push + 2.0 * j * mu * c[p, 2, 2]
        tau[p, 3] = j * mu * (c[p, 0, 1] + c[p, 1, 0])
        tau[p, 4] = j * mu * (c[p, 0, 2] + c[p, 2, 0])
        tau[p, 5] = j * mu * (c[p, 1, 2] + c[p, 2, 1])

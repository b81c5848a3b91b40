"""Dry sand: grains that only friction holds (Drucker and Prager), elastic in Hencky's logarithmic strains.

Source: Klar et al. 2016, "Drucker-Prager Elastoplasticity for Sand Animation"; what parted must come together again before it
pushes (the volume correction of Tampubolon et al. 2017). Grains share one velocity, so they neither segregate nor spray.
"""

from dataclasses import dataclass

import numpy as np

from .beforehand import check_positive
from .kernels import kernel
from .principal import grown, principal, rebuilt

Array = np.ndarray
POISSON = 0.3


@dataclass(frozen=True)
class Sand:
    """What a sand is.

    Args:
        density: kg/m^3, of the heap, pores and all.
        friction_angle: degrees, inside.
        wall_friction: 1; None: the tangent of the friction angle.
        sound: m/s; how stiff it is. None: seven times what it reaches falling, softer than real grains.
    """

    density: float = 1600.0
    friction_angle: float = 32.0
    wall_friction: float | None = None
    sound: float | None = None

    scatter = 0.2

    def __post_init__(self) -> None:
        """Refuse what nothing can be (`ProgramError`)."""
        check_positive("a sand", density=self.density, sound=self.sound)

    @property
    def friction(self) -> float:
        """Against walls."""
        return float(np.tan(np.radians(self.friction_angle))) if self.wall_friction is None else self.wall_friction

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
        """Numbers of the law: Lame's two, Pa, and the slope of the cone (matched in compression)."""
        along = self.density * sound**2
        mu = along * (1 - 2 * POISSON) / (2 * (1 - POISSON))
        sine = np.sin(np.radians(self.friction_angle))
        return (along - 2 * mu, mu, float(np.sqrt(2 / 3) * 2 * sine / (3 - sine)))

    def holds(self, cell: float) -> bool:  # noqa: ARG002
        """Friction alone."""
        return False

    def longest(self, sound: float, cell: float) -> float:
        """s: the longest stable step."""
        return 0.4 * cell / sound

    def begins(self, count: int) -> Array:
        """(n, 7): left Cauchy-Green of the elastic part, and the volume strain that parted."""
        state = np.zeros((count, 7))
        state[:, :3] = 1.0
        return state

    def advance(self, law: Array, state: Array, c: Array, crowd: Array, tau: Array, count: int, dt: float) -> None:  # noqa: ARG002
        """Advance the state by dt with the slope of velocity c (n, 3, 3), and write tau (n, 6), Pa."""
        slide(law, state, c, tau, count, dt)

    def stored(self, law: Array, state: Array) -> Array:
        """(n,) J/m^3 stored: mu e:e + lambda / 2 tr(e)^2."""
        lam, mu, _ = law
        b = np.empty((len(state), 3, 3))
        for (i, j), at in (((0, 0), 0), ((1, 1), 1), ((2, 2), 2), ((0, 1), 3), ((0, 2), 4), ((1, 2), 5)):
            b[:, i, j] = b[:, j, i] = state[:, at]
        e = 0.5 * np.log(np.maximum(np.linalg.eigvalsh(b), 1e-9))
        return np.asarray(mu * (e**2).sum(axis=1) + 0.5 * lam * e.sum(axis=1) ** 2)

    def room(self, state: Array) -> Array:
        """(n,) its volume, as a share of that at rest, without what parted."""
        xx, yy, zz, xy, xz, yz = state[:, :6].T
        return np.sqrt(np.maximum(xx * (yy * zz - yz**2) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz), 0.0))


@kernel
def slide(law, state, c, tau, count, dt):
    """Advance the points of a sand; arguments as `Sand.advance`."""
    lam, mu, cone = law[0], law[1], law[2]
    f, a, q, e = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3)), np.empty(3)
    for p in range(count):
        grown(state[p], c[p], dt, f, a)
        principal(a, q)
        for i in range(3):
            e[i] = 0.5 * np.log(max(a[i, i], 1e-6))
        parted = state[p, 6]
        volume = e[0] + e[1] + e[2] + parted
        if volume >= 0.0:
            state[p, 6] = min(volume, 1.0)
            state[p, 0], state[p, 1], state[p, 2] = 1.0, 1.0, 1.0
            state[p, 3], state[p, 4], state[p, 5] = 0.0, 0.0, 0.0
            tau[p, :] = 0.0
            continue
        for i in range(3):  # what parted closes first, all sides alike
            e[i] += parted / 3.0
        state[p, 6] = 0.0
        mean = volume / 3.0
        shear = np.sqrt((e[0] - mean) ** 2 + (e[1] - mean) ** 2 + (e[2] - mean) ** 2)
        over = shear + (3.0 * lam + 2.0 * mu) / (2.0 * mu) * volume * cone
        if over > 0.0:
            share = 1.0 - over / shear
            for i in range(3):
                e[i] = mean + share * (e[i] - mean)
        rebuilt(np.exp(2.0 * e[0]), np.exp(2.0 * e[1]), np.exp(2.0 * e[2]), q, state[p])
        total = lam * (e[0] + e[1] + e[2])
        rebuilt(2.0 * mu * e[0] + total, 2.0 * mu * e[1] + total, 2.0 * mu * e[2] + total, q, tau[p])

"""Snow: an elastic solid that yields to little strain, and grows hard where it is pressed together.

Source: Stomakhin et al. 2013, "A Material Point Method for Snow Simulation": fixed corotated, its stretches kept between
1 - `gives` and 1 + `tears`, its stiffness exp(hardening (1 - J_p)) times that of fresh snow. Flakes that fall apart from one another feel no stress.
"""

from dataclasses import dataclass

import numpy as np

from .beforehand import check_positive
from .kernels import kernel
from .principal import grown, principal, rebuilt

Array = np.ndarray
LOOSE = 0.5
"""What the grid shows as less than this share of the density is flakes in the air."""
FLUFFED = 1.5
"""J_p of flakes that come to lie on one another: they are soft until they have settled."""
SOFTEST, HARDEST = 0.05, 4.0
"""Bounds of what hardening makes of the stiffness: the step in time is for the latter."""


@dataclass(frozen=True)
class Snow:
    """What a snow is.

    Args:
        density: kg/m^3: fresh 60 to 150, packed 400.
        young: Pa, fresh; None: as stiff as `sound` says.
        poisson: 1.
        gives, tears: strain beyond which it yields, pressed and pulled.
        hardening: 1.
        wall_friction: 1.
        falls: m/s at which air lets flakes fall, by a drag in proportion to speed; what carries them is `world`.
        sound: m/s, in place of `young`. None: seven times the speed at which it falls.
    """

    density: float = 120.0
    young: float | None = None
    poisson: float = 0.2
    gives: float = 0.025
    tears: float = 0.0075
    hardening: float = 10.0
    wall_friction: float = 0.6
    falls: float = 1.0
    sound: float | None = None

    scatter = 0.2

    def __post_init__(self) -> None:
        """Refuse what nothing can be (`ProgramError`)."""
        check_positive("a snow", density=self.density, young=self.young, falls=self.falls, sound=self.sound)

    @property
    def friction(self) -> float:
        """Against walls."""
        return self.wall_friction

    def carried(self, pull: float) -> float:
        """1/s: how fast air takes the speed of flakes, under a gravity of this size, m/s^2."""
        return pull / self.falls

    def aloft(self, crowd: Array) -> Array:
        """(n,) which points are flakes in the air, by the density on the grid, kg/m^3."""
        return crowd < LOOSE * self.density

    def fastest(self, falls: float) -> float:
        """m/s: what it reaches, which would fall so fast without air."""
        return min(falls, 1.5 * self.falls)

    def stiffness(self, sound: float) -> tuple[float, ...]:
        """Numbers of the law: Lame's two, Pa, both limits, hardening, and the density below which it is loose."""
        young = self.density * sound**2 if self.young is None else self.young
        mu, nu = young / (2 * (1 + self.poisson)), self.poisson
        return (2 * mu * nu / (1 - 2 * nu), mu, self.gives, self.tears, self.hardening, LOOSE * self.density)

    def holds(self, cell: float) -> bool:  # noqa: ARG002
        """Friction alone."""
        return False

    def longest(self, sound: float, cell: float) -> float:
        """s: the longest stable step, where it is hardest."""
        lam, mu, *_ = self.stiffness(sound)
        return 0.4 * cell / float(np.sqrt(HARDEST * (lam + 2 * mu) / self.density))

    def begins(self, count: int) -> Array:
        """(n, 7): left Cauchy-Green of the elastic part, and J of the plastic one."""
        state = np.zeros((count, 7))
        state[:, :3] = state[:, 6] = 1.0
        return state

    def advance(self, law: Array, state: Array, c: Array, crowd: Array, tau: Array, count: int, dt: float) -> None:
        """Advance the state by dt with the slope of velocity c (n, 3, 3), and write tau (n, 6), Pa."""
        pack(law, state, c, crowd, tau, count, dt)

    def stored(self, law: Array, state: Array) -> Array:
        """(n,) J/m^3 stored: mu |s - 1|^2 + lambda / 2 (J - 1)^2, hardened."""
        b = np.empty((len(state), 3, 3))
        for (i, j), at in (((0, 0), 0), ((1, 1), 1), ((2, 2), 2), ((0, 1), 3), ((0, 2), 4), ((1, 2), 5)):
            b[:, i, j] = b[:, j, i] = state[:, at]
        s = np.sqrt(np.maximum(np.linalg.eigvalsh(b), 1e-9))
        hard = np.clip(np.exp(law[4] * (1 - state[:, 6])), SOFTEST, HARDEST)
        return np.asarray(hard * (law[1] * ((s - 1) ** 2).sum(axis=1) + 0.5 * law[0] * (s.prod(axis=1) - 1) ** 2))

    def room(self, state: Array) -> Array:
        """(n,) none is kept: it is packed."""
        return np.zeros(len(state))


@kernel
def pack(law, state, c, crowd, tau, count, dt):
    """Advance the points of a snow; arguments as `Snow.advance`."""
    gives, tears = 1.0 - law[2], 1.0 + law[3]
    f, a, q, s = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3)), np.empty(3)
    for p in range(count):
        if crowd[p] < law[5]:
            state[p, 0], state[p, 1], state[p, 2], state[p, 6] = 1.0, 1.0, 1.0, FLUFFED
            state[p, 3], state[p, 4], state[p, 5] = 0.0, 0.0, 0.0
            tau[p, :] = 0.0
            continue
        grown(state[p], c[p], dt, f, a)
        principal(a, q)
        kept = 1.0
        for i in range(3):
            full = np.sqrt(max(a[i, i], 1e-6))
            s[i] = min(max(full, gives), tears)
            kept *= full / s[i]
        state[p, 6] = min(max(state[p, 6] * kept, 0.3), FLUFFED)
        rebuilt(s[0] * s[0], s[1] * s[1], s[2] * s[2], q, state[p])
        hard = min(max(np.exp(law[4] * (1.0 - state[p, 6])), SOFTEST), HARDEST)
        j = s[0] * s[1] * s[2]
        mu, swell = 2.0 * law[1] * hard, law[0] * hard * (j - 1.0) * j
        rebuilt(
            mu * (s[0] - 1.0) * s[0] + swell, mu * (s[1] - 1.0) * s[1] + swell, mu * (s[2] - 1.0) * s[2] + swell, q, tau[p]
        )  # fmt: skip

"""Bodies that warm and cool, each with one temperature, and melt.

    C dT/dt = P - H (T - T_around) - sum of K (T - T_other)

H in W/K is Newton's cooling, K in W/K the conductance to each body that is touched, P in W a source. A step is that of Crank and Nicolson,
cut into parts that are short beside the fastest time of the network, so that nothing overshoots or oscillates. What melts takes its heat
at one temperature until its latent heat is spent; it does not freeze again below it unless heat leaves.
One temperature a body holds while its Biot number, h d / k, is below 0.1. Source: Incropera and DeWitt, Heat and Mass Transfer, chapter 5.
"""

from dataclasses import dataclass

import numpy as np

from .elimination import solved

Array = np.ndarray
PARTS_A_TIME = 20.0
"""Parts of a step for each of the network's fastest time."""


@dataclass
class Warmth:
    """The state of n bodies."""

    temperature: Array
    """(n,) K."""
    capacity: Array
    """(n,) J/K."""
    loss: Array
    """(n,) W/K to what is around."""
    around: float
    """K."""
    source: Array
    """(n,) W."""
    melts: Array
    """(n,) K; infinite where nothing melts."""
    latent: Array
    """(n,) J in all, to melt the whole body."""

    def __post_init__(self) -> None:
        self.spent = np.zeros(len(self.temperature))
        """(n,) J of the latent heat."""
        self.lost = 0.0
        """J to what is around, since the start."""
        self.made = 0.0
        """J of the sources."""

    @property
    def melted(self) -> Array:
        """(n,) share of each body that is molten."""
        return np.asarray(np.divide(self.spent, self.latent, out=np.zeros_like(self.spent), where=self.latent > 0))

    @property
    def stored(self) -> float:
        """J, above 0 K."""
        return float((self.capacity * self.temperature).sum() + self.spent.sum())

    def advance(self, seconds: float, touching: Array) -> None:
        """Go on by so long, with conductances (n, n) W/K, symmetric, between the bodies."""
        leaves = np.diag(touching.sum(axis=1) + self.loss) - touching
        fastest = float((np.diag(leaves) / self.capacity).max(initial=0.0))
        parts = max(1, int(np.ceil(seconds * fastest * PARTS_A_TIME - 1e-9)))
        h = seconds / parts
        for _ in range(parts):
            held = (self.latent > 0) & (self.temperature >= self.melts - 1e-12) & (self.spent < self.latent)
            held |= (self.latent > 0) & (self.spent > 0) & (self.temperature <= self.melts + 1e-12)
            self._part(h, leaves, held)

    def _part(self, h: float, leaves: Array, held: Array) -> None:
        """One part; those that are `held` stay at their melting point, and what flows melts them."""
        gets = h * (self.source + self.loss * self.around)
        before, free = self.temperature, ~held
        now = before.copy()
        now[held] = self.melts[held]
        if free.any():
            half = h / 2 * leaves
            right = (
                self.capacity * before + gets - (half * before).sum(axis=1) - (half[:, held] * now[held]).sum(axis=1)
            )
            now[free] = solved((np.diag(self.capacity) + half)[np.ix_(free, free)], right[free])
        mean = (before + now) / 2
        flows = gets - h * (leaves * mean).sum(axis=1)
        self.spent[held] += flows[held] + self.capacity[held] * (before[held] - now[held])
        self.lost += h * float((self.loss * (mean - self.around)).sum())
        self.made += h * float(self.source.sum())
        self.temperature = now
        self._turn_over()

    def _turn_over(self) -> None:
        """Where a body reached its melting point, was molten, or froze: what is too much of one becomes the other."""
        over = (self.latent > 0) & (self.temperature > self.melts) & (self.spent < self.latent)
        self.spent[over] += self.capacity[over] * (self.temperature[over] - self.melts[over])
        self.temperature[over] = self.melts[over]
        too = self.spent - self.latent
        done = (self.latent > 0) & (too > 0)
        self.temperature[done] += too[done] / self.capacity[done]
        self.spent[done] = self.latent[done]
        below = (self.latent > 0) & (self.temperature < self.melts) & (self.spent > 0)
        self.spent[below] -= self.capacity[below] * (self.melts[below] - self.temperature[below])
        self.temperature[below] = self.melts[below]
        frozen = self.spent < 0
        self.temperature[frozen] += self.spent[frozen] / self.capacity[frozen]
        self.spent[frozen] = 0.0

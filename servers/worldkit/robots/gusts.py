"""Wind that comes and goes, the same at every repetition, and the drag that it makes."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

HZ = (0.05, 2.0)
"""Between which it changes; what changes quicker is smaller than a drone."""
PARTS = 16
KNEE_HZ = 0.3
"""Above it gusts weaken as Dryden's do, by the square of the frequency in power."""


@dataclass(frozen=True)
class Gusts:
    """A wind of `mean` (3,), m/s, and what comes and goes of it, `strength` m/s as the root of its mean square along each axis.

    A sum of sines whose power falls with the frequency as in Dryden's model of turbulence (MIL-F-8785C, 3.7.2), with phases by a seed.
    """

    mean: tuple[float, float, float]
    strength: float
    seed: int = 0

    @cached_property
    def _sines(self) -> "tuple[np.ndarray, np.ndarray, np.ndarray]":
        import numpy as np

        hz = np.geomspace(*HZ, PARTS)
        power = np.gradient(hz) / (1 + (hz / KNEE_HZ) ** 2)
        phases = np.random.default_rng(self.seed).uniform(0, 2 * np.pi, (3, PARTS))
        return 2 * np.pi * hz, np.sqrt(2 * power / power.sum()), phases

    def wind(self, time: float) -> "np.ndarray":
        """(3,), m/s, at a time, s."""
        import numpy as np

        rates, sizes, phases = self._sines
        found: np.ndarray = np.asarray(self.mean) + self.strength * (sizes * np.sin(rates * time + phases)).sum(axis=1)
        return found

"""What small waves on water of one depth do (Airy's linear theory): how fast each goes, and what is felt of it below.

    eta_t = G phi + sources,   phi_t = -(g + sigma k^2 / rho) eta - p / rho,   G = k tanh(k h)

so that omega^2 = (g k + sigma k^3 / rho) tanh(k h). At the depth d the pressure of a wave, and what a source of volume does to the
surface, is fainter by cosh(k (h - d)) / cosh(k h): one is the other's mirror, which keeps energy.
Source: Lamb, Hydrodynamics (1932), sections 228 and 267; Newman, Marine Hydrodynamics (1977), section 6.
"""

from dataclasses import dataclass

import numpy as np

Array = np.ndarray


@dataclass(frozen=True)
class Airy:
    """The waves of one body of water."""

    gravity: float
    """m/s^2, downwards."""
    depth: float
    """m, on the mean."""
    stiff: float
    """Surface tension over density, m^3/s^2."""
    quickest: float = np.inf
    """rad/s: waves of the grid's own size, which nobody sees, are not let go faster."""

    def lift(self, k: Array) -> Array:
        """G, 1/m."""
        return np.asarray(k * np.tanh(np.minimum(k * self.depth, 50.0)))

    def restoring(self, k: Array) -> Array:
        """What pulls a wave of height 1 back, m/s^2."""
        free = self.gravity + self.stiff * k * k
        return np.asarray(np.minimum(free, self.quickest**2 / np.maximum(self.lift(k), 1e-12)))

    def frequency(self, k: Array) -> Array:
        """omega, rad/s."""
        return np.asarray(np.sqrt(self.restoring(k) * self.lift(k)))

    def below(self, depth: float, k: Array) -> Array:
        """The share that is felt at a depth, m."""
        d = min(depth, self.depth)
        up, down = np.exp(-k * d), np.exp(-k * (2 * self.depth - d))
        return np.asarray((up + down) / (1 + np.exp(-2 * k * self.depth)))


def ruffled(grid_k: Array, wind: float, fetch: float, gravity: float) -> Array:
    """The spectrum of the surface's height over the wave number's plane, m^4, where a wind, m/s, has blown over a fetch, m.

    JONSWAP's: Hasselmann and others, "Measurements of wind-wave growth" (1973); spread evenly over all ways, as walls do.
    """
    k = np.maximum(grid_k, 1e-6)
    omega = np.sqrt(gravity * k)
    peak = 22.0 * (gravity**2 / (wind * fetch)) ** (1 / 3)
    alpha = 0.076 * (wind**2 / (fetch * gravity)) ** 0.22
    width = np.where(omega <= peak, 0.07, 0.09)
    enhanced = 3.3 ** np.exp(-((omega / peak - 1) ** 2) / (2 * width**2))
    by_omega = alpha * gravity**2 / omega**5 * np.exp(-1.25 * (peak / omega) ** 4) * enhanced
    return np.asarray(by_omega * (0.5 * omega / k) / (2 * np.pi * k))

"""Some bodies lose mechanical energy, and never gain any on the way.

Measures the share of the energy at the start of the window (kinetic, and potential of weight above the lowest height)
that is gone at its end; the energy may never exceed an earlier value by more than `tolerance` of it. What a soft contact
takes and gives back within a tenth of a second is no gain.
Source: the work-energy theorem with friction and inelastic impact.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import bouncing, falling, sliding
from ....measuring.energetics import mechanical
from ....measuring.measured import Measured, OfBodies, Tolerance, all_of, at_least, at_most, window

CODE = "WE200"
EVENT = True


BLOW_S = 0.1


def _filled(energy: np.ndarray, rows: int) -> np.ndarray:
    """Fill dips of up to so many rows in the energy: a sliding maximum, then a sliding minimum."""
    reach = min(max(rows // 2, 0), (len(energy) - 1) // 2)
    if not reach:
        return energy
    padded = np.pad(energy, reach, mode="edge")
    high = np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1).max(axis=1)
    padded = np.pad(high, reach, mode="edge")
    return np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1).min(axis=1)


class Given(OfBodies):
    """The bodies, and the share of energy to lose."""

    min_share: float = Field(gt=0, le=1, description="least share of the energy that is lost")
    tolerance: Tolerance = Field(0.02, description="largest gain on the way, relative to the energy at the start")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the share lost."""
    rows = window(trajectory, given.window_s, 2)
    energy = mechanical(trajectory, rows, given.indices(trajectory))
    start = float(energy[0])
    if start <= 0:
        return at_least(0.0, given.min_share, "1", f"{', '.join(given.names)} have no energy to lose")
    lost = float(1 - energy[-1] / start)
    lasting = _filled(energy, round(BLOW_S / max(trajectory.interval_s, 1e-9)))
    gain = float((lasting - np.minimum.accumulate(lasting)).max() / start)
    message = f"{', '.join(given.names)} lose {lost:.1%} of {start:.4g} J"
    return all_of(
        at_least(lost, given.min_share, "1", message),
        at_most(gain, given.tolerance, "1", f"{message}, but gain {gain:.1%} on the way"),
    )


GOOD = (
    (lambda: sliding(1.0, 1.0), {"body": "body", "min_share": 0.99}),
    (lambda: bouncing(1.0, 0.8, seconds=1.0), {"body": "ball", "min_share": 0.35, "tolerance": 0.05}),  # 1 - e^2
)
BAD = (
    (falling, {"body": "body", "min_share": 0.01}),
    (lambda: sliding(1.0, 0.1), {"body": "body", "min_share": 0.9}),
)

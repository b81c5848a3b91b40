"""A body whose mass cannot belong to its size, or whose size cannot belong to a scene.

What it means: millimetres taken for metres, grams for kilograms, or a mesh without a scale: contacts, drag and the look of
every fall are then of another world.

Formula: mass over the volume of the bounding box of the body's geoms (an upper bound of its own volume).
Threshold: under 0.05 kg/m^3 (a hundredth of a foam's, a twentieth of air's) or over 60,000 kg/m^3 (three times gold's)
blocks. A loose body larger than 200 m or smaller than 10 micrometres, whose mass does fit its size, is a warning.
Source: densities of common materials, CRC Handbook of Chemistry and Physics.
"""

from collections.abc import Iterator

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign

CODE = "WS130"
REPAIR = "scale"
NEEDS = ("mechanics.mass", "mechanics.half_extents", "mechanics.free")
WHOLE = True
LIGHT, HEAVY = 0.05, 60_000.0
SMALL_M, LARGE_M = 1e-5, 200.0


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the loose bodies out of scale."""
    facts = trajectory.mechanics
    if facts.mass is None or facts.half_extents is None or facts.free is None:
        return
    whole = (trajectory.t[0], trajectory.t[-1])
    for b in np.flatnonzero(facts.free & ~np.isnan(facts.half_extents).any(axis=1)):
        name, extents = trajectory.names[b], 2 * facts.half_extents[b]
        density = float(facts.mass[b] / max(np.prod(extents), 1e-300))
        largest = float(extents.max())
        if density < LIGHT or density > HEAVY:
            limit = LIGHT if density < LIGHT else HEAVY
            size = " x ".join(f"{e:.3g}" for e in extents)
            message = f"{name} has {facts.mass[b]:.3g} kg in a box of {size} m: {density:.3g} kg/m^3"
            yield Sign(name, whole, density, limit, "kg/m^3", "blocking", message)
        elif largest > LARGE_M or largest < SMALL_M:
            limit = LARGE_M if largest > LARGE_M else SMALL_M
            message = f"{name} is {largest:.3g} m large"
            yield Sign(name, whole, largest, limit, "m", "warn", message)


GOOD = (
    lambda: Case("a wooden ball", analytic.falling(size_m=0.1, mass=0.5)),
    lambda: Case("a feather", analytic.falling(size_m=0.1, mass=0.001)),
)
BAD = (
    lambda: Case("a cup of 800 m", analytic.falling(size_m=800.0, mass=0.3), severity="blocking"),
    lambda: Case(
        "an asteroid, or an asteroid's model in the wrong unit",
        analytic.falling(size_m=240.0, mass=3e9),
        severity="warn",
    ),
    lambda: Case("a marble of a tonne", analytic.falling(size_m=0.02, mass=1000.0), severity="blocking"),
)

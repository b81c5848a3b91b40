"""One body has more energy than another.

Measures the ratio of their energies, that of `body` over that of `other`: the greatest, the mean or the last kinetic
energy of the window (of translation and rotation, m v^2 / 2 + w I w / 2), what each gains of it from its least to its
greatest, or what gravity does on each from its highest point to its lowest, m g (drop). Of two stones that roll down
together the one of ten times the mass ends with ten times the energy. Source: rigid-body mechanics.
"""

from typing import Literal

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import sliding
from ....known.motions import downhill, two
from ....measuring.energetics import kinetic, potential
from ....measuring.measured import Measured, Name, OfBody, at_least, body_index, window

CODE = "WE291"
LEAST_J = 1e-9
"""Less energy than this is none: what has none is not ten times as much as what has none."""


class Given(OfBody):
    """Than whom, by how much."""

    other: Name = Field(description="the body with less")
    of: Literal["max_kinetic", "mean_kinetic", "final_kinetic", "kinetic_gain", "work_of_gravity"] = Field(
        "max_kinetic", description="what is compared"
    )
    min_ratio: float = Field(default=1.0, ge=1, description="least ratio, more over less")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The ratio of the energies."""
    rows = window(trajectory, given.window_s)
    one, other = (
        _energy(trajectory, given.of, body_index(trajectory, name), rows) for name in (given.body, given.other)
    )
    message = f"{given.of.replace('_', ' ')} of {given.body} is {one:.4g} J, of {given.other} {other:.4g} J"
    # Equal is not more: the margin of a bare comparison must not be zero then.
    ratio = one / max(other, LEAST_J) if one > LEAST_J else 0.0
    return at_least(ratio - 1e-9, given.min_ratio, "1", message)


def _energy(trajectory: Trajectory, of: str, body: int, rows: slice) -> float:
    if of == "work_of_gravity":
        height = potential(trajectory, rows, [body])[:, 0]
        return float((np.maximum.accumulate(height) - height).max())
    moving = kinetic(trajectory, rows, [body])[:, 0]
    if of == "kinetic_gain":
        return float((moving - np.minimum.accumulate(moving)).max())
    return float({"max_kinetic": moving.max(), "mean_kinetic": moving.mean(), "final_kinetic": moving[-1]}[of])


def heavy_and_light() -> Trajectory:
    """Two blocks slide down one slope, `a` of 10 kg and `b` of 1 kg: ten times the energy, at one speed."""
    return two(downhill(30.0, mass=10.0), downhill(30.0))


def slow_and_fast() -> Trajectory:
    """`a` of 2 kg at 1 m/s, `b` of 1 kg at 2 m/s: 1 J and 2 J, though `a` is heavier."""
    return two(sliding(1.0, mass=2.0), sliding(2.0))


GOOD = (
    (heavy_and_light, {"body": "a", "other": "b", "min_ratio": 9.9}),
    (heavy_and_light, {"body": "a", "other": "b", "of": "work_of_gravity", "min_ratio": 9.9}),
    (heavy_and_light, {"body": "a", "other": "b", "of": "kinetic_gain", "min_ratio": 9.9}),
    (slow_and_fast, {"body": "b", "other": "a", "of": "final_kinetic", "min_ratio": 1.9}),
)
BAD = (
    (heavy_and_light, {"body": "b", "other": "a"}),
    (heavy_and_light, {"body": "a", "other": "b", "min_ratio": 10.5}),
    (slow_and_fast, {"body": "a", "other": "b", "of": "mean_kinetic"}),
    (slow_and_fast, {"body": "b", "other": "a", "of": "kinetic_gain"}),
    (lambda: two(sliding(1.0), sliding(1.0)), {"body": "a", "other": "b"}),
)

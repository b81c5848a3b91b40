"""Two bodies exchange energy: what one loses, the other gains.

Measures the largest share of the giver's energy (at the start of the window) that the taker holds at some moment; the
sum of both must not exceed what was there by more than `tolerance`. Source: coupled oscillators; elastic collisions
(equal masses exchange everything).
"""

from typing import Literal

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import collision, resting
from ....known.oscillation import beating
from ....measuring.energetics import kinetic, mechanical
from ....measuring.measured import Measured, Name, OfBody, Tolerance, all_of, at_least, at_most, body_index, window

CODE = "WE201"
EVENT = True


class Given(OfBody):
    """The giver, the taker, and the share to hand over."""

    other: Name = Field(description="the body that takes; `body` gives")
    min_share: float = Field(gt=0, le=1, description="least share of the giver's energy that the taker gains")
    quantity: Literal["kinetic", "mechanical"] = Field("kinetic", description="kinetic energy, or with that of weight")
    tolerance: Tolerance = Field(0.05, description="largest excess of the sum over what was there, relative")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the share gained."""
    rows = window(trajectory, given.window_s, 2)
    of = [
        kinetic(trajectory, rows, [b])[:, 0] if given.quantity == "kinetic" else mechanical(trajectory, rows, [b])
        for b in (body_index(trajectory, given.body), body_index(trajectory, given.other))
    ]
    # An oscillator that is let go at rest has its kinetic energy a quarter of a swing later.
    start = float(of[0].max())
    if start <= 0:
        return at_least(0.0, given.min_share, "1", f"{given.body} has no energy to give")
    gained = float((of[1] - of[1][0]).max() / start)
    excess = float((of[0] + of[1] - of[1][0]).max() / start - 1)
    message = f"{given.other} gains {gained:.1%} of the {start:.4g} J of {given.body}"
    return all_of(
        at_least(gained, given.min_share, "1", message),
        at_most(excess, given.tolerance, "1", f"{message}, but together they have {excess:.1%} more than was there"),
    )


GOOD = (
    (lambda: collision(speeds=(1.0, 0.0)), {"body": "a", "other": "b", "min_share": 0.999}),
    (beating, {"body": "a", "other": "b", "min_share": 0.95}),
)
BAD = (
    (lambda: collision(speeds=(1.0, 0.0), restitution=0.5), {"body": "a", "other": "b", "min_share": 0.6}),  # 0.5625
    (lambda: collision(speeds=(0.0, 1.0)), {"body": "a", "other": "b", "min_share": 0.5}),
    (lambda: beating(seconds=1.0), {"body": "a", "other": "b", "min_share": 0.9}),
    (lambda: resting(names=("body",)), {"body": "body", "other": "body", "min_share": 0.9}),
)

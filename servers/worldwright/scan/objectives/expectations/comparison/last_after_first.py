"""The same happens to each of several bodies, to the last so much later than to the first: a row of dominoes, a wave.

Measures the time from the earliest of the events to the latest, seconds; with `in_order` also that each comes no sooner
than that of the body named before it. Source: kinematics, order of events.
"""

from typing import Any

from pydantic import Field, field_validator, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.analytic import falling, resting
from ....known.flow import stream
from ....known.motions import two
from ....measuring.channels import group
from ....measuring.measured import Arguments, Measured, Name, all_of, at_least, between
from ...events import MADE_OF_EVENTS, known, moment_s, told

CODE = "WE290"
EVENT = True


class Given(Arguments):
    """Of which, what, when."""

    parts: str | tuple[Name, ...] = Field(
        description="a pattern such as `domino_*`, or a list of bodies in their order"
    )
    each: dict[str, Any] = Field(description="what happens to each: an expectation without its `body`")
    min_s: float = Field(default=1e-6, gt=0, description="least time from the first to the last, s")
    max_s: float | None = Field(None, gt=0, description="largest time from the first to the last, s")
    in_order: bool = Field(False, description="each no sooner than the one named before it")

    @field_validator("each")
    @classmethod
    def _of_a_body(cls, value: dict[str, Any]) -> dict[str, Any]:
        if len(value) == 1 and isinstance(arguments := next(iter(value.values())), dict):
            if "body" in arguments:
                raise ValueError("leave `body` out of `each`: it is each of `parts` in turn")
            if MADE_OF_EVENTS & arguments.keys():
                raise ValueError("`each` is one event of one body, not several")
        known(_said_of(value, "body"))
        return value

    @model_validator(mode="after")
    def _several(self) -> "Given":
        if not self.parts or (not isinstance(self.parts, str) and len(self.parts) < 2):
            raise ValueError("`parts` are a pattern, or at least two bodies")
        return self


def _said_of(event: dict[str, Any], body: str) -> dict[str, Any]:
    """The event, of one body."""
    return {
        name: {**arguments, "body": body} if isinstance(arguments, dict) else arguments
        for name, arguments in event.items()
    }


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The time between the first and the last."""
    names = [trajectory.names[b] for b in group(trajectory, given.parts)]
    if not isinstance(given.parts, str):
        names = list(given.parts)
    moments = []
    for name in names:
        event = _said_of(given.each, name)
        moment = moment_s(trajectory, event)
        if moment is None:
            never = -float(trajectory.duration_s) - given.min_s
            return at_least(never, given.min_s, "s", f"{told(event)} does not happen")
        moments.append(moment)
    early, late = min(moments), max(moments)
    first, last = names[moments.index(early)], names[moments.index(late)]
    message = f"{next(iter(given.each))}: first {first} at {early:.3f} s, last {last} at {late:.3f} s"
    apart = between(late - early, given.min_s, given.max_s, "s", message)
    if not given.in_order:
        return apart
    steps = [(b - a, one, other) for a, b, one, other in zip(moments, moments[1:], names, names[1:], strict=False)]
    step, one, other = min(steps, default=(0.0, "", ""))
    return all_of(at_least(step, 0.0, "s", f"from {one} to {other} it takes {step:.3f} s"), apart)


BELOW = {"falls": {"min_m": 0.5}}
ROW = {"parts": "drop_*", "each": {"crosses": {"axis": "z", "at_m": 0.0, "sense": "down"}}}
GOOD = (
    (lambda: stream(per_s=2.0), {**ROW, "min_s": 1.4, "max_s": 1.6}),
    (lambda: stream(per_s=2.0), {**ROW, "in_order": True}),
)
BAD = (
    (lambda: stream(per_s=2.0), {**ROW, "min_s": 1.6}),
    (lambda: stream(per_s=2.0), {**ROW, "max_s": 1.4}),
    (lambda: stream(per_s=2.0), {**ROW, "parts": ["drop_1", "drop_0"], "in_order": True}),
    (lambda: two(falling(seconds=0.5), resting(0.5)), {"parts": ["a", "b"], "each": BELOW}),
)

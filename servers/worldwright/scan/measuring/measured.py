"""The result of an expectation: the vocabulary between the engine and the shelf of expectations."""

from typing import Annotated, Any, NamedTuple

import numpy as np
from pydantic import AfterValidator, ConfigDict, Field, model_validator

from ...model.errors import WorldwrightError
from ...model.frozen import Frozen
from ...model.recording.trajectory import WORLD_NAMES, Trajectory
from ..anomalies.sign import spans

HOP_S = 0.02
"""A stiff contact under a sliding or standing body lets go for moments this short; it flies half a millimetre at most."""


class Measured(NamedTuple):
    """One measurement and what was expected; a positive margin says by how much it holds, in the same unit."""

    measured: float
    expected: str
    margin: float
    unit: str
    message: str


def at_least(value: float, least: float, unit: str, message: str) -> Measured:
    """Holds when `value` reaches `least`."""
    return Measured(float(value), f"at least {_number_text(least, unit)}", float(value - least), unit, message)


def at_most(value: float, most: float, unit: str, message: str) -> Measured:
    """Holds when `value` stays within `most`."""
    return Measured(float(value), f"at most {_number_text(most, unit)}", float(most - value), unit, message)


def close_to(value: float, expected: float, tolerance: float, unit: str, message: str) -> Measured:
    """Holds when `value` is within `tolerance` (relative) of what was expected, e.g. of a textbook's formula."""
    margin = tolerance * abs(expected) - abs(value - expected)
    return Measured(
        float(value), f"{_number_text(expected, unit)} within {tolerance:.3g} of it", float(margin), unit, message
    )


def between(value: float, least: float | None, most: float | None, unit: str, message: str) -> Measured:
    """Holds within a range; either end may be open."""
    if most is None or (least is not None and value - least <= most - value):
        return at_least(value, -1e300 if least is None else least, unit, message)
    return at_most(value, most, unit, message)


def all_of(first: Measured, *others: Measured) -> Measured:
    """The first of several conditions that fails; the first when all hold."""
    return next((one for one in (first, *others) if not one.margin >= 0), first)


def _number_text(value: float, unit: str) -> str:
    return f"{value:g}" if unit == "1" else f"{value:g} {unit}"


class UnknowableError(WorldwrightError):
    """The recording cannot answer this expectation; the cause says why."""

    code = "unknowable"


def _ordered(window: tuple[float, float]) -> tuple[float, float]:
    if window[1] <= window[0]:
        raise ValueError("the window ends before it starts: write [start, end] in seconds")
    return window


Window = Annotated[tuple[Annotated[float, Field(ge=0)], float], AfterValidator(_ordered)]
Point = tuple[float, float, float]
Name = Annotated[str, Field(min_length=1)]
Tolerance = Annotated[float, Field(gt=0)]


class Arguments(Frozen):
    """Arguments of an expectation; an unknown one is an error that lists the known, and so is nan or infinity."""

    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=True, allow_inf_nan=False)


class Windowed(Arguments):
    """An expectation about a stretch of time."""

    window_s: Window | None = Field(None, description="[start, end], s; without it the whole recording")


class OfBody(Windowed):
    """One body over a window."""

    body: Name = Field(description="the body")


class OfPair(Windowed):
    """Two bodies."""

    bodies: tuple[Name, Name] = Field(description="the two bodies; `ground` is the world")

    @model_validator(mode="after")
    def _two(self) -> "OfPair":
        if self.bodies[0] == self.bodies[1]:
            raise ValueError("name two different bodies")
        return self


class OfBodies(Windowed):
    """One body, or several."""

    body: Name | None = Field(None, description="one body")
    bodies: tuple[Name, ...] = Field((), description="several bodies")

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all bodies, each once."""
        return tuple(dict.fromkeys((*((self.body,) if self.body else ()), *self.bodies)))

    def indices(self, trajectory: Trajectory) -> list[int]:
        """The indices of the bodies; raises when there is none."""
        if not self.names:
            raise UnknowableError("no body is named", next_move="add `body: NAME` or `bodies: [NAME, …]`")
        return [body_index(trajectory, name) for name in self.names]


def one_of(arguments: Arguments, *names: str) -> None:
    """Raise a ValueError unless exactly one of these arguments is given; for validators."""
    given = [name for name in names if getattr(arguments, name) not in (None, (), "")]
    if len(given) != 1:
        raise ValueError(f"give exactly one of {', '.join(names)}; {', '.join(given) or 'none'} was given")


def body_index(trajectory: Trajectory, name: str) -> int:
    """A body's index; raises for the world's own names, as a moving body is meant."""
    index = trajectory.index(name)
    if index < 0:
        raise UnknowableError(f"'{name}' is the world itself, which does not move")
    return index


def window(trajectory: Trajectory, window_s: tuple[float, float] | None, least: int = 1) -> slice:
    """The rows of a window, or all rows; raises when these are fewer than `least`."""
    if window_s is None:
        rows = trajectory.rows()
    elif window_s[0] > trajectory.t[-1] + 1e-9 or window_s[1] < trajectory.t[0] - 1e-9:
        span = f"from {trajectory.t[0]:.3f} to {trajectory.t[-1]:.3f} s"
        raise UnknowableError(f"the recording goes {span}, the window from {window_s[0]:g} to {window_s[1]:g} s")
    else:
        rows = trajectory.rows(*window_s)
    if rows.stop - rows.start < least:
        raise UnknowableError(f"only {rows.stop - rows.start} rows were recorded there, {least} are needed")
    return rows


def last_rows(trajectory: Trajectory, rows: slice, seconds: float) -> slice:
    """The last `seconds` of some rows."""
    start = int(trajectory.t.searchsorted(trajectory.t[rows.stop - 1] - seconds - 1e-9))
    return slice(max(rows.start, start), rows.stop)


def contacts_of(trajectory: Trajectory, one: str, other: str) -> Any:
    """(N,) bool: the contacts between two bodies; a geom's name means that geom alone, the world's names all of the world.

    What touches a flex touches no body: neither the ground nor the world.

    Raises:
        UnknowableError: no contacts were recorded.
    """
    contacts = trajectory.contacts
    if contacts is None:
        raise UnknowableError("no contacts were recorded")

    def mine(name: str, body: Any, geom: Any) -> Any:
        found = body == trajectory.index(name)
        geoms = trajectory.mechanics.geom_names
        alone = name in geoms and name not in trajectory.names and name not in WORLD_NAMES
        if geom is None or not (alone or trajectory.index(name) < 0):
            return found
        return found & (geom == geoms.index(name) if alone else geom >= 0)

    first, second = (contacts.body1, contacts.geom1), (contacts.body2, contacts.geom2)
    return (mine(one, *first) & mine(other, *second)) | (mine(one, *second) & mine(other, *first))


def pair_rows(trajectory: Trajectory, one: str, other: str) -> Any:
    """(T,) bool: whether the two touch; needs recorded contacts."""
    mask = contacts_of(trajectory, one, other)
    assert trajectory.contacts is not None
    found = np.zeros(len(trajectory.t), dtype=bool)
    found[trajectory.contacts.row[mask & trajectory.contacts.live]] = True
    return found


def bridged(trajectory: Trajectory, touching: Any) -> Any:
    """(R,) bool: contact, where the hops of a chattering contact (up to `HOP_S`) count as contact."""
    found = np.array(touching, dtype=bool)
    for start, stop in spans(found, bridge=max(1, round(HOP_S / max(trajectory.interval_s, 1e-9)))):
        found[start:stop] = True
    return found


def masses(trajectory: Trajectory) -> Any:
    """(B,) kg: the masses; raises when the recording does not hold them."""
    if trajectory.mechanics.mass is None:
        raise UnknowableError("the recording does not tell masses")
    return trajectory.mechanics.mass

"""What an expectation says: the vocabulary between the engine and the shelf of expectations."""

from typing import Any, NamedTuple

from pydantic import Field

from ..model.errors import WorldwrightError
from ..model.frozen import Frozen
from ..model.trajectory import Trajectory


class Measured(NamedTuple):
    """One measurement against what was expected; a positive margin means it holds, by that much."""

    measured: float
    expected: str
    margin: float
    unit: str
    message: str


class UnknowableError(WorldwrightError):
    """The recording cannot answer this expectation; the cause says why."""

    code = "unknowable"


class Arguments(Frozen):
    """Arguments of an expectation; an unknown one is an error that lists the known."""


class OfBody(Arguments):
    """One body over a window."""

    body: str
    window_s: tuple[float, float] | None = None


class OfPair(Arguments):
    """Two bodies."""

    bodies: tuple[str, str]


class OfBodies(Arguments):
    """One body, or several."""

    body: str | None = None
    bodies: tuple[str, ...] = Field(default=())

    @property
    def names(self) -> tuple[str, ...]:
        """All of them, once."""
        return tuple(dict.fromkeys((*((self.body,) if self.body else ()), *self.bodies)))


def body_index(trajectory: Trajectory, name: str) -> int:
    """A body's index; the world's own names are refused where a moving body is meant."""
    index = trajectory.index(name)
    if index < 0:
        raise UnknowableError(f"'{name}' is the world itself, which does not move")
    return index


def window(trajectory: Trajectory, window_s: tuple[float, float] | None) -> slice:
    """The rows of a window, or all."""
    return trajectory.rows(*window_s) if window_s else trajectory.rows()


def pair_rows(trajectory: Trajectory, one: str, other: str) -> Any:
    """(T,) bool: the two touch; needs recorded contacts."""
    touching = trajectory.touching_pair(trajectory.index(one), trajectory.index(other))
    if touching is None:
        raise UnknowableError("no contacts were recorded")
    return touching

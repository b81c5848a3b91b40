"""What solvers beside the engine recorded of themselves: temperatures, a water's level, the energy of a field."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..errors import NotFoundError, RecordingError

Array = np.ndarray


@dataclass(frozen=True)
class SolverChannels:
    """Channels of one recording, T rows, by `SOLVER.CHANNEL`."""

    values: Mapping[str, Array] = field(default_factory=dict)
    """(T, …) each."""
    units: Mapping[str, str] = field(default_factory=dict)
    bodies: Mapping[str, Sequence[str]] = field(default_factory=dict)
    """By the solver's name: its bodies, in the order of the channels that have one number for each."""

    @classmethod
    def of(cls, recording: Any) -> "SolverChannels":
        """Those of an open recording; none where no solver ran.

        Raises:
            RecordingError: what it says of its solvers makes no sense.
        """
        from worldengine.solvers import Row, called

        try:
            rows = [Row.read(row) for row in recording.meta.get("solvers") or ()]
            told = {row["name"]: row["unit"] for row in recording.meta["columns"]["state"]} if rows else {}
        except (KeyError, TypeError, ValueError, AttributeError) as cause:
            what = f"what it says of its solvers makes no sense: {cause!r}"
            raise RecordingError(what, place=str(recording.folder), next_move="run the physics pass again") from cause
        values: dict[str, Array] = {}
        bodies: dict[str, Sequence[str]] = {}
        for name, row in zip(called(rows), rows, strict=True):
            bodies[name] = row.bodies
            values |= {f"{name}.{own}": channel for own, channel in recording.channels(name).items()}
        return cls(values, {name: str(told.get(name, "")) for name in values}, bodies)

    def before(self, row: int) -> "SolverChannels":
        """The channels up to `row`, exclusive."""
        return replace(self, values={name: channel[:row] for name, channel in self.values.items()})

    def one(self, name: str, body: str | None) -> tuple[Array, str]:
        """(T,) a channel and its unit; of one of the solver's bodies where it has a number for each.

        Raises:
            NotFoundError: there is no such channel, or not of this body.
        """
        if name not in self.values:
            known = ", ".join(self.values) or "(none: no solver ran)"
            raise NotFoundError(f"no channel '{name}' was recorded", next_move=f"name one of: {known}")
        channel, unit, owners = self.values[name], self.units.get(name, ""), self.bodies[name.rpartition(".")[0]]
        if channel.ndim == 1 and body is None:
            return channel, unit
        if channel.ndim == 1:
            raise NotFoundError(f"'{name}' is one number, not one of each body", next_move="leave `body` out")
        if body is None or body not in owners or channel.ndim != 2 or channel.shape[1] != len(owners):
            what = f"'{name}' has a number for each of its bodies, and {body or 'none'} was named"
            raise NotFoundError(what, next_move=f"name as `body` one of: {', '.join(owners)}")
        column: int = list(owners).index(body)
        return np.asarray(channel[:, column]), unit

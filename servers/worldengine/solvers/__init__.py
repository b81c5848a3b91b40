"""Solvers beside the engine, one file each, simulate what flows, burns or blows, and its forces on bodies.

A solver steps with the engine, exchanges forces with it, has its own channels in the recording, is simulated again by a
replay, and may move what is only drawn. It runs in the engine's process, never in an author's, so the world's file and its
inputs give the same world again.

The folder is the list: a module that defines what `Solver` names is a solver. A plan asks for one by a
row of `simulation_parameters.interventions` of the kind `solver`, which names its bodies and the constants that it reads.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

from worldkit.errors import ProgramError
from worldkit.seams import Seam

from ..recording.columns import Column

if TYPE_CHECKING:
    import mujoco
    import numpy as np


Number = float | tuple[float, ...]
"""A constant: one number, or one for each of its bodies, in their order."""


@dataclass(frozen=True)
class Row:
    """A plan's row about one solver."""

    solver: str
    """The name of the solver's file."""
    bodies: tuple[str, ...]
    constants: "Mapping[str, Number]" = field(default_factory=dict)
    """The constants, by the solver's own names."""
    shown_by: str = ""
    """A drawn-only geom that the solver may move; empty for none."""

    @classmethod
    def read(cls, row: Mapping[str, Any]) -> "Row":
        """Read a row of `inputs.json`; raises KeyError, TypeError or ValueError when it makes no sense."""
        said = row["solver"]
        constants = {str(name): _number(value) for name, value in said["constants"].items()}
        return cls(str(said["name"]), tuple(map(str, row["bodies"])), constants, str(said.get("shown_by") or ""))

    def written(self) -> dict[str, Any]:
        """The row as `inputs.json` and a recording's `meta.json` have it."""
        told = {name: list(value) if isinstance(value, tuple) else value for name, value in self.constants.items()}
        said = {"name": self.solver, "constants": told, "shown_by": self.shown_by}
        return {"kind": "solver", "bodies": list(self.bodies), "solver": said}


@dataclass(frozen=True)
class Case:
    """A test of a solver: a small world whose outcome is known without it."""

    world: str
    """MJCF; without a floor, so that nothing but the solver and gravity acts."""
    bodies: tuple[str, ...]
    constants: Mapping[str, Number]
    seconds: float
    channel: str
    """The channel whose first number is checked at the end."""
    expected: float
    tolerance: float
    because: str
    """The source of the formula."""
    shown_by: str = ""
    """What shows it in that world, where the solver reads its shape from that."""


class Running(Protocol):
    """A solver at work on one world."""

    channels: Mapping[Column, "np.ndarray"]
    """Its recorded columns, each with an array of the column's shape that `look` updates in place."""

    def look(self, data: "mujoco.MjData") -> "np.ndarray":
        """Bring the channels up to date with the engine's state, and return the forces on the bodies for the next step.

        Everything that derives from positions and velocities is computed. The solver's own state stays, so a second look
        changes nothing.

        Returns:
            (n, 6) force (N) and torque (N m) on each of its bodies at the centre of mass, world frame, held during the step.
        """

    def advance(self, step_s: float) -> None:
        """Advance its own state by `step_s` seconds, with the bodies as they were at the last look."""


@runtime_checkable
class Shown(Protocol):
    """What a running solver has, too, that moves the corners of a flex."""

    every: int
    """Steps from one record of them to the next."""

    def points(self) -> "np.ndarray | None":
        """(n, 3) m: where they are now; None where a geom shows it."""


class Solver(Protocol):
    """The protocol of the modules of this folder."""

    CONSTANTS: Mapping[str, tuple[str, str]]
    """The constants that its row in a plan must give: name, with unit and meaning. Those that it may give are in `OPTIONAL`, where
    a module has that, those that may have a number for each body in `EACH`. `PUSHES = False`: it pushes nothing; `STANDING = True`:
    its bodies may stand fast. `WEIGHTY = True`: it refuses a world without gravity."""
    CASES: tuple[Case, ...]
    """Worlds with a known outcome, which every integrator and half the time step must give."""

    def start(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        bodies: Sequence[int],
        constants: Mapping[str, Any],
        shown_by: str = "",
    ) -> Running:
        """Start the solver at the initial state; `shown_by` names what shows it.

        Raises:
            ProgramError: it cannot act on these bodies, or a constant makes no sense.
        """

    def show(self, model: "mujoco.MjModel", data: "mujoco.MjData", geom: int, channels: Mapping[str, Any]) -> None:
        """Pose the geom that shows it by the recorded channels of a row, in data that is about to be drawn."""


SEAM: Seam[Solver] = Seam(__name__, Solver, "solver")


def called(rows: Sequence[Row]) -> list[str]:
    """The prefix of each row's channels: the solver's name, numbered from the second of its kind on."""
    found: list[str] = []
    for row in rows:
        count = sum(name.partition("#")[0] == row.solver for name in found)
        found.append(row.solver if not count else f"{row.solver}#{count + 1}")
    return found


def reads(solver: Solver) -> dict[str, tuple[str, str]]:
    """All constants that it can be told: name, with unit and meaning."""
    return {**solver.CONSTANTS, **getattr(solver, "OPTIONAL", {})}


def odd_list(solver: Solver, name: str, value: tuple[float, ...], bodies: int) -> str:
    """What is wrong with giving this constant as a list for so many bodies; empty where nothing is."""
    if name not in getattr(solver, "EACH", ()):
        return f"reads one number as its {name}, and is given {len(value)}"
    return f"has {bodies} bodies, and {len(value)} numbers as its {name}" if len(value) != bodies else ""


def each(value: Number, bodies: int) -> "np.ndarray":
    """(n,) a constant for each of so many bodies; one number is that of all."""
    import numpy as np

    return np.broadcast_to(np.asarray(value, float), bodies).copy()


def _list(value: Number) -> tuple[float, ...]:
    return value if isinstance(value, tuple) else (value,)


def _number(value: Any) -> Number:
    return tuple(map(float, value)) if isinstance(value, list | tuple) else float(value)


def check(row: Row) -> Solver:
    """The solver that a row asks for; raises `ProgramError` when there is none, or its constants do not fit."""
    if row.solver not in SEAM.names():
        known = ", ".join(SEAM.names()) or "(none)"
        raise ProgramError(f"there is no solver {row.solver!r}", "interventions", f"name one of: {known}")
    solver = SEAM.find(row.solver)
    for what, names in (
        ("lacks", set(solver.CONSTANTS) - set(row.constants)),
        ("does not know", set(row.constants) - set(reads(solver))),
    ):
        if names:
            needed = ", ".join(f"{name} ({unit})" for name, (unit, _) in reads(solver).items())
            raise ProgramError(
                f"the solver {row.solver} {what} {', '.join(sorted(names))}", "interventions", f"it reads: {needed}"
            )
    for name, value in row.constants.items():
        if isinstance(value, tuple) and (cause := odd_list(solver, name, value, len(row.bodies))):
            raise ProgramError(f"the solver {row.solver} {cause}", "interventions", "correct that constant")
    if wild := [name for name, value in row.constants.items() if not all(map(math.isfinite, _list(value)))]:
        cause = f"the constant {wild[0]} of the solver {row.solver} is {row.constants[wild[0]]}"
        raise ProgramError(cause, "interventions", "let it be a finite number")
    return solver

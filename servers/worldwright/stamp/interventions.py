"""What acted on the state besides the engine's own step, compared with what the plan declares.

Declared: a row of `simulation_parameters.interventions` has the same kind and names the target (or the body inside the
target). Everything else is undeclared and blocks acceptance, whatever it did.
"""

from pathlib import Path

from ..model.errors import RecordingError
from ..model.frozen import Frozen
from ..model.plan.committed import Intervention
from ..model.plan.declaration import covering, declaration


class Acted(Frozen):
    """One kind of intervention on one target, over the whole recording."""

    kind: str
    target: str
    count: int
    """Recorded steps in which it acted."""
    first_s: float
    last_s: float
    work_j: float
    """Net work, joules (0 when the ledger cannot attribute any)."""
    declared: bool
    law: str = ""
    """The law that the plan states for it; empty when it is not declared."""

    def __str__(self) -> str:
        return f"{self.kind} on {self.target}, {self.count} steps, {self.first_s:.3f}-{self.last_s:.3f} s"


def acted(recording: Path, declared: tuple[Intervention, ...]) -> tuple[Acted, ...]:
    """The ledger of a recording folder, grouped by kind and target, each compared with the plan.

    A recording that cannot be read, or that carries no ledger, is a `RecordingError`.
    """
    from ..model.recording.trajectory_files import read_trajectory

    trajectory = read_trajectory(recording)
    ledger, declared = trajectory.interventions, covering(declared, trajectory.flex_points)
    if ledger is None:
        raise RecordingError(
            "the recording has no ledger of interventions",
            place=str(recording),
            next_move="run the physics pass again with this version of worldkit",
        )
    found = []
    for (kind, target), rows in sorted(ledger.groups.items()):
        row, times = declaration(kind, target, declared), ledger.time[rows]
        found.append(
            Acted(
                kind=kind,
                target=target,
                count=len(rows),
                first_s=float(times.min()),
                last_s=float(times.max()),
                work_j=float(ledger.work_j[rows].sum()),
                declared=row is not None,
                law=row.law if row else "",
            )
        )
    return tuple(found)

"""A cause that only sets another drive off: without it, a motor elsewhere that acts before the effect never acts at all.

Then the repetition without the cause shows that nothing set the motor off, and nothing of what the motor alone would do: a press
that waits until a cutter is lifted never tries glass that was not cut. Where the plan itself says that the motor waits for a state
(`trigger: height of cutter > 0.1 m`) or its law names the cause, that is what it claims, and it is told; where it does not, the
cause was not tested.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from ...model.evidence.audits import Acting
from ...model.recording.trajectory import Trajectory


@dataclass(frozen=True)
class Relayed:
    """A drive that acts before the effect, and never in the repetition without the cause."""

    row: Acting
    in_plan: bool
    """Whether the plan says that it waits for a state, or for the cause."""

    @property
    def text(self) -> str:
        """The drive, and who says that it waits for the cause."""
        name = self.row.target.rpartition("/")[2]
        if self.in_plan:
            return f"{name} (in the plan: {self.row.trigger if self.row.when == 'state' else self.row.law})"
        return f"{name}, which acts from {self.row.first_s:.3f} s as planned"


def relayed(
    planned: Trajectory, without: Trajectory, acting: tuple[Acting, ...], own: set[str], until_s: float
) -> Iterator[Relayed]:
    """The drives that are silent without the cause, though none of its own.

    Args:
        planned: the recording as planned.
        without: the repetition without the cause.
        acting: what acted as planned.
        own: names of the cause: bodies, joints, actuators.
        until_s: the moment of the effect; what acts only later did not bring it about.
    """
    bodies = own | _carried(planned, own) | _jointed(planned, own)
    heard = set() if without.interventions is None else set(without.interventions.groups)
    for row in acting:
        parts = set(row.target.partition("[")[0].split("/"))
        if row.kind != "control" or row.first_s >= until_s or row.body in bodies or parts & own:
            continue
        if (row.kind, row.target) not in heard:
            named = set(re.findall(r"\w+", row.law))
            yield Relayed(row, in_plan=row.declared and (row.when == "state" or bool(named & bodies)))


def _carried(trajectory: Trajectory, own: set[str]) -> set[str]:
    """The bodies that hang below those of the cause."""
    names, parent = trajectory.names, trajectory.mechanics.parent
    found = {name for name in names if name in own}
    for number, name in enumerate(names if parent is not None else ()):
        above = int(parent[number])
        if above >= 0 and names[above] in found:
            found.add(name)
    return found


def _jointed(trajectory: Trajectory, own: set[str]) -> set[str]:
    """The bodies whose joints or actuators the cause names."""
    joints = {str(row["body"]) for row in trajectory.meta.get("joints") or () if row["name"] in own}
    motors = (row["bodies"] for row in trajectory.meta.get("actuators") or () if row["name"] in own)
    return joints.union(*motors)

"""An accepted world without its program: the file that is the world, its facts, its plan, and the inputs that drove it."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..model.errors import GateError
from ..model.evidence.run import Run, sha256_file

if TYPE_CHECKING:
    import mujoco

    from worldengine.given import Given
    from worldengine.inputs.strict_stream import Recorded

    from ..model.plan.committed import Plan

WORLD, FACTS, MOTION = "world.mjz", "world", "trajectory.npz"
NEEDED = ("plan.md", WORLD, f"{FACTS}/program.json", f"{FACTS}/inputs.json")
"""What there must be of every world."""
DRIVEN = tuple(f"{FACTS}/{name}.arrows" for name in ("inputs", "edits", "media", "balances"))
"""What drove it, where anything did (`worldengine.recording.stored.Replayable` reads it)."""


@dataclass(frozen=True)
class AcceptedWorld:
    """The folder of an accepted world; `read` checks what it takes from there against the stamp."""

    folder: Path
    given: "Given"
    plan: "Plan"
    stamped: Mapping[str, str] = field(default_factory=dict)
    """SHA-256 of the files that the stamp lists, by name."""

    @classmethod
    def read(cls, name: Path | str) -> "AcceptedWorld":
        """The accepted world of a run: its folder, its plan.md, or its name under ./runs or ./examples.

        Raises:
            NotFoundError: there is no such run.
            GateError: nothing is accepted, the world's file is not kept here, or is not what was stamped.
            ProgramError: its facts make no sense.
        """
        from worldengine.given import Given

        from ..model.plan.plan_text import read_plan

        run = Run.find(name)
        folder = run.stamped
        try:
            listed = json.loads((folder / "stamp.json").read_bytes())["subject"]
            stamped = {row["name"]: row["digest"]["sha256"] for row in listed}
        except (OSError, ValueError, KeyError, TypeError) as cause:
            raise GateError(
                "nothing is accepted in this run, or its stamp cannot be read",
                place=str(folder),
                next_move=f"worldwright go {run.folder} --accept",
            ) from cause
        if not (folder / WORLD).is_file():
            raise GateError(
                f"this small form keeps no {WORLD}",
                place=str(folder),
                next_move=f"worldwright stamp verify {run.folder} --rebuild, or accept it anew: worldwright go {run.folder}/plan.md",
            )
        there = {part for part in (*DRIVEN, MOTION) if (folder / part).exists()}
        for part in (*NEEDED, *sorted(there.union(name for name in DRIVEN if name in stamped))):
            if not (folder / part).is_file() or sha256_file(folder / part) != stamped.get(part):
                raise GateError(
                    f"{part} is not what the stamp lists",
                    place=str(folder / part),
                    next_move=f"worldwright stamp verify {run.folder}",
                )
        facts = folder / FACTS
        given = Given.read(folder / WORLD, facts / "program.json", facts / "inputs.json")
        return cls(folder, given, read_plan(folder / "plan.md").plan, stamped)

    @cached_property
    def model(self) -> "mujoco.MjModel":
        """The world, compiled and prepared as the physics pass does it (`worldengine.clock.simulate.prepare`)."""
        from worldengine.clock.simulate import prepare

        model = self.given.model()
        prepare(model)
        return model

    @property
    def steps(self) -> int:
        """Steps of the plan's duration."""
        from worldkit.world import steps_of

        return steps_of(self.model, self.given.duration)

    def recorded(self, ports: Any) -> "Recorded":
        """The answers by which the accepted recording was driven; a `RecordingError` where they make no sense."""
        from worldengine.inputs.strict_stream import Recorded
        from worldengine.recording.stored import Replayable

        drove = Replayable(self.folder / FACTS)
        return Recorded(drove, self.model, ports, self.steps, self.given.control_every)

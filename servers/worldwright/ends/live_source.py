"""The world that is stepped live: an accepted one as it was stamped, else the one that was built and recorded last."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..model import json_object
from ..model.errors import GateError
from ..model.evidence.journal import Journal, results
from ..model.evidence.run import Run, sha256_file
from .accepted_world import FACTS, MOTION, WORLD, AcceptedWorld

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from worldengine.given import Given

    from ..model.plan.committed import Plan

PROGRAM, INPUTS = "program.json", "inputs.json"


@dataclass(frozen=True)
class LiveSource:
    """Where its parts lie."""

    run: Run
    plan: "Plan"
    plan_file: Path
    world: Path
    facts: Path
    """The folder of `program.json` and `inputs.json`."""
    drove: Path | None
    """The folder of the inputs that were recorded; None where nothing drove it."""
    motion: Path
    """What was recorded: an npz file or a recording's folder."""
    stamp_sha256: str = ""
    """Of the stamp of an accepted world."""
    digests: Mapping[str, str] = field(default_factory=dict)
    """SHA-256 of plan, world and facts as they were stamped or recorded, by the names that they have in a drive."""
    doubt: str = ""
    """Why nothing that is driven of it is signed; empty: nothing speaks against it."""

    @classmethod
    def find(cls, name: Path | str) -> "LiveSource":
        """The world of a run.

        Raises:
            NotFoundError: there is no such run.
            GateError: nothing was accepted or recorded of it, it has no plan, or what was accepted or recorded is not as it was left.
        """
        run = Run.find(name)
        if (run.stamped / "stamp.json").is_file() and (run.stamped / WORLD).is_file():
            world = AcceptedWorld.read(name)
            folder = world.folder / FACTS
            stamp = hashlib.sha256((world.folder / "stamp.json").read_bytes()).hexdigest()
            return cls(
                run, world.plan, world.folder / "plan.md", world.folder / WORLD, folder, _driven(folder),
                world.folder / MOTION, stamp,
                {"plan.md": world.stamped["plan.md"], **_named(world.stamped, f"{FACTS}/")},
            )  # fmt: skip
        from ..model.evidence import environment
        from ..model.plan.plan_text import read_plan
        from ..stage.one_frame import recorded
        from ..stamp import departures

        if not run.plan.is_file():
            raise GateError(
                "a folder that records somebody's model declares no input",
                place=str(run.folder),
                next_move="write a plan whose interventions declare the controls (skill importing-models)",
            )
        key = run.evidence_key(environment.current().sha256())
        physics = recorded(run, key)
        _vouched(run, key.key, physics / "result.json")
        digests = _named((json_object.read(physics / "result.json") or {}).get("files"))
        for name, digest in {WORLD: digests[WORLD], PROGRAM: digests["facts.json"], INPUTS: digests[INPUTS]}.items():
            if not (physics / name).is_file() or sha256_file(physics / name) != digest:
                raise GateError(
                    f"{name} is not what was recorded",
                    place=str(physics / name),
                    next_move=f"worldwright stage start {run.folder} --stage physics",
                )
        digests["plan.md"] = sha256_file(run.plan)
        motion = physics / "trajectory"
        plan = read_plan(run.plan).plan
        other = departures.from_plan(physics / WORLD, plan)
        doubt = f"the world is not the plan's: {other[0]}" if other else ""
        return cls(run, plan, run.plan, physics / WORLD, physics, _driven(motion), motion, "", digests, doubt)

    @cached_property
    def given(self) -> "Given":
        """What the engine is given of it."""
        from worldengine.given import Given

        return Given.read(self.world, self.facts / "program.json", self.facts / "inputs.json")

    @cached_property
    def model(self) -> "mujoco.MjModel":
        """The world, compiled."""
        return self.given.model()

    def poses(self) -> "tuple[np.ndarray | None, np.ndarray | None]":
        """(T, B, 3) m and (T, B, 4) of the recorded bodies, for which the plan's cameras are aimed; None where nothing is kept."""
        import numpy as np

        from worldengine.recording import stored

        if self.motion.is_file():
            with np.load(self.motion, allow_pickle=False) as told:
                return told["pos"], told["quat"]
        if (self.motion / "meta.json").is_file():
            recording = stored.open(self.motion)
            return recording.pos, recording.quat
        return None, None


def _vouched(run: Run, key: str, result: Path) -> None:
    """Refuse the result of a pass for which no line of the journal speaks: whoever can write the run can write such a file."""
    again = f"rm -r {result.parent} && worldwright stage start {run.folder} --stage physics"
    if broken := Journal(run.journal).breaks():
        raise GateError(
            f"the journal is not as it was written: {broken[0]}",
            place=str(run.journal),
            next_move=f"restore it; worldwright stamp status {run.folder} tells what to do without a copy",
        )
    if results(run.entries(), key).get("physics") != sha256_file(result):
        raise GateError("no line of the journal vouches for what was recorded", place=str(result), next_move=again)


def _named(files: Any, at: str = "") -> dict[str, str]:
    """World and facts out of a list of files by SHA-256; what is not listed has none."""
    listed = files if isinstance(files, dict) else {}
    names = {WORLD: WORLD, f"{at}{PROGRAM}": "facts.json", f"{at}{INPUTS}": INPUTS}
    return {ours: str(listed.get(theirs, "")) for theirs, ours in names.items()}


def _driven(folder: Path) -> Path | None:
    return folder if (folder / "inputs.arrows").is_file() else None

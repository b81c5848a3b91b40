"""What the engine's process gets: a world as one file, facts about its program, and the inputs that may be written."""

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.errors import ProgramError

from .inputs.declared_media import Medium
from .solvers import Row

if TYPE_CHECKING:
    import mujoco

OWN = {"solver", "law"}
"""What a declared row has that opens nothing to `control`."""
REMEDY = "let worldkit.program write it"


@dataclass(frozen=True)
class Given:
    """It is checked, as its writer may mean to mislead."""

    world: Path
    duration: float
    fps: int
    size: tuple[int, int]
    movers: tuple[str, ...]
    visual_only: tuple[str, ...]
    seed: int
    control: str
    """The name of the program's control function; empty when there is none."""
    control_every: int
    latency: int
    inputs: tuple[tuple[str, frozenset[str]], ...] | None
    """The inputs that an author may write, as declared (kind, names); None opens everything."""
    solvers: tuple[Row, ...] = ()
    """Solvers beside the engine, as declared."""
    laws: tuple[Medium, ...] = ()
    """The author's own laws: as declared, or where nothing is, as the program has them."""

    @classmethod
    def read(cls, world: Path, program: Path, inputs: Path | None) -> "Given":
        """Read it from its files.


        Raises:
            ProgramError: a file is missing, or makes no sense.
        """
        facts = _json(program)
        rows = None if inputs is None else _json(inputs)
        try:
            width, height = facts["size"]
            found = cls(
                world=world,
                duration=float(facts["duration"]),
                fps=int(facts["fps"]),
                size=(int(width), int(height)),
                movers=_names(facts["movers"]),
                visual_only=_names(facts["visual_only"]),
                seed=int(facts["seed"]),
                control=str(facts["control"] or ""),
                control_every=int(facts["control_every"]),
                latency=int(facts["latency"]),
                inputs=None
                if rows is None
                else tuple((str(r["kind"]), frozenset(_names(r["bodies"]))) for r in rows if not OWN.intersection(r)),
                solvers=tuple(Row.read(r) for r in rows or () if "solver" in r),
                laws=_laws(facts, rows),
            )
        except (KeyError, TypeError, ValueError, OverflowError) as cause:
            raise ProgramError(f"the facts of the program are damaged: {cause!r}", str(program), REMEDY) from cause
        if not (math.isfinite(found.duration) and found.duration > 0):
            raise ProgramError(f"the facts of the program say duration {found.duration}", str(program), REMEDY)
        good = 1 <= found.fps <= 1000 and all(16 <= side <= 8192 and side % 2 == 0 for side in found.size)
        if not (good and found.control_every >= 1 and found.latency in (0, 1) and found.seed >= 0):
            raise ProgramError("the facts of the program make no sense", str(program), REMEDY)
        return found

    @property
    def answers(self) -> bool:
        """Whether the program answers anything while its world runs."""
        return bool(self.control or self.laws)

    def model(self, camera: str = "") -> "mujoco.MjModel":
        """The world, compiled; one without any camera gets a `camera` of this name, to be stood anywhere."""
        from worldkit import portable

        try:
            spec = portable.spec(self.world)
            if camera and not spec.cameras:
                spec.worldbody.add_camera(name=camera)
            return portable.compiled(spec)
        except (ValueError, RuntimeError) as failure:
            raise ProgramError(f"the world does not compile: {failure}", self.world.name, "build it again") from failure


def _laws(facts: Any, rows: Any) -> tuple[Medium, ...]:
    if rows is not None:
        return tuple(Medium.read(row) for row in rows if "law" in row)
    return tuple(Medium.read({"bodies": row["bodies"], "law": row}) for row in facts.get("laws", ()))


def _names(value: Any) -> tuple[str, ...]:
    if not isinstance(value, list) or not all(isinstance(name, str) for name in value):
        raise TypeError(f"{value!r} is no list of names")
    return tuple(value)


def _json(path: Path) -> Any:
    try:
        return json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError) as cause:
        raise ProgramError(f"the facts of the program cannot be read: {cause}", str(path), REMEDY) from cause

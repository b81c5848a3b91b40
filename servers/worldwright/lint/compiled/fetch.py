"""Have a world compiled in the sandbox, and read what was written down about it.

What comes back was made beside code that nobody vouches for: it is read as plain numbers and texts of checked size, and
can mislead the rules about that program, and about nothing else.
"""

import contextlib
import hashlib
import io
import sys
import tempfile
import zipfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...model import json_object

if TYPE_CHECKING:
    import numpy as np

    from ...model.evidence.reports import EvidenceKey
    from ...model.evidence.run import Run

MOST_BYTES = 128 << 20
WALL_S = 20.0
UNPRICED = 0.0
"""In place of how long a program's world is simulated: what that costs is not asked, so that no step is taken."""
PROGRAM = "simulation.py"
MEMORY_MB = 2048
BUNDLE, FACTS = "world.mjz", "program.json"
MOST_FACTS = 1 << 20
"""Bytes of a program's facts, as the pass takes them."""
ARCHIVE = ".mjz"
"""Suffix of a file that holds all of a world, so that its content alone says what it compiles to."""


LACKED = {
    "refused": ("no sandbox confines a program on this machine", "`worldwright doctor` says what it lacks"),
    "out_of_memory": (
        f"it takes more than {MEMORY_MB >> 10} GB of memory",
        "free memory if it is short; else fewer copies, cells or parts",
    ),
    "timed_out": (
        "it was not there after {wall:.0f} s",
        "try again with less beside it; else fewer copies, cells or parts",
    ),
    "too_large": ("the engine was still compiling it after {wall:.0f} s", "fewer copies, cells or parts"),
}
"""Why a machine makes no world, and what helps, by the status."""


@dataclass(frozen=True)
class Outcome:
    """A compiled world, or why there is none."""

    status: str
    """`compiled`; `nothing` (the program makes no world); `failed` (it raised); `timed_out`, `out_of_memory`, `died`;
    `too_large` (the engine's compiler was still at it);
    `refused` (no sandbox here); `wanting` (a tool or the machine itself failed on the way to it)."""
    arrays: "dict[str, np.ndarray]" = field(default_factory=dict)
    texts: dict[str, Any] = field(default_factory=dict)
    failure: str = ""
    """Name of the exception."""
    message: str = ""
    next_move: str = ""
    """With status `wanting`: what the machine lacks is to be had by this."""
    line: int | None = None
    """The line of the program that the exception passed, if it passed one."""
    warnings: tuple[str, ...] = ()
    """What the compiler warned of."""
    wall_s: float = 0.0
    level: str = ""

    @property
    def pass_s(self) -> float | None:
        """Seconds that the physics pass will take, by the first steps; None when they were not taken."""
        told = self.texts.get("rehearsed")
        rows = [told.get(name) for name in ("taken", "seconds", "steps")] if isinstance(told, dict) else []
        numbers = [float(n) for n in rows if isinstance(n, int | float) and n > 0]
        return numbers[2] * numbers[1] / numbers[0] if len(numbers) == 3 else None

    @property
    def lacked(self) -> tuple[str, str] | None:
        """What this machine lacked to make it, and what helps; None where that is not why there is no world."""
        if self.status == "wanting":
            return self.message, self.next_move
        if self.status == "failed" and self.failure == "ModuleNotFoundError":
            return (
                f"a package is not installed: {self.message}",
                "install it; `worldwright doctor` names what is missing",
            )
        cause, move = LACKED.get(self.status, ("", ""))
        return (cause.format(wall=self.wall_s), move) if cause else None


def world(path: Path, *, is_mjcf: bool = False, wall_s: float = WALL_S, lasting_s: float | None = None) -> Outcome:
    """Compile the world of a program, or a model file, in the sandbox; that of an archive once in a row.

    Args:
        path: the file.
        is_mjcf: it is a model and not a program.
        wall_s: the attempt ends after so many seconds.
        lasting_s: how long the world of a file is simulated, s, where that is known; a program says it itself, but for
            `UNPRICED`.

    Raises:
        CallOverError: the client's call ended first, which says nothing of the world.
    """
    if not (is_mjcf and path.suffix == ARCHIVE and path.is_file() and path.stat().st_size <= MOST_BYTES):
        return _compiled(path, is_mjcf, wall_s, lasting_s)
    content = path.read_bytes()
    sha256 = hashlib.sha256(content).hexdigest()
    known = _KEPT.get(sha256)
    if known is not None and lasting_s in (None, known[0]):
        return known[1]
    with tempfile.TemporaryDirectory(prefix="worldwright-world-") as folder:
        # These very bytes, whatever the file is by then: else another's outcome could be kept under their hash.
        copy = Path(folder) / path.name
        copy.write_bytes(content)
        outcome = _compiled(copy, is_mjcf, wall_s, lasting_s)
    # The price is missing where time was up before it was known: another attempt may find it.
    if outcome.status == "compiled" and (lasting_s is None or outcome.pass_s is not None):
        _KEPT.clear()
        _KEPT[sha256] = (lasting_s, outcome)
    return outcome


_KEPT: dict[str, tuple[float | None, Outcome]] = {}
"""The last archive's world, by its content: what is linted, then simulated and then proved is mostly one and the same."""


def _compiled(path: Path, is_mjcf: bool, wall_s: float, lasting_s: float | None) -> Outcome:
    from ...model import companions
    from ...model.errors import WorldwrightError
    from ...stage.tools import model_files, run_confined

    here = Path(__file__).parent
    path = path.absolute()
    reads = [here / "compile_world.py", here / "measure.py", here / "rehearse.py", path]
    if not is_mjcf and path.name == PROGRAM:
        with contextlib.suppress(companions.CompanionError, OSError):  # refused in words where evidence is kept
            reads += [path.parent / name for name in companions.of(path)]
    if is_mjcf:
        with contextlib.suppress(WorldwrightError):  # not well-formed: the compiler says it better
            reads += model_files(path)
    call = [sys.executable, "-s", str(here / "compile_world.py"), "mjcf" if is_mjcf else "program", str(path), "{out}"]
    call += [] if lasting_s is None else [str(lasting_s)]
    wanted = ("outcome.json", "facts.npz", "compiling")
    own = None if is_mjcf else path
    done = run_confined(call, program=own, reads=reads, wanted=wanted, wall_s=wall_s, memory_mb=MEMORY_MB)
    common: dict[str, Any] = {"wall_s": done.wall_s, "level": done.level}
    if done.status != "ended" and "outcome.json" not in done.files:  # the world was compiled, and its first step failed
        status = "too_large" if done.status == "timed_out" and "compiling" in done.files else done.status
        return Outcome(status, message=done.log[-500:], **common)
    outcome = done.files.get("outcome.json", b"")
    if len(outcome) > json_object.MOST_BYTES:
        much = f"what its process told of it is larger than {json_object.MOST_BYTES >> 20} MB"
        return Outcome("died", message=much, **common)
    told = json_object.told(outcome) or {}
    common["warnings"] = tuple(str(w) for w in told.get("warnings") or ())
    if "failure" in told:
        line = told.get("line")
        return Outcome(
            "failed",
            failure=str(told["failure"]),
            message=str(told.get("message", ""))[:2000],
            line=line if isinstance(line, int) and line > 0 else None,
            **common,
        )
    if told.get("made_by") == "nothing":
        return Outcome("nothing", **common)
    arrays = _arrays(done.files.get("facts.npz", b""))
    if not arrays or "names" not in told:
        last = (done.log.strip().splitlines() or [f"it ended with status {done.exit_code}"])[-1]
        return Outcome("died", message=last[:500], **common)
    return Outcome("compiled", arrays=arrays, texts=told, **common)


def bundled(run: "Run", key: "EvidenceKey") -> tuple[Path, float] | None:
    """The world that the bundle pass has made of this program and plan, and how long it is simulated, s; None without."""
    from ...model.evidence.run import sha256_file
    from ...stage.tools import read_plain

    def said(name: str, most: int) -> dict[str, Any]:
        return json_object.told(read_plain(folder / name, most) or b"") or {}

    folder = run.evidence(key) / "bundle"
    try:
        result = said("result.json", json_object.MOST_BYTES)
        files = result.get("files") or {}
        if not result.get("ok") or any(sha256_file(folder / name) != files.get(name) for name in (BUNDLE, FACTS)):
            return None
        return folder / BUNDLE, float(said(FACTS, MOST_FACTS)["duration"])
    except (OSError, KeyError, TypeError, ValueError, AttributeError):
        return None


def _arrays(data: bytes) -> "dict[str, np.ndarray]":
    """Read the arrays of an uncompressed archive; there are none when it is not one of ours."""
    import numpy as np

    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            if sum(info.file_size for info in archive.infolist()) > MOST_BYTES:
                return {}
        with np.load(io.BytesIO(data), allow_pickle=False) as found:
            return {name: found[name] for name in found.files}
    except (OSError, ValueError, KeyError, zipfile.BadZipFile, EOFError, RuntimeError):
        return {}

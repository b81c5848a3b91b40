"""Have a world compiled in the sandbox, and read what was written down about it.

What comes back was made beside code that nobody vouches for: it is read as plain numbers and texts of checked size, and
can mislead the rules about that program, and about nothing else.
"""

import contextlib
import io
import json
import sys
import zipfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np

MOST_BYTES = 128 << 20
WALL_S = 20.0
MEMORY_MB = 2048


@dataclass(frozen=True)
class Outcome:
    """A compiled world, or why there is none."""

    status: str
    """`compiled`; `nothing` (the program makes no world); `failed` (it raised); `timed_out`, `out_of_memory`, `died`;
    `too_large` (the engine's compiler was still at it);
    `refused` (no sandbox here)."""
    arrays: "dict[str, np.ndarray]" = field(default_factory=dict)
    texts: dict[str, Any] = field(default_factory=dict)
    failure: str = ""
    """Name of the exception."""
    message: str = ""
    line: int | None = None
    """In the program, when the exception passed through it."""
    warnings: tuple[str, ...] = ()
    """What the compiler warned of."""
    wall_s: float = 0.0
    level: str = ""


def world(path: Path, *, is_mjcf: bool = False, wall_s: float = WALL_S) -> Outcome:
    """Compile the world of a program, or a model file, in the sandbox.

    Args:
        path: the file.
        is_mjcf: it is a model and not a program.
        wall_s: given up after so many seconds.
    """
    from ...model.errors import WorldwrightError
    from ...stage.tools import model_files, run_confined

    here = Path(__file__).parent
    path = path.absolute()
    reads = [here / "probe.py", here / "measure.py", path]
    if is_mjcf:
        with contextlib.suppress(WorldwrightError):  # not well-formed: the compiler says it better
            reads += model_files(path)
    call = [sys.executable, "-s", str(here / "probe.py"), "mjcf" if is_mjcf else "program", str(path), "{out}"]
    wanted = ("outcome.json", "facts.npz", "compiling")
    done = run_confined(call, reads=reads, wanted=wanted, wall_s=wall_s, memory_mb=MEMORY_MB)
    common: dict[str, Any] = {"wall_s": done.wall_s, "level": done.level}
    if done.status != "ended":
        status = "too_large" if done.status == "timed_out" and "compiling" in done.files else done.status
        return Outcome(status, message=done.log[-500:], **common)
    told = _object(done.files.get("outcome.json", b""))
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


def _object(data: bytes) -> dict[str, Any]:
    try:
        value = json.loads(data)
    except (ValueError, RecursionError):
        return {}
    return value if isinstance(value, dict) else {}


def _arrays(data: bytes) -> "dict[str, np.ndarray]":
    """The arrays of an uncompressed archive; empty when it is not one of ours."""
    import numpy as np

    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            if sum(info.file_size for info in archive.infolist()) > MOST_BYTES:
                return {}
        with np.load(io.BytesIO(data), allow_pickle=False) as found:
            return {name: found[name] for name in found.files}
    except (OSError, ValueError, KeyError, zipfile.BadZipFile, EOFError, RuntimeError):
        return {}

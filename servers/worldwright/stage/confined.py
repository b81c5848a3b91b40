"""A short confined run without a run folder: so lint has a program's world compiled, and looks at what is left.

It has the ladder and the limits of a job, but nothing is kept: its folder is gone afterwards. It uses the lowest level
only if the user chose it, as limits alone do not keep a program from the user's files.
"""

import os
import subprocess
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from ..model import call_time, processor_time
from ..model.own_time import OwnTime
from . import family, plain, sandbox
from .sandbox.confinement import Confinement, environment
from .sandbox.enter import enter

if TYPE_CHECKING:
    from .kept_sculpts import Given

TICK_S = 0.2
PROGRESS = "progress.json"
ENDLESS_CPU_S = 30 * 86_400
"""The kernel wants a number; a run that counts its progress is ended when it stands still."""
MB = 1 << 20
LOG_BYTES = 20_000
CALL_OVER = "call_over"
MOST_MATCHING = 64


@dataclass(frozen=True)
class Confined:
    """How a confined run ended."""

    status: str
    """`ended`, `timed_out`, `out_of_memory`, `cancelled`, or `refused` when no level of the sandbox confines here."""
    exit_code: int = 0
    files: dict[str, bytes] = field(default_factory=dict)
    """The wanted files, as far as they were left as plain files of acceptable size."""
    log: str = ""
    """The end of what it printed."""
    wall_s: float = 0.0
    level: str = ""
    sculpted: tuple[str, ...] = ()
    """Names of the shapes that it made anew and that are kept; see `kept_sculpts`."""


def run(
    call: Sequence[str],
    *,
    reads: Sequence[Path] = (),
    wanted: Sequence[str] = (),
    wall_s: float = 20.0,
    memory_mb: int = 2048,
    file_mb: int = 64,
    sculpts: "Given | None" = None,
    home: Callable[[Path], object] | None = None,
    left: Callable[[Path], object] | None = None,
    cancelled: Callable[[], bool] = lambda: False,
    kept: Path | None = None,
    advances: bool = False,
) -> Confined:
    """Run a command to its end in the sandbox; `{out}` in it stands for the one folder it may write.

    Args:
        call: the command line.
        reads: files and folders it may read besides what every program may.
        wanted: names of the files in that folder that the caller wants to see, or patterns such as `*.jpg`.
        wall_s: the run is killed after so many seconds of its own: while it sleeps the clock on the wall counts, while it
            computes only what it gets of a processor, so that other work beside it does not end it. The end of a client's call
            (`model.call_time`) ends it by the clock, as an error: it tells nothing of what runs.
        memory_mb: resident memory of all its processes, MiB.
        file_mb: size of one file, MiB.
        sculpts: shapes that were made earlier by the same sources, and the place for those that it makes.
        home: lays something into its throw-away home, whose folder it is given, before it starts.
        left: takes something out of it after it has ended well.
        cancelled: asked several times a second; the run is ended when it says so.
        kept: the folder that it may write, which stays, for what is too large to be handed over; a throw-away one without it.
        advances: it tells in `progress.json` how much is done (`worldkit.reporting.Progress`); then `wall_s` begins anew whenever
            that grows, and its length is bounded by what it has to do, not by a clock.

    Raises:
        CallOverError: the client's call ended first; what was sculpted until then is kept.
    """
    name = sandbox.level()
    if not allowed(name):
        return Confined("refused", level=name)
    if call_time.left_s() <= 0:  # what is short would else end before it is looked at
        raise call_time.over()
    with tempfile.TemporaryDirectory(prefix="worldwright-confined-") as folder:
        out, scratch = kept or Path(folder) / "out", Path(folder) / "tmp"
        out.mkdir(exist_ok=kept is not None)
        scratch.mkdir()
        if home is not None:
            home(scratch)
        confinement = Confinement(
            out=out,
            reads=tuple(path.absolute() for path in (*reads, *(_places(sculpts)))),
            scratch=scratch,
            cpu_s=ENDLESS_CPU_S if advances else int(wall_s) + 1,
            file_bytes=file_mb * MB,
            memory_bytes=memory_mb * MB + (4 << 30),
            token=family.new_token(),
            processes=16,
            threads=128,
            environment=environment(str(scratch)) | (sculpts.variables(scratch) if sculpts else {}),
        )
        words = [word.replace("{out}", str(out)) for word in call]
        # Its output goes to a file, so that the limit on files holds for it, too.
        with (Path(folder) / "log.txt").open("w+b") as log:
            began = time.monotonic()
            limits = wall_s, memory_mb * MB, advances
            status, code = _watched(sandbox.LADDER[name], words, confinement, log, limits, cancelled)
            wall = time.monotonic() - began
            log.seek(max(0, log.seek(0, os.SEEK_END) - LOG_BYTES))
            tail = log.read().decode(errors="replace")
        names = [name for word in wanted for name in (_matching(out, word) if "*" in word else [word])]
        files = {file: data for file in names if (data := plain.read(out / file, file_mb * MB)) is not None}
        sculpted = sculpts.keep(scratch) if sculpts else ()
        if left is not None and (status, code) == ("ended", 0):
            left(scratch)
    if status == CALL_OVER:
        raise call_time.over()
    return Confined(status, code, files, tail, round(wall, 3), name, sculpted)


def allowed(level: str) -> bool:
    """Whether a program that nobody has read may be run at a level: it confines, or the user chose it by name."""
    return level in sandbox.CONFINING or os.environ.get("WORLDWRIGHT_SANDBOX") == level


def _places(sculpts: "Given | None") -> tuple[Path, ...]:
    return tuple(path for path in sculpts.places if path.is_dir()) if sculpts else ()


def _done(out: Path) -> float:
    """How much a run says is done; 0 where it says nothing that makes sense."""
    said = plain.read_json(out / PROGRESS).get("done")
    return float(said) if isinstance(said, int | float) and abs(said) < 1e15 else 0.0


def _matching(out: Path, pattern: str) -> list[str]:
    """At most so many names in a folder that fit a pattern, sorted."""
    return sorted(path.name for path in out.glob(pattern))[:MOST_MATCHING]


def _watched(
    level: ModuleType,
    call: list[str],
    confinement: Confinement,
    log: object,
    limits: tuple[float, int, bool],
    cancelled: Callable[[], bool],
) -> tuple[str, int]:
    wall_s, memory, advances = limits
    entered = enter(level, call, confinement, stdout=log, stderr=subprocess.STDOUT)
    process, status = entered.process, "ended"
    own, computed, done, since = OwnTime(time.monotonic()), [0.0], 0.0, 0.0
    try:
        while not family.ends_within(process, TICK_S, computed.append):
            seen = family.census(*entered.roots)
            computed.append(seen.cpu_s)
            spent = own.after(time.monotonic(), seen.cpu_s, seen.wanting)
            if advances and (now := _done(confinement.out)) > done:
                done, since = now, spent
            if spent - since > wall_s:
                status = "timed_out"
                break
            if call_time.left_s() < 0:
                status = CALL_OVER
                break
            if seen.resident_bytes > memory:
                status = "out_of_memory"
                break
            if cancelled():
                status = "cancelled"
                break
    finally:
        family.end(process.pid, confinement.token)
        processor_time.add(entered.spent_s(max(computed)))
    return status, process.wait()

"""One short process of the author or the engine, run confined to its end: what it left, or how it failed, in its own words."""

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from ..model import call_time
from ..model.errors import CallOverError, JobError
from . import compiled_shaders, confined, plain
from .kept_sculpts import Given
from .limits import failed

RESULT, ERROR = "result.json", "error.json"
WALL_S, MEMORY_MB = 120.0, 8192
AGAIN = "worldwright stage look RUN --at S"
LESS = "let it do less: a smaller picture, a plainer film or world"


def run_process(
    call: Sequence[str],
    reads: Sequence[Path],
    wanted: Sequence[str],
    *,
    wall_s: float = WALL_S,
    memory_mb: int = MEMORY_MB,
    sculpts: Given | None = None,
    home: Callable[[Path], object] | None = None,
    left: Callable[[Path], object] | None = None,
    again: str = AGAIN,
    less: str = LESS,
    advances: bool = False,
) -> dict[str, Any]:
    """Run a process in the sandbox; returns what it left, by name, with its `result.json` read.

    Args:
        call: its command line; `{out}` stands for the folder that it may write.
        reads: what it may read.
        wanted: names of what it must leave, or patterns of what it may.
        wall_s: seconds of its own.
        memory_mb: resident memory, MiB.
        sculpts: shapes that were made earlier, and the place for those that it makes.
        home: lays something into its throw-away home.
        left: takes something out of it after it has ended well.
        again: the command that shows the failure once more.
        less: what to do when it takes too much.
        advances: `wall_s` begins anew whenever it has advanced; see `confined.run`.

    Raises:
        JobError: it failed, was stopped, or left too little; a line of the author's is in its place.
        CallOverError: the client's call ended first.
    """
    try:
        ended = confined.run(
            call,
            reads=reads,
            wanted=(*wanted, RESULT, ERROR),
            wall_s=wall_s,
            memory_mb=memory_mb,
            file_mb=512,
            home=home,
            left=left,
            sculpts=sculpts,
            advances=advances,
        )
    except CallOverError as early:
        raise call_time.over(again) from early
    said = {name: plain.as_object(ended.files.get(name, b"")) for name in (RESULT, ERROR)}
    if ended.status != "ended":
        why = {
            "timed_out": f"nothing advanced for {wall_s:g} s"
            if advances
            else f"it took more than {wall_s:g} s of processor time",
            "out_of_memory": f"it took more than {memory_mb / 1024:g} GB of memory",
        }
        cause = why.get(ended.status, f"it was stopped: {ended.status}")
        raise JobError(cause, code=ended.status, next_move=less if ended.status in why else "worldwright doctor")
    failure = failed(ended.exit_code, said[RESULT], said[ERROR], again)
    if failure is None and any(name not in ended.files for name in wanted if "*" not in name):
        failure = {"code": "no_result", "message": ended.log[-500:] or "it left nothing"}
    if failure:
        raise JobError(
            failure["message"],
            code=failure["code"],
            place=failure.get("place", ""),
            next_move=failure.get("next_move") or again,
        )
    return {**ended.files, RESULT: said[RESULT]}


def engine(
    words: Sequence[str], reads: Sequence[Path], wanted: Sequence[str], run: Path | None = None, **limits: Any
) -> dict[str, Any]:
    """`run_process` for the engine, which draws with the shaders that are compiled already, those of a `run`, too; `{out}` is told to it here."""
    call = [sys.executable, "-s", "-P", "-m", "worldengine", *words, "--out", "{out}"]
    homes: dict[str, Any] = {"home": compiled_shaders.lay}
    if run is not None:
        homes = {
            "home": lambda home: compiled_shaders.lay(home, run),
            "left": lambda home: compiled_shaders.keep(home, run),
        }
    return run_process(call, reads, wanted, **homes, **limits)

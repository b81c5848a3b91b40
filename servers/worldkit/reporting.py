"""What a pass writes for others while it runs (`progress.json`) and when it fails (`error.json`)."""

import json
import linecache
import os
import sys
import time
import traceback
from pathlib import Path
from typing import Any

from .errors import WorldkitError
from .files import write_json

INTERVAL_S = 0.25


class Progress:
    """Writes `progress.json` {"done", "total", "unit"}, at most four times a second, always whole."""

    def __init__(self, out: Path, total: int, unit: str) -> None:
        self._path, self._total, self._unit = out / "progress.json", total, unit
        self._next = time.perf_counter() + INTERVAL_S
        self._write(0)

    def __call__(self, done: int, total: int | None = None) -> None:
        """Report how much is done."""
        now = time.perf_counter()
        if now < self._next and done != (total or self._total):
            return
        self._next = now + INTERVAL_S
        self._total = total or self._total
        self._write(done)

    def _write(self, done: int) -> None:
        # Not flushed to the disk, unlike results: a progress that a power cut loses is of no use anyway.
        temporary = self._path.with_name(".progress.json")
        temporary.write_text(json.dumps({"done": done, "total": self._total, "unit": self._unit}) + "\n")
        os.replace(temporary, self._path)  # noqa: PTH105 (half the cost of Path.replace, four times a second)


def failure(error: BaseException, program: str, caller_line: int | None) -> dict[str, Any]:
    """An exception as `error.json`: type, message, file, line, code, place, next_move, source.

    Args:
        error: what was raised.
        program: the program's file; the innermost line of it in the traceback is the place.
        caller_line: the line to blame when the traceback does not pass through the program.
    """
    frames = [frame for frame in traceback.extract_tb(error.__traceback__) if _same(frame.filename, program)]
    line = frames[-1].lineno if frames else getattr(error, "line", None) or caller_line
    if isinstance(error, SyntaxError) and error.filename and _same(error.filename, program):
        line = error.lineno
    known = isinstance(error, WorldkitError)
    kind = type(error).__name__
    code = error.code if isinstance(error, WorldkitError) else "engine" if kind == "FatalError" else "crashed"
    return {
        "type": code if known and code == "diverged" else kind,
        "message": error.cause if isinstance(error, WorldkitError) else str(error) or kind,
        "file": program,
        "line": line,
        "code": code,
        "place": error.place if isinstance(error, WorldkitError) else "",
        "next_move": error.next_move if isinstance(error, WorldkitError) else "",
        "source": linecache.getline(program, line).strip() if line else "",
    }


def report_failure(error: BaseException, program: str, caller_line: int | None, out: Path | None) -> None:
    """Write `error.json` (when there is a folder) and print the error to standard error: our own errors briefly, others
    in full.
    """
    facts = failure(error, program, caller_line)
    if isinstance(error, WorldkitError):
        sys.stderr.write(f"{error}\n")
    else:
        traceback.print_exception(error)
    if out is not None:
        try:
            write_json(out / "error.json", facts)
        except OSError as also:
            sys.stderr.write(f"and error.json cannot be written: {also}\n")


def _same(one: str, other: str) -> bool:
    return os.path.abspath(one) == os.path.abspath(other)  # noqa: PTH100 (no symbolic links resolved)

"""Have a program run in the sandbox under watch, and read what was seen.

What comes back was written beside code that nobody vouches for: it is read as plain numbers and texts of checked size, and
can mislead the rules about that program, and about nothing else.
"""

import contextlib
import re
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...model import json_object

WALL_S = 40.0
MEMORY_MB = 2048
MOST_EVENTS = 400
MODELS = (".xml", ".mjcf", ".stl", ".obj", ".png")
MOST_MODELS = 200
ELSEWHERE = (
    "OSError",
    "FileNotFoundError",
    "FileExistsError",
    "NotADirectoryError",
    "IsADirectoryError",
    "ModuleNotFoundError",
    "ImportError",
    "PermissionError",
    "KeyboardInterrupt",
    "EOFError",
)
"""Failures that say more about this place than about the program."""
UNCLEAR = ("FatalError", "RuntimeError", "AttributeError")
NO_FILE = re.compile(r"Error opening file|failed to load from mjb")
"""The engine's words about a file that is not there."""
NO_PICTURES = re.compile(r"OpenGL|gladLoadGL|GLFW|EGL|display|framebuffer|DISPLAY", re.IGNORECASE)


@dataclass(frozen=True)
class Observation:
    """What a program did while it was watched."""

    status: str
    """`ended`, `failed`, `died`, `timed_out`, `cannot` (it needs what is not here), `refused` (no sandbox)."""
    events: tuple[dict[str, Any], ...] = ()
    failure: str = ""
    message: str = ""
    lines: tuple[int, ...] = ()
    """Lines of the program that a failure went through, outermost first."""
    wall_s: float = 0.0
    level: str = ""
    steps: int = 0


def observe(path: Path, wall_s: float = WALL_S) -> Observation:
    """Run a program under watch; a failure counts only when it also fails unwatched.

    Args:
        path: the program.
        wall_s: the run ends after so many seconds; what was seen until then counts.
    """
    seen = _run(path, wall_s, "watched")
    if seen.status in ("failed", "died"):
        again = _run(path, wall_s, "plain")
        if again.status != seen.status:
            return Observation("ended", seen.events, wall_s=seen.wall_s, level=seen.level)
        return Observation(
            again.status, seen.events, again.failure, again.message, again.lines or seen.lines, seen.wall_s, seen.level
        )
    return seen


def _run(path: Path, wall_s: float, how: str) -> Observation:
    from ...stage.tools import run_confined

    inside = Path(__file__).parent / "inside"
    path = path.absolute()
    call = [sys.executable, "-s", str(inside / "watching.py"), str(path), "{out}", how]
    wanted = ("events.jsonl", "end.json", "death.txt")
    reads = [inside, path, *beside(path)]
    done = run_confined(call, program=path, reads=reads, wanted=wanted, wall_s=wall_s, memory_mb=MEMORY_MB)
    common: dict[str, Any] = {"wall_s": done.wall_s, "level": done.level}
    common["events"] = tuple(_events(done.files.get("events.jsonl", b"")))
    if done.status != "ended":
        return Observation(done.status if done.status != "out_of_memory" else "timed_out", **common)
    end = json_object.told(done.files.get("end.json", b"")) or {}
    if not end:
        traced = done.files.get("death.txt", b"").decode(errors="replace")
        lines = [int(n) for n in re.findall(rf'File "{re.escape(str(path))}", line (\d+)', traced)]
        word = re.search(r"Fatal Python error: ([A-Za-z ]+)", traced)
        if word is None:
            return Observation("cannot", **common)
        return Observation("died", failure=word[1].strip(), lines=tuple(lines[:1]), **common)
    if "failure" in end:
        name, message = str(end["failure"]), str(end.get("message", ""))[:600]
        passed = tuple(n for n in end.get("lines") or () if isinstance(n, int) and n > 0)
        here = name in ELSEWHERE or (name in UNCLEAR and NO_PICTURES.search(message)) or NO_FILE.search(message)
        if here or not passed:
            return Observation("cannot", failure=name, message=message, **common)
        return Observation("failed", failure=name, message=message, lines=passed, **common)
    steps = end.get("steps")
    return Observation("ended", steps=steps if isinstance(steps, int) else 0, **common)


def beside(path: Path) -> list[Path]:
    """What a program may read besides itself: the modules that it imports, the data that it names, the models around it."""
    from ...model import companions

    found = [p for p in sorted(path.parent.glob("*")) if p.suffix.lower() in MODELS and p.is_file()][:MOST_MODELS]
    with contextlib.suppress(companions.CompanionError, OSError):
        found += [path.parent / name for name in companions.of(path)]
    return list(dict.fromkeys(found))


def _events(data: bytes) -> list[dict[str, Any]]:
    found = []
    for line in data[: 1 << 20].splitlines()[:MOST_EVENTS]:
        event = json_object.told(line) or {}
        if isinstance(event.get("code"), str) and isinstance(event.get("line"), int) and event["line"] > 0:
            found.append({k: v if isinstance(v, int | float) else str(v)[:200] for k, v in event.items()})
    return found

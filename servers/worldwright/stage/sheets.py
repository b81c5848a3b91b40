"""A sheet of something sculpted: an author's file makes it in the sandbox, and the engine draws it there from four sides."""

import sys
import tempfile
from pathlib import Path
from typing import Any

from worldkit.files import write_atomic

from ..model.errors import JobError, NotFoundError
from ..model.frozen import Frozen
from ..model.picture import Illustrated, Picture
from .kept_sculpts import given, needed
from .sculpting_step import LESS, forget
from .short_runs import engine, run_process

WORLD, PROGRAM, FACTS, SHEET = "world.mjz", "program.json", "sheet.json", "sheet.jpg"
AGAIN = "worldwright sculpt sheet FILE.py[:NAME]"
LIMITS: dict[str, Any] = {"wall_s": 300.0, "memory_mb": 4096, "again": AGAIN, "less": LESS}


class SculptedPart(Frozen):
    """What was measured of one part."""

    name: str
    extent_m: tuple[float, float, float]
    volume_l: float
    mass_kg: float
    triangles: int
    cells: int
    """Along its longest side; 0 for an exact solid."""
    hulls: int
    """Convex pieces that collide."""
    bits: int
    """Pieces that do not hang together."""

    def text(self) -> str:
        """One line, with what looks like a mistake."""
        size = " x ".join(f"{side:g}" for side in self.extent_m)
        loose = f"; {self.bits} pieces that do not touch each other" if self.bits > 1 else ""
        return (
            f"{self.name}: {size} m, {self.volume_l:g} l, {self.mass_kg:g} kg, {self.triangles} triangles, "
            f"{self.hulls} hull{'s' * (self.hulls != 1)}{loose}"
        )


class SculptSheet(Frozen):
    """What a sheet shows, and what was measured."""

    name: str
    extent_m: tuple[float, float, float]
    """Full extents in x, y, z: the size for a plan."""
    mass_kg: float
    bodies: int
    made_s: float
    parts: tuple[SculptedPart, ...] = ()

    def text(self) -> str:
        """The size of the whole, and a line a part."""
        size = " x ".join(f"{side:g}" for side in self.extent_m)
        return "\n".join(
            [
                f"{self.name}: {size} m, {self.mass_kg:g} kg, made in {self.made_s:g} s",
                *(part.text() for part in self.parts),
            ]
        )


def drawn(thing: str) -> Illustrated:
    """Make what a file holds, and draw it from four sides.

    Args:
        thing: FILE.py or FILE.py:NAME. Modules and data beside the file come along. NAME is that of a shape, solid, part, row
            of parts, or of a function that gives one of them or a whole world; without it, the last one in the file.

    Raises:
        NotFoundError: there is no such file.
        JobError: it does not run, or holds nothing that can be drawn; the error has its line.
    """
    path_text, colon, name = thing.rpartition(":")
    file = Path(path_text) if colon and path_text.endswith(".py") else Path(thing)
    name = name if str(file) == path_text else ""
    if not file.is_file():
        raise NotFoundError(f"there is no file {file}", next_move=AGAIN)
    with tempfile.TemporaryDirectory(prefix="worldwright-sheet-") as folder:
        source, laid = Path(folder) / "source", Path(folder) / "laid"
        root = _root(file)
        inside = file.absolute().relative_to(root).as_posix()
        files = needed(root, inside)
        for path, content in files.items():
            write_atomic(source / path, content)
        call = [sys.executable, "-s", "-P", "-m", "worldkit.sculpt.showing", str(source / inside), "--name", name]
        call += ["--root", str(source), "--out", "{out}"]
        try:
            made = run_process(call, (source,), (WORLD, PROGRAM, FACTS), sculpts=given(files), **LIMITS)
            forget(root, inside)
            for path in (WORLD, PROGRAM):
                write_atomic(laid / path, made[path])
            words = [f"--{word}={laid / path}" for word, path in (("world", WORLD), ("program", PROGRAM))]
            sheet = engine(["sheet", *words], (laid,), (SHEET,), **LIMITS)[SHEET]
        except JobError as failure:
            line = failure.place.rpartition(":")[2]
            failure.place = f"{file}:{line}" if line.isdecimal() else str(file)
            raise
    try:
        found = SculptSheet.model_validate_json(made[FACTS])
    except ValueError as cause:  # it comes out of the sandbox, where the file could have written anything
        raise JobError(
            f"what it measured cannot be read: {cause}", code="damaged", place=str(file), next_move=AGAIN
        ) from cause
    return Illustrated(found, (Picture(sheet, f"{found.name}: front, three quarters, side, back", "jpeg"),))


def _root(file: Path) -> Path:
    """The run folder that a file lies in, which its own imports may be seen from; else the file's own."""
    here = file.absolute().parent
    marks = ("plan.md", "simulation.py")
    return next((one for one in (here, *here.parents[:2]) if any((one / m).is_file() for m in marks)), here)

"""The mesh and picture files of a model that lie beside the program: found, looked at, and given to the engine.

The engine reads some formats itself; of the others it is given vertices and faces, in metres where the file tells its unit.
"""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Any

from .errors import IntakeError
from .model_files import READ_FOR_IT

HEADER_BYTES = 1 << 16
_root: ContextVar[Path | None] = ContextVar("root", default=None)


@contextmanager
def below(root: Path) -> Iterator[None]:
    """Read the files of models below a folder alone; no module is ever looked for there, as it would be on `sys.path`."""
    held = _root.set(root.absolute())
    try:
        yield
    finally:
        _root.reset(held)


def give(item: Any, name: str) -> None:
    """Have a mesh, texture or height field of a parsed model read its file from beside the program.

    Args:
        item: of the parsed model; its `file` is a path relative to the program's folder.
        name: of the model, for what is told.

    Raises:
        ValueError: the file is not there, or what it claims is too much or not whole.
    """
    from .intake import declared_sizes

    path = found(item.file, name)
    try:
        if path.suffix.lower() == ".png":
            with path.open("rb") as file:
                declared_sizes.picture(file.read(HEADER_BYTES), path.name)
        elif path.suffix.lower() in declared_sizes.SUFFIXES:
            declared_sizes.check(path)
        if path.suffix.lower() not in READ_FOR_IT:
            item.file = str(path)
            return
        item.name = item.name or path.stem
        item.file = ""
        item.uservert, item.userface = _triangles(path)
    except IntakeError as error:
        raise ValueError(f"model {name}: {error.place}: {error.cause}; {error.next_move}") from error


def found(file: str, name: str) -> Path:
    """A file below the root that was named, else beside the program: where modules of its own are looked for."""
    if not Path(file).is_absolute() and ".." not in Path(file).parts:
        root = _root.get()
        for folder in sys.path if root is None else [root]:
            if folder and (Path(folder) / file).is_file():
                return (Path(folder) / file).absolute()
    raise ValueError(f"model {name}: there is no file {file!r} beside the program")


def _triangles(path: Path) -> tuple[list[float], list[int]]:
    """Corners and faces, in rows, of all pieces of a file."""
    import numpy as np

    from .intake import drawn_pieces, told_frames

    pieces, _ = drawn_pieces.read(path)
    unit = told_frames.of(path).unit_m or 1.0
    starts = np.cumsum([0, *(len(piece.vertices) for piece in pieces)])
    faces = np.concatenate([piece.faces + start for piece, start in zip(pieces, starts, strict=False)])
    return (unit * np.concatenate([piece.vertices for piece in pieces])).ravel().tolist(), faces.ravel().tolist()

"""The copy of a run in which it is rehearsed: laid out file by file, so that a kill never makes an old copy pass for a new one.

What lies in a run folder may be a stranger's, its `rehearsal/` too: nothing outside is removed or written by what that says.
"""

import hashlib
import posixpath
from collections.abc import Mapping
from pathlib import Path, PurePosixPath
from typing import Any

from worldkit.files import write_atomic

from ..model import companions
from ..model.errors import GateError
from ..model.evidence import rehearsed
from ..model.evidence.run import Run, sha256_file
from ..model.plan import taken_along
from ..model.storage import writing


def lay_out(run: Run) -> Run:
    """The rehearsal of a run, with the files as they stand; what was simulated of these very files before is gone on with.

    Raises:
        GateError: what lies where the rehearsal belongs is none, or says of itself what cannot be true.
        StorageError: it cannot be written.
    """
    from ..stage.tools import free_earlier

    require_place(run)
    copy = Run(rehearsed.folder(run.folder))
    files = _files(run)
    if _stands(copy, files):
        return copy
    earlier = [_inside(copy, name) for line in _lines(copy) for name in _names(copy, line)]
    now = {_inside(copy, name): content for name, content in files.items()}
    if copy.plan.is_file():
        free_earlier(copy)
    of = _digest(files)
    copy.log(rehearsed.FOLDER, rehearsed.ACTION, of=of, files=sorted(files))  # before anything else lies there
    with writing("the rehearsal", copy.folder):
        for path in earlier:
            path.unlink(missing_ok=True)
        for path, content in now.items():
            write_atomic(path, content)
    copy.log(rehearsed.FOLDER, rehearsed.LAID, of=of)
    return copy


def stands(run: Run, copy: Run) -> bool:
    """Whether a rehearsal is of its run's files as they are at this moment."""
    return _stands(copy, _files(run))


def names(copy: Run) -> tuple[str, ...]:
    """The files of a rehearsal that are the run's own, by path relative to either."""
    lines = _lines(copy)
    return tuple(_names(copy, lines[-1])) if lines else ()


def require_place(run: Run) -> None:
    """Refuse a `rehearsal` that is no rehearsal.

    Raises:
        GateError: it is a file, a link, or a folder of somebody's own.
    """
    here = rehearsed.folder(run.folder)
    if rehearsed.of(run.folder) is not None:
        return
    if here.is_dir() and not here.is_symlink():
        with writing("the rehearsal", here):
            own = Run(here)  # of one that was killed at its first line there is the journal, without a line
            alone = all(path == own.journal and not path.is_symlink() for path in here.iterdir())
            if alone and not any(own.entries()):
                return
    elif not here.exists() and not here.is_symlink():
        return
    raise GateError(
        f"`{rehearsed.FOLDER}` is where a run is rehearsed, and what lies there is no rehearsal",
        place=str(here),
        next_move="give it another name, or remove it, then rehearse again",
    )


def _files(run: Run) -> dict[str, bytes]:
    """What is rehearsed, by path relative to the run folder: the plan, what it names, and a program that is an author's."""
    found = {path.name: path.read_bytes() for path in (run.prompt, run.plan) if path.is_file()}
    found |= {posixpath.normpath(name): content for name, content in taken_along.of(run.folder).items()}
    if run.program.is_file():
        present = sha256_file(run.program)
        if not any(e.get("action") == "draft" and e.get("program_sha256") == present for e in run.entries()):
            found |= companions.of(run.program) | {run.program.name: run.program.read_bytes()}
    return dict(sorted(found.items()))


def _digest(files: Mapping[str, bytes]) -> str:
    said = "".join(f"{name}\n{hashlib.sha256(content).hexdigest()}\n" for name, content in files.items())
    return hashlib.sha256(said.encode()).hexdigest()


def _stands(copy: Run, files: Mapping[str, bytes]) -> bool:
    """Whether the last that was begun there was finished, and is of these files."""
    lines = _lines(copy, rehearsed.LAID)
    whole = bool(lines) and lines[-1]["action"] == rehearsed.LAID and copy.plan.is_file()
    return whole and lines[-1].get("of") == _digest(files)


def _lines(copy: Run, *also: str) -> list[dict[str, Any]]:
    return [e for e in copy.entries() if e.get("action") in (rehearsed.ACTION, *also)]


def _names(copy: Run, line: Mapping[str, Any]) -> list[str]:
    said = line.get("files", [])
    if not isinstance(said, list) or not all(isinstance(name, str) for name in said):
        raise _untrue(copy, said)
    return said


def _inside(copy: Run, name: str) -> Path:
    """A file of the copy.

    Raises:
        GateError: it would lie elsewhere.
    """
    said, path = PurePosixPath(name), copy.folder / name
    try:
        inside = path != copy.folder and path.parent.resolve().is_relative_to(copy.folder)
    except (OSError, ValueError, RuntimeError):
        inside = False
    if said.is_absolute() or ".." in said.parts or "\0" in name or path == copy.journal or not inside:
        raise _untrue(copy, name)
    return path


def _untrue(copy: Run, said: object) -> GateError:
    return GateError(
        f"the rehearsal names {said!r} as files of its own, which are none inside it; nothing was removed",
        place=str(copy.journal),
        next_move=f"remove the rehearsal (`worldwright gc {copy.folder.parent}`), then rehearse again",
    )

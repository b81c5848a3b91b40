"""A private copy of an accepted folder, taken once: what is verified is the copy, so nobody can change it between two looks.

Each file is opened once, below open folders and through no link, and copied from that descriptor; hashes, signature, world
and pictures are all of the copied bytes. Of what the stamp does not list only the name is taken, since the name is all that
is ever asked of it.
"""

import errno
import fcntl
import os
import shutil
import stat
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ..model import try_lock
from ..model.errors import GateError
from ..model.evidence.run import Run
from ..model.storage import writing
from .bundle import STAMP, UNLISTED
from .kept import Kept
from .keyring import folder as users_data
from .statement import Statement

BESIDE = ("plan.md", "prompt.md", "journal.jsonl")
"""Files of the run that are held against its stamp; one that is a link stays one in the copy, and leads nowhere."""
NOWHERE = "/dev/null/a-link"
"""Where a link of the folder leads in the copy: what it led to is not the folder's."""
ONCE = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC


@contextmanager
def of(run: Run) -> Iterator[Run]:
    """The copy, as a run of the same name; it is removed at the end, and what killed calls have left is removed before.

    Raises:
        GateError: the accepted folder is a link, or cannot be opened.
        StorageError: there is no room for the copy.
    """
    home, held = _home()
    try:
        with writing("the copy to be verified", home):
            copy = _copied(run, home)
        yield copy
    finally:
        os.close(held)
        shutil.rmtree(home, ignore_errors=True)


def _copied(run: Run, home: Path) -> Run:
    stamped, copy = run.stamped.relative_to(run.folder), home / run.name
    (copy / stamped).mkdir(parents=True)
    if stamped.parts:
        with _opened(run.folder) as top:
            for name in BESIDE:
                if stat.S_ISLNK(_mode(top, name)):
                    (copy / name).symlink_to(NOWHERE)
                else:
                    _take(top, name, copy / name)
    with _opened(run.stamped) as top:
        _all(top, copy / stamped, () if stamped.parts else BESIDE)
    return Run(copy)


def _home() -> tuple[Path, int]:
    """A new folder and its locked descriptor: in the user's data, where no shell of an agent may write, or without those
    in the system's folder for what passes."""
    root = users_data() / "copies"
    try:
        root.mkdir(mode=0o700, parents=True, exist_ok=True)
        with _locked(root):  # a folder that was just made and is not held yet is nobody's leftover
            _sweep(root)
            home = Path(tempfile.mkdtemp(dir=root))
            return home, _lock(home)
    except OSError:
        home = Path(tempfile.mkdtemp(prefix="worldwright-"))
        return home, _lock(home)


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    handle = _lock(folder)
    try:
        yield
    finally:
        os.close(handle)


def _lock(folder: Path) -> int:
    handle = os.open(folder, ONCE | os.O_DIRECTORY)
    fcntl.flock(handle, fcntl.LOCK_EX)
    return handle


def _sweep(root: Path) -> None:
    """Remove the copies that nobody holds any more."""
    for left in root.iterdir():
        with suppress(OSError):
            handle = os.open(left, ONCE | os.O_DIRECTORY)
            try:
                if try_lock.taken(handle):
                    shutil.rmtree(left, ignore_errors=True)
            finally:
                os.close(handle)


@contextmanager
def _opened(folder: Path) -> Iterator[int]:
    """A folder's descriptor; a `GateError` for a link."""
    try:
        handle = os.open(folder, ONCE | os.O_DIRECTORY)
    except OSError as cause:
        raise GateError(
            f"{folder.name}/ is {'a link' if folder.is_symlink() else f'not to be read: {cause.strerror or cause}'}",
            place=str(folder),
            next_move="put the folder itself there, and verify it again",
        ) from cause
    try:
        yield handle
    finally:
        os.close(handle)


def _all(top: int, copy: Path, more: Iterable[str]) -> None:
    """Copy what the stamp lists, the stamp and what belongs to it, and the names of the rest."""
    _take(top, STAMP, copy / STAMP)
    statement = Kept.read(copy / STAMP, Statement).value
    wanted = {*UNLISTED, *more} | ({s.name for s in statement.subject} if statement else set())
    for inside, folders, names, handle in os.fwalk(".", dir_fd=top):
        here = Path(inside)
        for name in (*folders, *names):
            target = copy / here / name
            if not (mode := _mode(handle, name)):  # it went away meanwhile
                continue
            if stat.S_ISDIR(mode):
                target.mkdir(exist_ok=True)
            elif stat.S_ISLNK(mode):
                target.symlink_to(NOWHERE)
            elif (here / name).as_posix() not in wanted:
                target.touch()
            elif (here / name).as_posix() != STAMP:
                _take(handle, name, target)


def _mode(folder: int, name: str) -> int:
    """What a name in an open folder is, a link itself; 0 for nothing."""
    try:
        return os.stat(name, dir_fd=folder, follow_symlinks=False).st_mode
    except FileNotFoundError:
        return 0


def _take(folder: int, name: str, target: Path) -> None:
    """Copy a file from an open folder; what is no plain file, or cannot be read, is not there in the copy."""
    try:
        handle = os.open(name, ONCE, dir_fd=folder)
    except OSError:
        return
    with os.fdopen(handle, "rb") as source:
        told = os.fstat(handle)
        if stat.S_ISREG(told.st_mode):
            if told.st_size > shutil.disk_usage(target.parent).free:  # a file of holes says so before it fills the disk
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), name)
            with target.open("wb") as out:
                shutil.copyfileobj(source, out, 1 << 20)

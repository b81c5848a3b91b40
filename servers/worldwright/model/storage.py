"""Writing where a person keeps their runs: a full disk or a read-only folder is for them to mend, no defect of the suite."""

import errno
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from .errors import GateError, WorldwrightError

FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class StorageError(WorldwrightError):
    """Something could not be written; what stood there before still stands. `code`: `disk_full` or `not_writable`."""

    code = "not_writable"


@contextmanager
def writing(what: str, place: Path) -> Iterator[None]:
    """Turn an `OSError` of the block into a `StorageError` that says what could not be written, why, and what to do."""
    try:
        yield
    except OSError as cause:
        full = cause.errno in FULL
        error = StorageError(
            f"{what} cannot be written: {cause.strerror or cause}; nothing that stood there was changed",
            place=str(cause.filename or place),
            next_move="free some space there, then do it again"
            if full
            else "make the folder writable, or copy the run elsewhere, then do it again",
        )
        error.code = "disk_full" if full else "not_writable"
        raise error from cause


def link_on_the_way(top: Path, path: Path) -> Path | None:
    """The first link between a folder and what lies in it, itself included: what is behind one is not the folder's."""
    inside = path.relative_to(top).parts
    steps = (top.joinpath(*inside[: n + 1]) for n in range(len(inside)))
    return next((step for step in steps if step.is_symlink()), None)


def own(top: Path, path: Path) -> Path:
    """A place in a run folder where evidence is about to be written; refuse (`GateError`) one that a link in the run leads out
    of it: what lies there is somebody else's, to be overwritten by nobody and to prove nothing here."""
    if link := link_on_the_way(top, path):
        raise GateError(
            f"{link.relative_to(top)} is a link: what lies behind it is no evidence of this run",
            place=str(link),
            next_move="put the folder itself there, or remove the link: a folder is made in its place. On another disk: move the "
            "whole run folder",
        )
    return path

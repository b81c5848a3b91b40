"""Writing where a person keeps their runs: a full disk or a read-only folder is for them to mend, no defect of the suite."""

import errno
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from .errors import WorldwrightError

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

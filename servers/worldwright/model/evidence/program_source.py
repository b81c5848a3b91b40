"""The one program of a run: its source and its identity."""

import hashlib
from pathlib import Path

from ..errors import NotFoundError
from ..frozen import Frozen


class Program(Frozen):
    """A simulation program as it stands on disk."""

    path: str
    source: str
    sha256: str

    @classmethod
    def read(cls, path: Path | str) -> "Program":
        """Read a program; an unreadable or non-UTF-8 file is a `NotFoundError` that says why."""
        path = Path(path)
        try:
            data = path.read_bytes()
            source = data.decode()
        except (OSError, UnicodeDecodeError) as cause:
            raise NotFoundError(
                f"the program cannot be read: {cause}",
                place=str(path),
                next_move="write it with `worldwright go RUN`, or save it as UTF-8 text",
            ) from cause
        return cls(path=str(path), source=source, sha256=hashlib.sha256(data).hexdigest())

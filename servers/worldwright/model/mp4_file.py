"""A film is opened only if it is MP4 by its first bytes, by a decoder that is told so and has nothing but the file itself.

Files of other kinds may say of themselves how long they are, or name further files to be read, whatever their ending.
"""

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from .errors import NotFoundError

if TYPE_CHECKING:
    from av.container import InputContainer


class NoFilmError(NotFoundError, ValueError):
    """What is called a film is none."""


@contextmanager
def opened(path: Path) -> Iterator["InputContainer"]:
    """A film of ours, opened to be decoded.

    Raises:
        NoFilmError: it is no MP4 file with one stream of pictures and nothing else, or a link.
    """
    import av

    try:
        handle = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError as cause:
        raise _none(path, cause.strerror or str(cause)) from cause
    with os.fdopen(handle, "rb") as stream:
        if not stat.S_ISREG(os.fstat(handle).st_mode) or stream.read(8)[4:] != b"ftyp":
            raise _none(path, "by its first bytes it is no MP4 file")
        stream.seek(0)
        try:
            film = av.open(stream, mode="r", format="mov")
        except (av.FFmpegError, ValueError) as cause:
            raise _none(path, str(cause)) from cause
        with film:
            if len(film.streams) != 1 or not film.streams.video:
                raise _none(path, f"it holds {len(film.streams)} streams, not pictures alone")
            yield film


def _none(path: Path, why: str) -> NoFilmError:
    return NoFilmError(
        f"there is no film {path.name} to be shown: {why}",
        place=str(path),
        next_move="have it drawn again: `worldwright stage start RUN --stage video --force`",
    )

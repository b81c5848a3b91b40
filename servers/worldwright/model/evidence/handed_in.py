"""A film that the author drew with a renderer of their own and handed in: shown as the author's, and never evidence.

It lies in the run folder as `handed_in.mp4`, `.webm` or `.mov`, where `worldwright hand-in RUN FILE` puts it. Nobody here
drew it and nothing compares it with the recording, so no claim, description or review may rest on it. The stamp lists its
hash as what was handed in.
"""

import hashlib
import io
import os
import stat
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import Field

from ..errors import WorldwrightError
from ..frozen import Frozen

if TYPE_CHECKING:
    from av.container import InputContainer
    from av.video.stream import VideoStream

STEM = "handed_in"
CONTAINERS = {".mp4": "mov", ".webm": "matroska", ".mov": "mov"}
"""How a file of each ending is read, and in no other way: other kinds of film files may name further files to be read."""
NAMES = tuple(f"{STEM}{suffix}" for suffix in CONTAINERS)
MOST_BYTES = 512 << 20
MOST_S = 900.0
MOST_PIXELS = 4096
"""The largest width and height of a picture."""
MOVE = "hand in a film of at most 15 minutes, 512 MB and 4096 pixels a side, as .mp4, .webm or .mov"


class HandedInError(WorldwrightError):
    """What was handed in is no film that can be shown."""

    code = "handed_in"


class HandedIn(Frozen):
    """The author's own film, as the stamp lists it."""

    name: str
    """Of the file in the run folder, and in the accepted one."""
    sha256: str = Field(pattern=r"^[0-9a-f]{64}$")
    seconds: float
    size: tuple[int, int]
    """Width and height of its pictures, pixels."""


def find(folder: Path) -> Path | None:
    """The film that was handed in to a run, whatever it is; None where there is none.

    Raises:
        HandedInError: there are several.
    """
    found = [folder / name for name in NAMES if os.path.lexists(folder / name)]
    if len(found) > 1:
        raise HandedInError(
            f"two films are handed in: {found[0].name} and {found[1].name}",
            place=str(folder),
            next_move="remove one of them, or hand in another: worldwright hand-in RUN FILE",
        )
    return found[0] if found else None


def of(folder: Path) -> HandedIn | None:
    """What was handed in to a run, looked at; None where nothing was.

    Raises:
        HandedInError: it is no film that can be shown, or there are several.
    """
    path = find(folder)
    return None if path is None else looked_at(path, content(path))


def sha256(folder: Path) -> str:
    """The hash of the film that was handed in to a run, which is not looked at; empty where nothing was.

    Raises:
        HandedInError: it is no plain file, is too large or cannot be read, or there are several.
    """
    path = find(folder)
    return "" if path is None else hashlib.sha256(content(path)).hexdigest()


def content(path: Path, *, linked: bool = False) -> bytes:
    """The bytes of a film's file; `linked` lets it have several names, and links lead to it, as a person's own file may.

    Raises:
        HandedInError: it is no plain file (a pipe, a folder), or none with one name; it is too large, or cannot be read.
    """
    once = 0 if linked else os.O_NOFOLLOW
    try:
        # A pipe would wait for its writer for ever without O_NONBLOCK.
        handle = os.open(path, os.O_RDONLY | once | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError as cause:
        why = "it is a link" if once and path.is_symlink() else cause.strerror or str(cause)
        raise _refuse(path, f"the film cannot be read: {why}") from cause
    facts = os.fstat(handle)
    plain = stat.S_ISREG(facts.st_mode) and (linked or facts.st_nlink == 1)
    if not plain or facts.st_size > MOST_BYTES:
        os.close(handle)
        large = f"the film has {facts.st_size / 1e6:.0f} MB, and at most {MOST_BYTES >> 20} are taken"
        raise _refuse(path, large if plain else "the film is no plain file with one name")
    with os.fdopen(handle, "rb") as stream:
        return stream.read(MOST_BYTES)


def looked_at(path: Path, data: bytes) -> HandedIn:
    """What a film's bytes are: its first picture is decoded, and its length read.

    Raises:
        HandedInError: they are no film that can be shown.
    """
    import av

    suffix = path.suffix.lower()
    if suffix not in CONTAINERS:
        raise _refuse(path, f"a film has the ending {', '.join(CONTAINERS)}, not {suffix!r}")
    try:
        with av.open(io.BytesIO(data), mode="r", format=CONTAINERS[suffix]) as film:
            stream = film.streams.video[0]
            if stream.codec_context is None:  # nothing installed decodes it
                raise _refuse(path, "its pictures are in a form that cannot be read here")
            size = (int(stream.width), int(stream.height))
            if not 0 < min(size) <= max(size) <= MOST_PIXELS:
                raise _refuse(path, f"its pictures have {size[0]}x{size[1]} pixels")
            next(film.decode(stream))
            seconds = _length(film, stream)
    except (av.FFmpegError, IndexError, StopIteration, ValueError) as cause:
        raise _refuse(path, f"the file is no film: {cause or 'it has no picture'}") from cause
    if not 0.0 < seconds <= MOST_S:
        raise _refuse(path, f"it lasts {seconds:.4g} s")
    return HandedIn(
        name=f"{STEM}{suffix}", sha256=hashlib.sha256(data).hexdigest(), seconds=round(seconds, 3), size=size
    )


def _length(film: "InputContainer", stream: "VideoStream") -> float:
    """How long a film lasts, s: what it says, or else, in one that a browser recorded, where its last picture ends."""
    import av

    if film.duration:
        return float(film.duration / av.time_base)
    if stream.time_base is None:
        return 0.0
    ends = [p.pts + (p.duration or 0) for p in film.demux(stream) if p.pts is not None]
    return float(max(ends, default=0) * stream.time_base)


def _refuse(path: Path, cause: str) -> HandedInError:
    return HandedInError(cause, place=str(path), next_move=MOVE)

"""What a judge is shown of a film: frames spread evenly over it, the same on one contact sheet, or the film itself.

Nothing else of the film goes along: its name, its tags and its place on the disk stay here. The frames' hashes are the record's.
"""

import hashlib
import io
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal, get_args

from ..model.errors import WorldwrightError
from ..model.mp4_file import NoFilmError, opened

if TYPE_CHECKING:
    import numpy as np

Form = Literal["frames", "sheet", "film"]
FORMS: tuple[Form, ...] = get_args(Form)
FRAMES = 8
"""As many as the benchmark's own protocol samples."""
MOST_FRAMES, LONGEST_FILM, MOST_PIXELS = 64, 100_000, 4096 * 4096
WIDTH = 512
"""Frames are shown at most so wide, pixels: a picture costs a model by its area."""
COLUMNS = 4


class ExhibitError(WorldwrightError):
    """A film cannot be shown to a judge; `code`: `no_film`, `too_short` or `too_large`."""

    def __init__(self, cause: str, *, code: str, place: str, next_move: str = "give an MP4 of pictures alone") -> None:
        super().__init__(cause, place=place, next_move=next_move)
        self.code = code


@dataclass(frozen=True)
class Piece:
    """One picture, or the film, as it is sent."""

    media_type: str
    data: bytes

    @property
    def sha256(self) -> str:
        """Of its bytes."""
        return hashlib.sha256(self.data).hexdigest()


@dataclass(frozen=True)
class Exhibit:
    """What is shown of one film."""

    form: Form
    pieces: tuple[Piece, ...]
    frames: int
    """Frames that are seen; of a film, all of them."""

    @property
    def sha256(self) -> str:
        """Over the hashes of all pieces, in order."""
        return hashlib.sha256("".join(piece.sha256 for piece in self.pieces).encode()).hexdigest()

    @property
    def told(self) -> str:
        """What it is, in the words of the question."""
        if self.form == "film":
            return "a film"
        if self.form == "sheet":
            return (
                f"one sheet of {self.frames} numbered pictures of a film, spread evenly from its first to its last "
                "frame, to be read row by row from the upper left"
            )
        return f"{self.frames} pictures of a film, spread evenly from its first to its last frame, in order"


def exhibit(film: Path, form: Form, frames: int = FRAMES) -> Exhibit:
    """Make of a film what a judge is shown.

    Args:
        film: an MP4 file with one stream of pictures.
        frames: how many are shown, 2 to 64; of a whole film it has no meaning.

    Raises:
        ExhibitError: it is no such film, breaks off, has one frame only, or is too large.
    """
    if form == "film":
        data, count = _bare(film)
        return Exhibit(form, (Piece("video/mp4", data),), count)
    return drawn(_sampled(film, frames), form)


def drawn(pictures: "list[np.ndarray]", form: Form) -> Exhibit:
    """An exhibit of frames: uint8 (H, W, 3) RGB, all of one size."""
    import cv2

    from worldengine.film.picture_grid import labelled, laid_out

    if form == "sheet":
        numbered = [labelled(picture, str(number)) for number, picture in enumerate(pictures, 1)]
        return Exhibit(form, (Piece("image/jpeg", laid_out(numbered, COLUMNS)),), len(pictures))
    coded = [cv2.imencode(".jpg", p[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, 90])[1].tobytes() for p in pictures]
    return Exhibit(form, tuple(Piece("image/jpeg", one) for one in coded), len(coded))


def _sampled(film: Path, frames: int) -> "list[np.ndarray]":
    """The frames that are shown, in order; first and last among them."""
    import av

    if not 2 <= frames <= MOST_FRAMES:
        raise ExhibitError(
            f"{frames} frames cannot be shown", code="too_large", place=str(film), next_move=f"2 to {MOST_FRAMES}"
        )
    total = _length(film)
    if total < 2:
        raise ExhibitError("it has one frame only, in which nothing happens", code="too_short", place=str(film))
    wanted = {round(number * (total - 1) / (min(frames, total) - 1)) for number in range(min(frames, total))}
    found = []
    try:
        with opened(film) as container:
            for number, frame in enumerate(container.decode(video=0)):
                if number in wanted:
                    found.append(_narrowed(frame.to_ndarray(format="rgb24")))
    except (av.FFmpegError, NoFilmError) as cause:
        raise ExhibitError(f"it cannot be decoded: {_first(cause)}", code="no_film", place=str(film)) from cause
    if len(found) != len(wanted):
        raise _broken(film)
    return found


def _length(film: Path) -> int:
    import av

    try:
        with opened(film) as container:
            picture = container.streams.video[0]
            if picture.width * picture.height > MOST_PIXELS:
                raise ExhibitError(
                    f"its frames are {picture.width} x {picture.height} pixels", code="too_large", place=str(film)
                )
            count = 0
            for packet in container.demux(picture):
                count += bool(packet.size)
                if count > LONGEST_FILM:
                    raise ExhibitError(f"it has more than {LONGEST_FILM} frames", code="too_large", place=str(film))
            if count == 0 or picture.frames > count:  # what its index lists is not all there
                raise _broken(film)
            return count
    except (av.FFmpegError, NoFilmError) as cause:
        raise ExhibitError(f"it is no film: {_first(cause)}", code="no_film", place=str(film)) from cause


def _bare(film: Path) -> tuple[bytes, int]:
    """The film's pictures as they are coded, in a new file without its tags, and how many there are."""
    import av

    if (total := _length(film)) < 2:
        raise ExhibitError("it has one frame only, in which nothing happens", code="too_short", place=str(film))
    written = io.BytesIO()
    try:
        with opened(film) as source, av.open(written, "w", format="mp4") as target:
            given = source.streams.video[0]
            stream = target.add_stream_from_template(given)
            stream.metadata.clear()
            for packet in source.demux(given):
                if packet.dts is not None:
                    packet.stream = stream
                    target.mux(packet)
    except (av.FFmpegError, NoFilmError, ValueError) as cause:
        raise ExhibitError(f"it cannot be copied: {_first(cause)}", code="no_film", place=str(film)) from cause
    return written.getvalue(), total


def _narrowed(picture: "np.ndarray") -> "np.ndarray":
    import cv2

    height, width, _ = picture.shape
    if width <= WIDTH:
        return picture
    return cv2.resize(picture, (WIDTH, max(1, round(height * WIDTH / width))), interpolation=cv2.INTER_AREA)


def _broken(film: Path) -> ExhibitError:
    return ExhibitError("it breaks off before its end", code="no_film", place=str(film))


def _first(cause: Exception) -> str:
    return str(getattr(cause, "cause", cause)).splitlines()[0]

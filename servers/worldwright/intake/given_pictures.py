"""Pictures that are given to a server: read bounded, and cut from a plain ground in a process that is confined."""

import sys
import tempfile
from pathlib import Path

from worldkit.errors import IntakeError
from worldkit.intake import declared_sizes

from ..model.errors import NotFoundError
from ..stage import confined, plain
from .refusing import IntakeFailedError

MOST_PICTURE = 16 << 20
SECONDS, MEMORY_MB = 60.0, 3072


def read(path: Path) -> bytes:
    """A PNG or JPEG.

    Raises:
        NotFoundError: there is no such file.
        IntakeFailedError: it is no picture, or larger than may be.
    """
    if not path.is_file():
        raise NotFoundError("there is no such picture", place=str(path), next_move="give the path of a PNG or JPEG")
    with path.open("rb") as file:
        data = file.read(MOST_PICTURE + 1)
    if not is_one(data, path.name):
        raise IntakeFailedError(
            f"it is no PNG or JPEG of at most {MOST_PICTURE >> 20} MB and {declared_sizes.MOST_PIXELS} pixels a side", code="no_picture", place=str(path),
            next_move="save it as PNG or JPEG, smaller",
        )  # fmt: skip
    return data


def is_one(data: bytes, name: str) -> bool:
    """Whether bytes begin as a PNG or JPEG of sides that may be."""
    try:
        return len(data) <= MOST_PICTURE and declared_sizes.picture(data[: declared_sizes.HEADER_BYTES], name) != (0, 0)
    except IntakeError:  # more pixels than may be decoded
        return False


def cut(data: bytes) -> tuple[bytes, str]:
    """The picture with its ground cut away, and what was done; as it is where its ground is not plain.

    Raises:
        IntakeFailedError: it cannot be decoded within bounds.
    """
    with tempfile.TemporaryDirectory(prefix="worldwright-picture-") as folder:
        file = Path(folder) / "picture"
        file.write_bytes(data)
        call = [sys.executable, "-s", "-P", "-m", "worldkit.intake.cut_out", str(file), "{out}"]
        ended = confined.run(
            call, reads=(file,), wanted=("cut.png", "result.json"), wall_s=SECONDS, memory_mb=MEMORY_MB, file_mb=64
        )
    told = plain.as_object(ended.files.get("result.json", b""))
    if ended.status != "ended" or not told.get("ok"):
        raise IntakeFailedError(
            f"the picture cannot be decoded: {told.get('why') or ended.status}", code="no_picture", place="the picture",
            next_move="save it anew as PNG or JPEG; with --no-cut it is sent as it is",
        )  # fmt: skip
    return ended.files.get("cut.png", data), str(told.get("why", ""))[:100]

"""Pictures and videos small enough to live inside a page."""

import base64
import hashlib
from pathlib import Path
from typing import Any

from ..model import mp4_file

BUDGET = 20 * 2**20
"""Bytes of video that one page may carry; above that, videos are encoded again, smaller."""
SHOWN = {".mp4": "video/mp4", ".webm": "video/webm"}
"""What browsers show, by its ending."""
SMALL = (640, 30)
"""Width in pixels and quality (constant rate factor) of what is encoded again."""


def data_uri(data: bytes, mime: str) -> str:
    """The bytes as a data URI."""
    return f"data:{mime};base64,{base64.b64encode(data).decode()}"


def still(path: Path, width: int = 1280, quality: int = 84) -> str | None:
    """A picture file as a WebP data URI no wider than `width`; None when it cannot be read."""
    import cv2

    try:
        image = cv2.imread(str(path), cv2.IMREAD_COLOR)
    except cv2.error:
        return None
    return None if image is None else encode(image, width, quality)


def picture(data: bytes, width: int = 1600) -> str | None:
    """An encoded picture as a WebP data URI without loss, as wide as layouts are drawn; None when it cannot be read.

    A drawing that is made smaller has no even colour left: it takes eight times as long to write and more room.
    """
    import cv2
    import numpy as np

    try:
        image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)
    except cv2.error:
        return None
    return None if image is None else encode(image, width, 101)


def encode(image: Any, width: int, quality: int) -> str:
    """Pixels, uint8 (H, W, 3) BGR, as a WebP data URI; a quality above 100 is lossless."""
    import cv2

    if image.shape[1] > width:
        height = round(image.shape[0] * width / image.shape[1])
        image = cv2.resize(image, (width, height), interpolation=cv2.INTER_AREA)
    _, data = cv2.imencode(".webp", image, [cv2.IMWRITE_WEBP_QUALITY, quality])
    return data_uri(data.tobytes(), "image/webp")


def videos(paths: dict[str, Path]) -> dict[str, str]:
    """Videos as data URIs, encoded again when together they are over the budget; unreadable ones are left out."""
    sizes = {}
    for name, path in paths.items():
        try:
            sizes[name] = path.stat().st_size
        except OSError:
            continue
    too_much = sum(sizes.values()) > BUDGET
    found: dict[str, str] = {}
    for name in sizes:
        try:
            data = _smaller(paths[name]) if too_much else paths[name].read_bytes()
        except (OSError, ValueError):
            continue
        if data and sum(map(len, found.values())) + len(data) <= 2 * BUDGET:
            found[name] = data_uri(data, "video/mp4")
    return found


def handed_in(path: Path, sha256: str) -> str:
    """A film of this hash as a data URI; empty if it is another, too large for a page, or no browser's, and the page names the
    file."""
    if path.suffix not in SHOWN:
        return ""
    try:
        data = path.read_bytes() if path.stat().st_size <= BUDGET // 2 else b""
    except OSError:
        return ""
    return data_uri(data, SHOWN[path.suffix]) if hashlib.sha256(data).hexdigest() == sha256 else ""


def frames(path: Path, count: int = 6, width: int = 320) -> list[tuple[float, str]]:
    """Evenly spaced frames of a video: (time in s, data URI); empty when it cannot be read."""
    import av

    try:
        with mp4_file.opened(path) as container:
            stream = container.streams.video[0]
            total = stream.frames or sum(1 for _ in container.decode(stream))
            container.seek(0)
            chosen = {round(i * (total - 1) / max(1, count - 1)) for i in range(count)}
            return [
                (float(frame.time or 0.0), encode(frame.to_ndarray(format="bgr24"), width, 78))
                for i, frame in enumerate(container.decode(stream))
                if i in chosen
            ]
    except (OSError, ValueError, IndexError, av.FFmpegError):
        return []


def _smaller(path: Path) -> bytes:
    """The video, encoded again at the size and quality of `SMALL`."""
    import io

    import av

    width, quality = SMALL
    target = io.BytesIO()
    try:
        with mp4_file.opened(path) as source, av.open(target, "w", format="mp4") as made:
            stream = source.streams.video[0]
            height = 2 * round(stream.height * width / stream.width / 2)
            out = made.add_stream("libx264", rate=stream.average_rate or 24)
            out.width, out.height, out.pix_fmt = width, height, "yuv420p"
            out.options = {"crf": str(quality), "preset": "fast"}
            for frame in source.decode(stream):
                made.mux(out.encode(frame.reformat(width, height, "yuv420p")))
            made.mux(out.encode())
    except (av.FFmpegError, IndexError) as cause:
        raise ValueError(f"{path.name} cannot be encoded again: {cause}") from cause
    return target.getvalue()

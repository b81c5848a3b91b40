"""One small picture of an accepted world, for a page or a README: `poster.webp`.

It shows the author's film at the moment when half of all motion has happened; where there is none, that of the plan's first
camera, or that camera's still where nothing was filmed.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from worldkit.files import write_atomic

from ..model import mp4_file
from . import digest

NAME = "poster.webp"
FILM = "film"
WIDTH = 640
"""Pixels."""
BYTES = 60_000
"""No poster is larger."""
QUALITIES = (90, 82, 74, 66, 56, 45, 30, 15)


def write(accepted: Path, cameras: Sequence[str], shots: Sequence[Mapping[str, Any]] = ()) -> Path | None:
    """Write the poster of an assembled accepted folder; None when it holds no picture that can be read.

    Args:
        accepted: holds `stills/`, `video/` and the sampled motion.
        cameras: the plan's cameras, in its order.
        shots: of the author's film, as `Filmed.shots`.
    """
    found, at_s = _by_camera(accepted, cameras), moment(accepted)
    times = [filmed(shots, at_s) if path.stem == FILM else at_s for path in found]
    image = next((i for path, t in zip(found, times, strict=True) if (i := _picture(path, t)) is not None), None)
    data = None if image is None else _encoded(image)
    if data is None:
        return None
    path = accepted / NAME
    write_atomic(path, data)
    return path


def _by_camera(accepted: Path, cameras: Sequence[str]) -> list[Path]:
    """Films before stills; the author's film first, of each the rest in the order of the cameras."""

    def rank(path: Path) -> int:
        return -1 if path.stem == FILM else cameras.index(path.stem) if path.stem in cameras else len(cameras)

    films, stills = (accepted / "video").glob("*.mp4"), (accepted / "stills").glob("*.png")
    return [*sorted(films, key=rank), *sorted(stills, key=rank)]


def filmed(shots: Sequence[Mapping[str, Any]], at_s: float) -> float:
    """When the author's film first shows the recorded moment `at_s`, s of the film; its middle where it never does."""
    for shot in shots:
        low, high = sorted((float(shot["from_s"]), float(shot["to_s"])))
        if low <= at_s <= high and high > low:
            return float(shot["film_s"] + shot["seconds"] * (at_s - shot["from_s"]) / (shot["to_s"] - shot["from_s"]))
    return float(shots[-1]["film_s"] + shots[-1]["seconds"]) / 2 if shots else 0.0


def moment(accepted: Path) -> float:
    """Time, in seconds, at which half of the way that all bodies of an accepted folder travel lies behind them."""
    import numpy as np

    try:
        motion = digest.Motion.model_validate_json((accepted / digest.NAME).read_bytes())
    except (OSError, ValueError):
        return 0.0
    travelled = np.asarray(motion.travelled_m, dtype=float).reshape(len(motion.time_s), -1).sum(axis=1)
    return float(motion.time_s[int(np.searchsorted(travelled, travelled[-1] / 2))]) if len(travelled) else 0.0


def _picture(path: Path, time_s: float) -> Any:
    """Pixels, uint8 (H, W, 3) BGR: a still, or the frame of a film at `time_s`; None when it cannot be read."""
    import av
    import cv2

    if path.suffix == ".png":
        return cv2.imread(str(path), cv2.IMREAD_COLOR)
    frame = None
    try:
        with mp4_file.opened(path) as container:
            for frame in container.decode(video=0):
                if float(frame.time or 0.0) >= time_s:
                    break
    except (OSError, ValueError, IndexError, av.FFmpegError):
        return None
    return None if frame is None else frame.to_ndarray(format="bgr24")


def _encoded(image: Any) -> bytes | None:
    """The picture as WebP, as good as `BYTES` allows."""
    import cv2

    height = round(image.shape[0] * WIDTH / image.shape[1])
    small = cv2.resize(image, (WIDTH, height), interpolation=cv2.INTER_AREA)
    for quality in QUALITIES:
        data = cv2.imencode(".webp", small, [cv2.IMWRITE_WEBP_QUALITY, quality])[1].tobytes()
        if len(data) <= BYTES:
            return data
    return None

"""Stills and film frames as small pictures for people and models: together under 1 MB."""

from pathlib import Path
from typing import Any

from ..model.errors import NotFoundError
from ..model.frozen import Frozen
from ..model.picture import Illustrated, Picture

BUDGET_BYTES = 700_000
"""Base64 adds a third on the wire."""


class Shown(Frozen):
    """What the pictures are."""

    cameras: tuple[str, ...]
    captions: tuple[str, ...]

    def text(self) -> str:
        """One caption a line."""
        return "\n".join(self.captions)


def contact(evidence: Path, camera: str | None, count: int) -> Illustrated:
    """Pictures of one key's stills and films, scaled down until they fit the budget."""
    known = sorted({p.stem for p in (*evidence.glob("stills/*.png"), *evidence.glob("video/*.mp4"))})
    if camera is not None and camera not in known:
        raise NotFoundError(
            f"there are no pictures of a camera '{camera}'" if known else "nothing has been filmed for this program",
            place=str(evidence),
            next_move=f"cameras: {', '.join(known) or '(none yet: run the stills pass)'}",
        )
    if not known:
        raise NotFoundError(
            "nothing has been filmed for this program and plan",
            place=str(evidence),
            next_move="run the stills pass, then the video pass",
        )
    cameras = [camera] if camera else known
    images: list[tuple[str, Any]] = []
    for name in cameras:
        still = evidence / "stills" / f"{name}.png"
        if still.is_file():
            images.append((f"{name}: still at 0.00 s", _read(still)))
        film = evidence / "video" / f"{name}.mp4"
        if film.is_file():
            images += [(f"{name}: film at {time_s:.2f} s", image) for time_s, image in moments(film, count)]
    share = BUDGET_BYTES // len(images)
    pictures = tuple(Picture(_jpeg(image, share), caption, "jpeg") for caption, image in images)
    return Illustrated(Shown(cameras=tuple(cameras), captions=tuple(p.caption for p in pictures)), pictures)


def moments(film: Path, count: int) -> list[tuple[float, Any]]:
    """(time in seconds, RGB uint8 (H, W, 3)) at `count` evenly spread moments, the last frame included."""
    import av

    with av.open(str(film)) as container:
        stream = container.streams.video[0]
        total = stream.frames or sum(1 for _ in container.decode(stream))
        wanted = {round((i + 1) * (total - 1) / count) for i in range(count)}
        container.seek(0)
        found = []
        for index, frame in enumerate(container.decode(stream)):
            if index in wanted:
                found.append((float(frame.time or 0.0), frame.to_ndarray(format="rgb24")))
    return found


def _read(path: Path) -> Any:
    import cv2

    image = cv2.imread(str(path), cv2.IMREAD_COLOR)
    if image is None:
        raise NotFoundError("the picture cannot be read", place=str(path), next_move="run the stills pass with force")
    return cv2.cvtColor(image, cv2.COLOR_BGR2RGB)


def _jpeg(image: Any, budget: int) -> bytes:
    """JPEG of at most `budget` bytes: first half the quality, then half the size."""
    import cv2

    picture = cv2.cvtColor(image, cv2.COLOR_RGB2BGR)
    width = min(960, picture.shape[1])
    while True:
        small = cv2.resize(
            picture, (width, round(picture.shape[0] * width / picture.shape[1])), interpolation=cv2.INTER_AREA
        )
        for quality in (88, 75, 60):
            data = cv2.imencode(".jpg", small, [cv2.IMWRITE_JPEG_QUALITY, quality])[1].tobytes()
            if len(data) <= budget or width <= 160:
                return data
        width = int(width * 0.75)

"""Stills, contact sheets and key frames as small pictures for people and models: together under 1 MB."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from ..model import mp4_file
from ..model.errors import NotFoundError
from ..model.frozen import Frozen
from ..model.picture import Illustrated, Picture

if TYPE_CHECKING:
    from .moments import Moments

BUDGET_BYTES = 700_000
"""Base64 adds a third on the wire."""
COLUMNS, CELL_WIDTH = 4, 320
LARGE_COLUMNS, LARGE_CELL_WIDTH = 3, 428
"""Columns and cell width (pixels) of the sheet of a single camera."""
Show = Literal["all", "stills", "sheet", "key"]


class Shown(Frozen):
    """The captions and times of the pictures."""

    cameras: tuple[str, ...]
    captions: tuple[str, ...]
    moments: dict[str, float] = {}
    """Times of the key frames, s, by the motion energy of the recording (or of the film without one)."""

    def text(self) -> str:
        """The captions, one per line."""
        return "\n".join(self.captions)


def contact(
    evidence: Path,
    camera: str | None,
    count: int,
    show: Show = "all",
    window_s: tuple[float, float] = (0.0, 1e9),
) -> Illustrated:
    """Pictures of one key's stills and films, scaled down until they fit the budget.

    Args:
        evidence: the folder of one key.
        camera: one camera; all when None.
        count: number of pictures on a contact sheet; a single one is shown as large as possible.
        show: which kinds.
        window_s: the stretch of a film that its contact sheet shows, s.
    """
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
    films = [film for name in cameras if (film := evidence / "video" / f"{name}.mp4").is_file()]
    three = _moments(evidence, films) if films and show in ("all", "key") else None
    images = list(_images(evidence, cameras, count, show, three, window_s))
    if not images:
        raise NotFoundError(
            "there is no film yet", place=str(evidence / "video"), next_move="run the video pass, or show stills"
        )
    share = BUDGET_BYTES // len(images)
    pictures = tuple(Picture(jpeg(image, share), caption, "jpeg") for caption, image in images)
    times = three.named() if three else {}
    return Illustrated(
        Shown(cameras=tuple(cameras), captions=tuple(p.caption for p in pictures), moments=times), pictures
    )


def beside(reference: Path, evidence: Path, camera: str) -> Illustrated:
    """The person's image on the left and the still of one camera on the right, at the same height.

    Raises:
        NotFoundError: there is no image, or no still of that camera.
    """
    import cv2
    import numpy as np

    still = evidence / "stills" / f"{camera}.png"
    for path, remedy in ((reference, "this run was made from words alone"), (still, "run the stills pass")):
        if not path.is_file():
            raise NotFoundError(f"there is no {path.name} to show", place=str(path), next_move=remedy)
    left, right = _read(reference), _read(still)
    width = round(left.shape[1] * right.shape[0] / left.shape[0])
    left = cv2.resize(left, (width, right.shape[0]), interpolation=cv2.INTER_AREA)
    gap = np.full((right.shape[0], 8, 3), 255, np.uint8)
    caption = f"{reference.name}, as it was given, beside {camera}: still at 0.00 s"
    picture = Picture(jpeg(np.hstack([left, gap, right]), BUDGET_BYTES), caption, "jpeg")
    return Illustrated(Shown(cameras=(camera,), captions=(caption,)), (picture,))


def _moments(evidence: Path, films: list[Path]) -> "Moments":
    from . import moments

    recording = evidence / "physics" / "trajectory"
    if (recording / "complete.json").is_file():
        return moments.of_recording(recording)
    return moments.of_film(films[0])


def _images(
    evidence: Path,
    cameras: list[str],
    count: int,
    show: Show,
    three: "Moments | None",
    window_s: tuple[float, float],
) -> Iterator[tuple[str, Any]]:
    """(caption, RGB uint8 (H, W, 3)) of every wanted picture that exists."""
    for name in cameras:
        still = evidence / "stills" / f"{name}.png"
        if show in ("all", "stills") and still.is_file():
            yield f"{name}: still at 0.00 s", _read(still)
        film = evidence / "video" / f"{name}.mp4"
        if not film.is_file():
            continue
        if show in ("all", "sheet"):
            frames = moments(film, count, window_s)
            if len(frames) == 1:
                yield f"{name}: at {frames[0][0]:.2f} s", frames[0][1]
            else:
                stamps = ", ".join(f"{time_s:.2f}" for time_s, _ in frames)
                yield f"{name}: contact sheet, row by row, at {stamps} s", sheet(frames, large=len(cameras) == 1)
        if three and show in ("all", "key") and name != "film":  # its times are not the recording's
            named = three.named()
            if show == "all" and still.is_file():
                del named["setup"]  # the still shows it better
            for word, (time_s, image) in zip(named, at(film, list(named.values())), strict=True):
                yield f"{name}: {word} at {time_s:.2f} s", image


def moments(film: Path, count: int, window_s: tuple[float, float] = (0.0, 1e9)) -> list[tuple[float, Any]]:
    """(time in seconds, RGB uint8 (H, W, 3)) at `count` evenly spread moments of a window, its ends included."""
    with mp4_file.opened(film) as container:
        stream = container.streams.video[0]
        total = stream.frames or sum(1 for _ in container.decode(stream))
        rate = float(stream.average_rate or 24)
    first, last = (min(max(round(time_s * rate), 0), total - 1) for time_s in window_s)
    count = min(count, last - first + 1)
    return at(film, [round(first + i * (last - first) / max(count - 1, 1)) / rate for i in range(count)])


def at(film: Path, times_s: list[float]) -> list[tuple[float, Any]]:
    """(time in seconds, RGB uint8 (H, W, 3)) of the frames nearest to some ascending times, one for each."""
    found: list[tuple[float, Any]] = []
    with mp4_file.opened(film) as container:
        last = None
        for frame in container.decode(video=0):
            while len(found) < len(times_s) and float(frame.time or 0.0) >= times_s[len(found)] - 1e-3:
                found.append((float(frame.time or 0.0), frame.to_ndarray(format="rgb24")))
            last = frame
            if len(found) == len(times_s):
                break
        while last is not None and len(found) < len(times_s):
            found.append((float(last.time or 0.0), last.to_ndarray(format="rgb24")))
    return found


def sheet(frames: list[tuple[float, Any]], large: bool = False) -> Any:
    """Frames on one picture, row by row, each with its time in a corner: RGB uint8."""
    import cv2
    import numpy as np

    most, cell_width = (LARGE_COLUMNS, LARGE_CELL_WIDTH) if large else (COLUMNS, CELL_WIDTH)
    height = round(frames[0][1].shape[0] * cell_width / frames[0][1].shape[1])
    columns = min(most, len(frames))
    rows = -(-len(frames) // columns)
    page = np.full((rows * (height + 4) + 4, columns * (cell_width + 4) + 4, 3), 255, np.uint8)
    for index, (time_s, image) in enumerate(frames):
        cell = cv2.resize(image, (cell_width, height), interpolation=cv2.INTER_AREA)
        label, font = f"{time_s:.2f} s", cv2.FONT_HERSHEY_SIMPLEX
        (width, tall), _ = cv2.getTextSize(label, font, 0.45, 1)
        cv2.rectangle(cell, (4, 4), (12 + width, 14 + tall), (255, 255, 255), -1)
        cv2.putText(cell, label, (8, 9 + tall), font, 0.45, (20, 20, 20), 1, cv2.LINE_AA)
        top, left = 4 + index // columns * (height + 4), 4 + index % columns * (cell_width + 4)
        page[top : top + height, left : left + cell_width] = cell
    return page


def _read(path: Path) -> Any:
    import cv2

    image = cv2.imread(str(path), cv2.IMREAD_COLOR)
    if image is None:
        raise NotFoundError("the picture cannot be read", place=str(path), next_move="run the stills pass with force")
    return cv2.cvtColor(image, cv2.COLOR_BGR2RGB)


def jpeg(image: Any, budget: int) -> bytes:
    """JPEG of at most `budget` bytes: first a lower quality, then a smaller size."""
    import cv2

    picture = cv2.cvtColor(image, cv2.COLOR_RGB2BGR)
    width = min(COLUMNS * (CELL_WIDTH + 4) + 4, picture.shape[1])
    while True:
        small = cv2.resize(
            picture, (width, round(picture.shape[0] * width / picture.shape[1])), interpolation=cv2.INTER_AREA
        )
        for quality in (88, 75, 60):
            data = cv2.imencode(".jpg", small, [cv2.IMWRITE_JPEG_QUALITY, quality])[1].tobytes()
            if len(data) <= budget or width <= 160:
                return data
        width = int(width * 0.75)

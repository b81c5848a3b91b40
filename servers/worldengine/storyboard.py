"""Draw the storyboard: a few recorded moments through every camera, small, on one sheet per camera.

People look at it before the real pictures are drawn: does it happen, and is it in the picture?
"""

import argparse
import sys
import time
from typing import TYPE_CHECKING, Any

from worldkit.files import write_atomic, write_json

if TYPE_CHECKING:
    import numpy as np

    from .given import Given

WIDTH = 480
"""The width of one picture, pixels."""
COLUMNS, GAP, QUALITY = 3, 4, 85


def run(given: "Given", options: argparse.Namespace) -> None:
    """Draw the recording `options.recording` at the moments `options.moments` (`SECONDS:WORD`) into `options.out`.

    Raises:
        WorldkitError: the recording is of another world, or cannot be read; there is no such camera.
    """
    from worldkit import cameras
    from worldkit.reporting import Progress

    from .film.drawn_frames import Frames
    from .film.light_meter import reading
    from .film.passes import choose_cameras, headless_gl
    from .recording import stored
    from .recording.replay import Replay

    headless_gl()
    started = time.perf_counter()
    recording, model = stored.open(options.recording), given.model()
    moments = sorted((float(at), word) for at, _, word in (text.partition(":") for text in options.moments)) or [
        (0.0, "")
    ]
    names = choose_cameras(model, options.cameras)
    replay = Replay(model, recording)
    size = WIDTH, round(WIDTH * given.size[1] / given.size[0])
    cameras.aim(model, recording.pos, orientations=recording.quat, aspect=size[0] / size[1])
    tick = Progress(options.out, len(names) * len(moments), "pictures")
    cells: dict[str, list[np.ndarray]] = {name: [] for name in names}
    readings: dict[str, list[dict[str, Any]]] = {name: [] for name in names}
    with Frames(model, *size) as frames:
        for at, word in moments:
            data = replay.show(_row(recording.time, at))
            cameras.track(model, data)
            for name in names:
                image = frames.image(data, name, quality="video")
                readings[name].append(reading(model, image, frames.segmentation(data, name), given.movers))
                cells[name].append(labelled(image, f"{word} {at:.2f} s".strip()))
                tick(sum(map(len, cells.values())))
        renderer = frames.told()
    for name, pictures in cells.items():
        write_atomic(options.out / f"{name}.jpg", laid_out(pictures))
    told: dict[str, Any] = {
        "cameras": names,
        "moments": [[at, word] for at, word in moments],
        "size": list(size),
        "renderer": renderer,
    }
    told["readings"] = readings
    wall = round(time.perf_counter() - started, 3)
    result = {"ok": True, "pass": "storyboard", **told, "trajectory_sha256": recording.sha256, "wall_s": wall}
    write_json(options.out / "result.json", result)
    sys.stdout.write(f"{len(moments)} moments through {', '.join(names)} in {wall:.1f} s\n")


def _row(times: "np.ndarray", at: float) -> int:
    """The recorded row nearest to a moment, s."""
    import numpy as np

    return int(np.abs(times[:] - at).argmin())


def labelled(image: "np.ndarray", label: str) -> "np.ndarray":
    """Write words in the upper left corner of a picture: uint8 (H, W, 3) RGB."""
    import cv2

    image, font = image.copy(), cv2.FONT_HERSHEY_SIMPLEX
    (width, height), _ = cv2.getTextSize(label, font, 0.5, 1)
    cv2.rectangle(image, (4, 4), (12 + width, 14 + height), (255, 255, 255), -1)
    cv2.putText(image, label, (8, 9 + height), font, 0.5, (20, 20, 20), 1, cv2.LINE_AA)
    return image


def laid_out(pictures: "list[np.ndarray]", most: int = COLUMNS) -> bytes:
    """Lay pictures of one size row by row on white, as a JPEG."""
    import cv2
    import numpy as np

    height, width, _ = pictures[0].shape
    columns = min(most, len(pictures))
    rows = -(-len(pictures) // columns)
    page = np.full((rows * (height + GAP) + GAP, columns * (width + GAP) + GAP, 3), 255, np.uint8)
    for index, picture in enumerate(pictures):
        top, left = GAP + index // columns * (height + GAP), GAP + index % columns * (width + GAP)
        page[top : top + height, left : left + width] = picture
    return cv2.imencode(".jpg", page[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, QUALITY])[1].tobytes()

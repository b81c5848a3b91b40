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


def run(given: "Given", options: argparse.Namespace) -> None:
    """Draw the recording `options.recording` at the moments `options.moments` (`SECONDS:WORD`) into `options.out`.

    Raises:
        WorldkitError: the recording is of another world, or cannot be read; there is no such camera.
    """
    from worldkit import cameras
    from worldkit.reporting import Progress

    from .film.drawn_frames import Frames
    from .film.graphics_library import choose_headless
    from .film.light_meter import reading
    from .film.passes import choose_cameras
    from .film.picture_grid import labelled, laid_out
    from .recording import stored
    from .recording.replay import Replay

    choose_headless()
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
                readings[name].append(reading(model, image, frames.layers(data, name), given.movers))
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

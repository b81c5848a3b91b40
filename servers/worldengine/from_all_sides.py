"""Draw a world as it starts through every camera it has, or one that stands anywhere, small, on one sheet: `sheet.jpg`.

Or, plainly, through the first camera alone and at half the size, so that its edges are smooth: `thumbnail.png`.
"""

import argparse
import sys
import time
from typing import TYPE_CHECKING

from worldkit.files import write_atomic, write_json

from .film.picture_grid import labelled, laid_out

if TYPE_CHECKING:
    import numpy as np

    from .given import Given

SIZE = 448, 336
COLUMNS = 2
SHEET, THUMBNAIL = "sheet.jpg", "thumbnail.png"


def run(given: "Given", options: argparse.Namespace) -> None:
    """Draw it into `options.out`; no recording is needed.

    Raises:
        WorldkitError: the world does not compile, or has no such camera.
    """
    import mujoco

    from worldkit import cameras, world

    from .film.chosen_frames import FREE, free
    from .film.drawn_frames import Frames
    from .film.graphics_library import choose_headless
    from .film.passes import choose_cameras

    choose_headless()
    started = time.perf_counter()
    model = given.model(FREE if options.eye else "")
    width, height = options.size or SIZE
    cameras.aim(model, aspect=width / height)
    data = world.start(model)
    mujoco.mj_forward(
        model, data
    )  # once the model's cameras stand where they are aimed: pictures are drawn by the data's
    cameras.track(model, data)
    pictures: list[np.ndarray] = []
    names = chosen = choose_cameras(model, options.cameras)
    if options.eye is not None:
        free(model, data, chosen[0], options)
        chosen, names = chosen[:1], [FREE]
    with Frames(model, width, height) as frames:
        for camera, name in zip(chosen, names, strict=True):
            image = frames.image(data, camera, quality="still" if options.plain else "video")
            pictures.append(image if options.plain else labelled(image, name))
        renderer = frames.told()
    if options.plain:
        write_atomic(options.out / THUMBNAIL, _halved(pictures[0]))
    else:
        write_atomic(options.out / SHEET, laid_out(pictures, COLUMNS))
    wall = round(time.perf_counter() - started, 3)
    told = {"cameras": names, "size": [width, height], "renderer": renderer, "wall_s": wall}
    write_json(options.out / "result.json", {"ok": True, "pass": "sheet", **told})
    sys.stdout.write(f"{len(names)} cameras in {wall:.1f} s\n")


def _halved(image: "np.ndarray") -> bytes:
    """A picture (H, W, 3) at half its size, as PNG."""
    import cv2

    size = image.shape[1] // 2, image.shape[0] // 2
    small = cv2.resize(image, size, interpolation=cv2.INTER_AREA)
    data: bytes = cv2.imencode(".png", small[..., ::-1])[1].tobytes()
    return data

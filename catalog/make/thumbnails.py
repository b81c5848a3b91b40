"""Draw an asset's thumbnail with the runtime's own renderer (`python -m catalog.make --thumbnails`)."""

import os
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

SIZE = 256
STEP = 4
"""Colours so far apart, of 255, are seen to be enough, at less than half the bytes."""
SUPERSAMPLE = 2


def draw(key: str, catalog: Path) -> bytes:
    """PNG of one asset of a catalog folder in the studio, three-quarter view."""
    os.environ["WORLDWRIGHT_CATALOG"] = str(catalog)
    import cv2
    import mujoco

    from worldengine.film import graphics_library
    from worldengine.film.drawn_frames import Frames
    from worldkit import assets, cameras, scene

    graphics_library.choose_headless()  # the making of a kit has imported MuJoCo before
    spec = scene.new(key, time_step=0.002, setting="studio")
    height = assets.find(key).metric_height
    assets.add(spec, key, name=key, height=height, pos=(0, 0, height / 2), fixed=True)
    cameras.add(spec, "thumbnail", view="perspective", subjects=(key,), fovy=28)
    model = spec.compile()
    cameras.aim(model)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    width = SIZE * SUPERSAMPLE * 16 // 9
    with Frames(model, width, SIZE * SUPERSAMPLE) as frames:
        picture = frames.image(data, "thumbnail", quality="still")
    left = (picture.shape[1] - picture.shape[0]) // 2
    square = picture[:, left : left + picture.shape[0]] if not _wide(key) else picture
    shape = (SIZE, SIZE) if not _wide(key) else (SIZE * 16 // 9, SIZE)
    small = cv2.resize(square, shape, interpolation=cv2.INTER_AREA)
    return coarse(small)


def coarse(picture: "np.ndarray") -> bytes:
    """PNG of a picture, uint8 (H, W, 3), RGB, in colours `STEP` apart."""
    import cv2
    import numpy as np

    steps = np.minimum((picture.astype(int) + STEP // 2) // STEP * STEP, 255).astype(np.uint8)
    return cv2.imencode(".png", steps[..., ::-1], (cv2.IMWRITE_PNG_COMPRESSION, 9))[1].tobytes()


def _wide(key: str) -> bool:
    """Whether an asset is much longer than high, and needs the whole picture."""
    from worldkit import assets

    asset = assets.find(key)
    extents = asset.extents(asset.metric_height)
    return max(extents[0], extents[1]) > 1.6 * extents[2]

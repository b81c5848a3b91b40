"""Draw a few things once, so that the graphics driver compiles what nearly every picture needs, and hand over its files.

Run by path in the sandbox, `python shader_sampler.py OUT`, with a home that is thrown away: what the driver left there is
packed into `OUT/shaders.zip`.
"""

import os
import sys
import zipfile
from pathlib import Path
from typing import Any

PACKED = "shaders.zip"
CACHES = ("mesa_shader_cache", "mesa_shader_cache_db", ".drjit", ".nv")
"""Folders below a home in which drivers keep what they compiled."""
SIZE = (160, 90)
"""Pixels. No side of it, nor of the smaller pictures that are made on the way, is a power of two: a driver for the processor
compiles another shader for those, and hardly a film has such sides."""


def draw() -> None:
    """Draw one thing of each shape on the usual ground, at both qualities, and once by number."""
    import mujoco

    from worldengine.film.drawn_frames import Frames
    from worldkit import bodies, cameras, scene

    spec = scene.new("shaders", time_step=0.002, setting="studio")
    made: dict[str, Any] = {"mass": 1.0, "look": "#b3261e"}
    bodies.sphere(spec, "ball", diameter=0.1, pos=(0.0, 0.0, 0.5), **made)
    bodies.box(spec, "box", size=(0.2, 0.1, 0.1), pos=(0.3, 0.0, 0.3), **made)
    bodies.cylinder(spec, "can", diameter=0.1, height=0.2, pos=(-0.3, 0.0, 0.3), **made)
    bodies.capsule(spec, "pill", diameter=0.1, height=0.3, pos=(0.0, 0.3, 0.3), **made)
    cameras.add(spec, "overview", view="perspective", subjects=("ball", "box"))
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with Frames(model, *SIZE) as frames:
        frames.image(data, "overview", quality="still")
        frames.image(data, "overview", quality="video")
        frames.segmentation(data, "overview")


def pack(home: Path, packed: Path) -> None:
    """Pack what drivers left below a home."""
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(path for name in CACHES for path in (home / name).rglob("*") if path.is_file()):
            archive.write(path, path.relative_to(home).as_posix())


if __name__ == "__main__":
    draw()
    pack(Path(os.environ["HOME"]), Path(sys.argv[1]) / PACKED)

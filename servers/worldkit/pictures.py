"""The still and the video pass: pictures of recorded states, through every camera."""

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .encode import Video, write_png
from .errors import ProgramError
from .files import write_json
from .replay import Replay, frame_rows

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from .trajectory import Recording

Ticker = Callable[[int, int], object]
"""Called with frames done and frames in all."""


def stills(
    model: "mujoco.MjModel",
    recording: "Recording",
    names: Sequence[str],
    out: Path,
    size: tuple[int, int],
    tick: Ticker,
) -> dict[str, Any]:
    """`<camera>.png` of the first recorded row, and `visibility.json`: what each camera sees of each body."""
    from . import cameras, render

    names = choose_cameras(model, names)
    replay = Replay(model, recording)
    cameras.aim(model, recording.pos, orientations=recording.quat, aspect=size[0] / size[1])
    visibility = {}
    with render.Frames(model, *size) as frames:
        data = replay.show(0)
        for done, name in enumerate(names):
            cameras.track(model, data)
            write_png(out / f"{name}.png", frames.image(data, name, quality="still"))
            visibility[name] = visible(model, frames.segmentation(data, name))
            tick(done + 1, len(names))
    write_json(out / "visibility.json", visibility)
    return {"cameras": list(names), "size": list(size), "renderer": frames.engine}


def video(
    model: "mujoco.MjModel",
    recording: "Recording",
    names: Sequence[str],
    out: Path,
    size: tuple[int, int],
    fps: int,
    tick: Ticker,
) -> dict[str, Any]:
    """`<camera>.mp4`: frame k shows the recorded row nearest to k / fps. Never calls `mj_step`."""
    from . import cameras, render

    names = choose_cameras(model, names)
    replay = Replay(model, recording)
    cameras.aim(model, recording.pos, orientations=recording.quat, aspect=size[0] / size[1])
    rows = frame_rows(recording.time, fps)
    total = len(rows) * len(names)
    with ExitStack() as stack:
        frames = stack.enter_context(render.Frames(model, *size))
        films = {name: stack.enter_context(Video(out / f"{name}.mp4", *size, fps)) for name in names}
        done = 0
        for row in rows:
            data = replay.show(int(row))
            cameras.track(model, data)
            for name, film in films.items():
                film.add(frames.image(data, name, quality="video"))
                done += 1
                tick(done, total)
    return {
        "cameras": list(names),
        "frames": len(rows),
        "fps": fps,
        "size": list(size),
        "seconds": len(rows) / fps,
        "renderer": frames.engine,
    }


def choose_cameras(model: "mujoco.MjModel", wanted: Sequence[str]) -> list[str]:
    """The named cameras, or all; a `ProgramError` when there is none, or a name is unknown or no file name."""
    from .describe import names

    known = names(model, "camera", model.ncam)
    if not known:
        raise ProgramError(
            "the world has no camera", "build()", 'add one: cameras.add(spec, "overview", view="perspective")'
        )
    if unknown := [name for name in wanted if name not in known]:
        raise ProgramError(f"there is no camera {', '.join(unknown)}", "--camera", f"name one of: {', '.join(known)}")
    chosen = list(dict.fromkeys(wanted)) or known
    if odd := [name for name in chosen if not name.replace("_", "").replace("-", "").replace(".", "").isalnum()]:
        raise ProgramError(
            f"camera {odd[0]!r} cannot name a file", "build()", "use letters, digits, dots, dashes and underscores"
        )
    return chosen


def visible(model: "mujoco.MjModel", geoms: "np.ndarray") -> dict[str, dict[str, Any]]:
    """What a segmentation (height, width), geom ids or -1, shows of each body.

    Per body with at least one pixel: `pixels`, `fraction` of the picture, `box` (x0, y0, x1, y1 in pixels, inclusive).
    """
    import numpy as np

    from .describe import names

    bodies = names(model, "body", model.nbody)
    owner = np.where(geoms >= 0, model.geom_bodyid[np.maximum(geoms, 0)], -1)
    found = {}
    for body in np.unique(owner[owner >= 0]):
        rows, columns = np.nonzero(owner == body)
        found[bodies[body]] = {
            "pixels": len(rows),
            "fraction": len(rows) / owner.size,
            "box": [int(columns.min()), int(rows.min()), int(columns.max()), int(rows.max())],
        }
    return found

"""The still and the video pass: pictures of recorded states, through every camera."""

import argparse
import os
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.errors import ProgramError
from worldkit.files import write_json

from ..recording.replay import Replay, frame_rows
from . import graphics_library
from .chosen_frames import FILM, FREE
from .encode import Video, write_png
from .renderers.preview.soft_shapes import FLEX

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..given import Given
    from ..recording.stored import Recording
    from .described import Described

WORTH = 1 / 8
"""A frame of the plan's cameras, beside a film, takes about so many of the film's in time."""
Ticker = Callable[[int, int], object]
"""It is called with the frames done and the frames in all."""


def run(given: "Given", options: argparse.Namespace) -> None:
    """Draw the recording `options.recording` into `options.out`, by the world as one file.

    Raises:
        WorldkitError: the recording is of another world, or cannot be read; there is no such camera.
    """
    graphics_library.choose_headless()
    from worldkit import lights
    from worldkit.reporting import Progress

    from ..recording import stored
    from ..recording.describing import fingerprint
    from . import described

    recording, model, out = stored.open(options.recording), given.model(FREE if options.eye else ""), options.out
    same = fingerprint(model) == recording.meta["model"]["fingerprint"]
    started = time.perf_counter()
    film = None if options.film is None else described.read(options.film, recording, lights.of(model))
    if options.share and film is None:
        draw_share(model, recording, given, options)
        return
    if options.share and film is not None:
        from . import screened

        screened.draw_share(model, recording, film, given, options)
        return
    if options.run == "frame":
        summary = frame(model, recording, film, given, options)
    elif options.run == "still":
        tick = Progress(out, 0, "cameras")
        summary = stills(model, recording, options.cameras, out, given.size, tick, options.reuse)
    else:
        rest = model, recording, options.cameras, out
        if film is None:
            tick = Progress(out, 0, "frames")
            beside = getattr(options, "words", ()), getattr(options, "room_mb", 0) << 20
            summary = video(*rest, tick, options.reuse, given.size, given.fps, False, *beside) or {}
        else:
            summary = film_first(rest, film, given, options)
    result = {"ok": True, "pass": options.run, **summary, "trajectory_sha256": recording.sha256, "same_model": same}
    write_json(out / "result.json", {**result, "wall_s": round(time.perf_counter() - started, 3)})
    made = [*summary["cameras"], *([FILM] if "film" in summary else [])]
    sys.stdout.write(f"{', '.join(made)} in {out}\n")


def film_first(
    rest: "tuple[mujoco.MjModel, Recording, Sequence[str], Path]",
    film: "Described",
    given: "Given",
    options: argparse.Namespace,
) -> dict[str, Any]:
    """Draw the author's film, which is what a person sees, then the plan's cameras, small beside it; one progress over all of it.

    What an earlier pass drew of the same is taken over: a changed `film.py` costs its own frames alone.
    """
    from worldkit.reporting import Progress

    model, recording, names, out = rest
    aside = beside_a_film(given.size, given.fps)
    sizes = ((given.size, given.fps), aside)
    kept = next(
        filter(None, (video(*rest, lambda *_: None, options.reuse, *size, only_known=True) for size in sizes)), None
    )
    frames = 0 if kept else len(frame_rows(recording.time, aside[1])) * len(choose_cameras(model, names))
    tick = Progress(out, film.frames + round(frames * WORTH), "frames")
    found = directed(
        model, recording, film, given, options, lambda done: tick(done, film.frames + round(frames * WORTH))
    )
    before = found["drawn"]

    def small(done: int, total: int) -> None:
        tick(before + round(done * WORTH), before + round(total * WORTH))

    summary = kept or video(*rest, small, options.reuse, *aside) or {}
    for field, told in found.items():
        if field == "drawn":
            summary["drawn"] += told
        else:
            summary[field] = {**summary.get(field, {}), **told}
    return summary


def beside_a_film(size: tuple[int, int], fps: int) -> tuple[tuple[int, int], int]:
    """Size, pixels, and frame rate, 1/s, of the plan's cameras where the author's film is what is shown.

    They are looked at as witnesses then: half as large and half as often costs about a sixth.
    """
    return (size[0] // 4 * 2, size[1] // 4 * 2), max(1, round(fps / 2))


def stills(
    model: "mujoco.MjModel",
    recording: "Recording",
    names: Sequence[str],
    out: Path,
    size: tuple[int, int],
    tick: Ticker,
    earlier: Sequence[Path] = (),
) -> dict[str, Any]:
    """Draw `<camera>.png` of the first recorded row; write `visibility.json`, what each camera sees of each body, and `cameras.json`.

    What a pass in `earlier` drew of the same is taken over; `drawn` counts what was not.
    """
    from worldkit import cameras

    from .drawn_frames import Frames
    from .known_pictures import Known

    names = choose_cameras(model, names)
    replay = Replay(model, recording)
    cameras.aim(model, recording.pos, orientations=recording.quat, aspect=size[0] / size[1])
    visibility, stands, drawn = {}, {}, 0
    with Frames(model, *size) as frames:
        known = Known(model, recording, {"quality": "still", "size": size}, earlier, frames.shared())
        data = replay.show(0)
        for done, name in enumerate(names):
            cameras.track(model, data)
            stands[name] = cameras.standing(model, data, name)
            if not known.camera(name, ".png", out):
                write_png(out / f"{name}.png", frames.image(data, name, quality="still"))
                drawn += 1
            visibility[name] = visible(model, frames.segmentation(data, name))
            tick(done + 1, len(names))
        renderer = frames.told()
    write_json(out / "visibility.json", visibility)
    write_json(out / "cameras.json", {"size": list(size), "cameras": stands})
    return {"cameras": list(names), "size": list(size), "renderer": renderer, "drawn": drawn, **known.told(renderer)}


def video(
    model: "mujoco.MjModel",
    recording: "Recording",
    names: Sequence[str],
    out: Path,
    tick: Ticker,
    earlier: Sequence[Path],
    size: tuple[int, int],
    fps: int,
    only_known: bool = False,
    words: Sequence[str] = (),
    room_bytes: int = 0,
) -> dict[str, Any] | None:
    """Draw `<camera>.mp4`, where frame k shows the recorded row nearest to k / fps; `mj_step` is never called.

    What a pass in `earlier` drew of the same is taken over; `drawn` counts the frames that were not. None, and no film, when
    any would have to be drawn and `only_known` is set. With the words of this process's own command line, other processes draw a
    part of it, within a room for all, where every camera is drawn.
    """
    from worldkit import cameras

    from .drawn_frames import Frames
    from .known_pictures import Known
    from .planned_views import PlannedViews
    from .side_by_side import Drawn, Others

    names = choose_cameras(model, names)
    cameras.aim(model, recording.pos, orientations=recording.quat, aspect=size[0] / size[1])
    rows = frame_rows(recording.time, fps)
    with ExitStack() as stack:
        frames = stack.enter_context(Frames(model, *size))
        facts = {"quality": "video", "size": size, "fps": fps}
        known = Known(model, recording, facts, earlier, frames.shared())
        new = [name for name in names if not known.camera(name, ".mp4", out)]
        if new and only_known:
            for name in known.taken:
                (out / name).unlink()
            return None
        views = PlannedViews(model, recording, new, rows, frames)
        total = len(views)
        others = stack.enter_context(Others(words if new == names else (), total, size, room_bytes))
        films = {name: stack.enter_context(Video(out / f"{name}.mp4", *size, fps)) for name in new}
        for place in range(total):
            shown = others.take(place, frames.renderer) or Drawn(views.picture(place), [])
            films[views.name(place)].add(shown.picture)
            tick(place + 1, total)
        renderer = frames.told()
    return {
        "cameras": list(names),
        "frames": len(rows),
        "fps": fps,
        "size": list(size),
        "seconds": len(rows) / fps,
        "renderer": renderer,
        "drawn": total,
        **known.told(renderer),
    }


def draw_share(model: "mujoco.MjModel", recording: "Recording", given: "Given", options: argparse.Namespace) -> None:
    """Draw a share of the plan's cameras for the process that asked for it (`side_by_side`)."""
    from worldkit import cameras

    from . import side_by_side
    from .drawn_frames import Frames
    from .planned_views import PlannedViews

    names, size = choose_cameras(model, options.cameras), given.size
    cameras.aim(model, recording.pos, orientations=recording.quat, aspect=size[0] / size[1])
    with Frames(model, *size) as frames, os.fdopen(options.to, "wb") as pipe:
        views = PlannedViews(model, recording, names, frame_rows(recording.time, given.fps), frames)
        side_by_side.draw(views, options.share, range(len(views)), pipe)


def directed(
    model: "mujoco.MjModel",
    recording: "Recording",
    film: "Described",
    given: "Given",
    options: argparse.Namespace,
    tick: Callable[[int], object],
) -> dict[str, Any]:
    """Draw the author's film, or take it over where an earlier pass drew the same; returns what the summary says of it."""
    from .known_pictures import Known
    from .screened import screen

    name = f"{FILM}.mp4"
    known = Known(model, recording, {"quality": "film", "size": given.size, "fps": given.fps}, options.reuse)
    if earlier := known.film(options.film, name, options.out):
        said = {"film": earlier["film"], "parts": earlier.get("parts") or {}, "drawn": 0}
    else:
        said = screen(model, recording, film, given, options, tick, known.about)
    offered = known.told(said["film"]["renderer"])
    return {**said, **offered} if offered["pictures"] else {**said, "parts": {}, **offered}


def frame(
    model: "mujoco.MjModel",
    recording: "Recording",
    film: "Described | None",
    given: "Given",
    options: argparse.Namespace,
) -> dict[str, Any]:
    """Draw the moments `options.at`, s, of the film, or of the recording through a camera, or `options.seen`; see `chosen_frames`."""
    from . import chosen_frames, roughly

    if options.moving and film is not None:
        return roughly.draw(model, recording, film, given, options)
    if options.seen:
        if planned := [camera for *_, camera in options.seen if film is None or camera != FILM]:
            choose_cameras(model, planned)
        found = chosen_frames.each(model, recording, film, given, options)
        return found if film is None else {"film": film.told(given.fps), **found}
    if film is not None and not options.cameras and options.eye is None:
        return chosen_frames.of_film(model, recording, film, given, options)
    name = choose_cameras(model, options.cameras)[0]
    return chosen_frames.through_a_camera(model, recording, name, given, options)


def choose_cameras(model: "mujoco.MjModel", wanted: Sequence[str]) -> list[str]:
    """The named cameras, or all; raises `ProgramError` when there is none, or a name is unknown or no file name."""
    from worldkit.naming import names

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
    """Measure what a segmentation (height, width) of geom ids, or less, shows of each body and flex.

    Each with at least one pixel has `pixels`, `fraction` of the picture, `box` (x0, y0, x1, y1 in pixels, inclusive). A flex of
    a body's name is a part of that body where it hangs on it; else it is called `NAME (flex)`.
    """
    import numpy as np

    from worldkit.naming import names

    called = [*names(model, "body", model.nbody), *names(model, "flex", model.nflex)]
    owner = np.full(geoms.shape, -1)
    owner[geoms >= 0] = model.geom_bodyid[geoms[geoms >= 0]]
    owner = np.where(geoms <= FLEX, model.nbody + FLEX - geoms, owner)
    for flex, name in enumerate(called[model.nbody :]):
        if name not in called[: model.nbody]:
            continue
        body = called.index(name)
        if _hangs_on(model, flex, body):
            owner[owner == model.nbody + flex] = body
        else:
            called[model.nbody + flex] = f"{name} (flex)"
    found = {}
    for thing in np.unique(owner[owner >= 0]):
        rows, columns = np.nonzero(owner == thing)
        found[called[thing]] = {
            "pixels": len(rows),
            "fraction": len(rows) / owner.size,
            "box": [int(columns.min()), int(rows.min()), int(columns.max()), int(rows.max())],
        }
    return found


def _hangs_on(model: "mujoco.MjModel", flex: int, body: int) -> bool:
    """Whether a flex has a vertex or a node on a body, or on what that carries."""
    points, node = int(model.flex_vertadr[flex]), int(model.flex_nodeadr[flex])
    carriers = {*model.flex_vertbodyid[points : points + int(model.flex_vertnum[flex])].tolist()}
    carriers |= {*model.flex_nodebodyid[node : node + int(model.flex_nodenum[flex])].tolist()} if node >= 0 else set()
    for carrier in carriers:
        while carrier > 0 and carrier != body:
            carrier = int(model.body_parentid[carrier])
        if carrier == body:
            return True
    return False

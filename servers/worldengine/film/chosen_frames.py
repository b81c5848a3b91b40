"""Draw chosen moments at once: of a recording through any camera, or of a film, where each shot's first, middle and last can be asked
for on one sheet. The stage is set once for all of them, which takes longer than a picture."""

import argparse
import math
import random
import time
from collections import Counter
from collections.abc import Callable
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

from worldkit.files import write_atomic

from ..recording.replay import Replay
from . import behind_walls
from .encode import PASSING, write_png
from .light_meter import reading
from .picture_grid import labelled, laid_out
from .renderers import FINAL, Quality

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..given import Given
    from ..recording.stored import Recording
    from .described import Described
    from .directed import Screening

FILM, FREE = "film", "free"
"""Names of the cameras that no plan has: the film's own, and one that stands anywhere."""
SHOTS_A_SHEET = 6
LOOKED_AT, LOOKED_S = 60, 3.0
"""So many frames of a film are asked what they hide, for so long, s."""
WORDS = ("first", "middle", "last")
"""What is drawn of each shot; a row of a sheet."""


def picture_name(number: int) -> str:
    """The file of the moment with this number, from 0: `frame.png`, then `frame-2.png`."""
    return f"frame-{number + 1}.png" if number else "frame.png"


def of_film(
    model: "mujoco.MjModel",
    recording: "Recording",
    film: "Described",
    given: "Given",
    options: argparse.Namespace,
) -> dict[str, Any]:
    """Draw the film's frames at `options.at`, s, or with `options.shots` three of every shot on sheets (`shots-1.jpg`)."""
    from .directed import Screening

    size, (renderer, quality) = options.size or given.size, _drawn_by(options)
    chosen = _of_shots(film) if options.shots else [(_frame(at, film, given.fps), "") for at in options.at]
    rows, cells = [], []
    with Screening(given.world, model, recording, film, size, given.fps, renderer) as screening:
        screening.alone = True
        if options.samples is None:
            screening.picture(chosen[0][0])  # the first one also sets the stage, which takes longer
        spent = 0.0
        for done, (number, word) in enumerate(chosen):
            dearer = screening.dearer(number, given.size[1]) if isinstance(quality, str) else 1.0
            started = time.perf_counter()
            image = screening.picture(number, quality)
            spent += (time.perf_counter() - started) * dearer
            read = reading(screening.model, image, screening.layers(), given.movers)
            shown = {"film_s": number / given.fps, "recorded_s": float(film.arrays["time"][number])}
            rows.append(shown | {"shot": film.shot(number) + 1, "word": word, "reading": read})
            if options.shots:
                cells.append(labelled(image, f"shot {rows[-1]['shot']} {word} {shown['film_s']:.2f} s"))
            else:
                write_png(options.out / picture_name(done), image)
        said = screening.frames.told()
        unlit = behind_walls.told(screening.model, recording, film, given.fps, given.movers) if options.shots else []
    step = SHOTS_A_SHEET * len(WORDS)
    for sheet, start in enumerate(range(0, len(cells), step), 1):
        write_atomic(options.out / f"shots-{sheet}.jpg", laid_out(cells[start : start + step], len(WORDS)))
    # Corners do not become more with the pixels.
    cost = spent / len(chosen) * (math.prod(given.size) / math.prod(size)) ** 0.5
    return {
        "cameras": [FILM],
        "size": list(size),
        "renderer": said,
        **{key: rows[0][key] for key in ("film_s", "recorded_s", "reading")},
        "moments": rows,
        "frames": film.frames,
        "frame_s": round(cost, 3),
        "film": film.told(given.fps),
        "unlit": unlit,
    }


def through_a_camera(
    model: "mujoco.MjModel", recording: "Recording", name: str, given: "Given", options: argparse.Namespace
) -> dict[str, Any]:
    """Draw the recorded moments `options.at`, s, through a camera of the plan, or from `options.eye` to `options.target`."""
    from worldkit import cameras

    from .drawn_frames import Frames

    size, (renderer, quality) = options.size or given.size, _drawn_by(options)
    replay = Replay(model, recording)
    cameras.aim(model, recording.pos, orientations=recording.quat, aspect=size[0] / size[1])
    rows = []
    with Frames(model, size[0], size[1], renderer) as frames:
        for done, at in enumerate(options.at):
            row = _row(recording, at)
            data = replay.show(row)
            cameras.track(model, data)
            if options.eye is not None:
                free(model, data, name, options)
            image = frames.image(data, name, quality)
            write_png(options.out / picture_name(done), image)
            read = reading(model, image, frames.layers(data, name), given.movers)
            rows.append({"recorded_s": float(recording.time[row] - recording.time[0]), "reading": read})
        said = frames.told()
    seen_by = name if options.eye is None else FREE
    return {"cameras": [seen_by], "size": list(size), "renderer": said, **rows[0], "moments": rows}


def each(
    model: "mujoco.MjModel",
    recording: "Recording",
    film: "Described | None",
    given: "Given",
    options: argparse.Namespace,
) -> dict[str, Any]:
    """Draw the pictures `options.seen`, of one quality, size, moment and camera each; none is begun after `options.within` s but the first.

    The stage is set once for all of a size, that of the film apart. `drawn` has the places of those that were drawn, from 0;
    `hides`, of a film, what some of its frames hide (`_hides`).
    """
    until, drawn, hides = time.perf_counter() + options.within, list[int](), dict[str, Any]()
    stages: dict[tuple[bool, tuple[int, int]], list[int]] = {}
    for place, (_, size, _, camera) in enumerate(options.seen):
        stages.setdefault((camera == FILM, size), []).append(place)
    for (filmed, size), places in stages.items():
        if drawn:
            if time.perf_counter() > until:
                break
            model = given.model()  # cameras of another shape are aimed anew, as in a process of their own
        with ExitStack() as stack:
            screening = _screened(stack, model, recording, film, given, size) if film is not None and filmed else None
            draw = _seen(stack, model, recording, size) if screening is None else _of(screening)
            for place in places:
                if drawn and time.perf_counter() > until:
                    break
                quality, _, at_s, camera = options.seen[place]
                write_png(options.out / picture_name(place), draw(at_s, camera, quality), PASSING)
                drawn.append(place)
            if screening is not None and not hides:
                hides = {"hides": _hides(screening)}
    return {"cameras": list(dict.fromkeys(options.seen[place][3] for place in drawn)), "drawn": drawn, **hides}


def _screened(
    stack: ExitStack,
    model: "mujoco.MjModel",
    recording: "Recording",
    film: "Described",
    given: "Given",
    size: tuple[int, int],
) -> "Screening":
    """What draws the film's frames, each alone."""
    from .directed import Screening

    screening = stack.enter_context(Screening(given.world, model, recording, film, size, given.fps))
    screening.alone = True
    return screening


def _of(screening: "Screening") -> "Callable[[float, str, Quality], np.ndarray]":
    """What draws the film's frame at a moment of it, s."""
    return lambda at_s, _, quality: screening.picture(_frame(at_s, screening.film, screening.fps), quality)


def _hides(screening: "Screening") -> dict[str, Any]:
    """What frames of the film hide, `frames` of them by chance, none of which is drawn: how many of them, by what is hidden."""
    frames = random.SystemRandom().sample(range(screening.film.frames), min(LOOKED_AT, screening.film.frames))
    found, until, looked = Counter[str](), time.perf_counter() + LOOKED_S, 0
    while looked < len(frames) and time.perf_counter() < until:
        screening._moment(frames[looked])
        found.update(screening.hidden())
        looked += 1
    return {"frames": looked, "hidden": dict(found)}


def _seen(
    stack: ExitStack, model: "mujoco.MjModel", recording: "Recording", size: tuple[int, int]
) -> "Callable[[float, str, Quality], np.ndarray]":
    """What draws a recorded moment, s, through a camera of the plan."""
    from worldkit import cameras

    from .drawn_frames import Frames

    replay = Replay(model, recording)
    cameras.aim(model, recording.pos, orientations=recording.quat, aspect=size[0] / size[1])
    frames = stack.enter_context(Frames(model, *size))

    def draw(at_s: float, camera: str, quality: Quality) -> "np.ndarray":
        data = replay.show(_row(recording, at_s))
        cameras.track(model, data)
        return frames.image(data, camera, quality)

    return draw


def _row(recording: "Recording", at_s: float) -> int:
    """The recorded row nearest to a moment, s."""
    return int(abs(recording.time - recording.time[0] - at_s).argmin())


def free(model: "mujoco.MjModel", data: "mujoco.MjData", name: str, options: argparse.Namespace) -> None:
    """Let a camera of the model stand at `options.eye`, look at `options.target`, and see `options.fovy` degrees of height."""
    from .directed import axes

    index = model.camera(name).id
    data.cam_xpos[index] = options.eye
    data.cam_xmat[index] = axes(options.eye, options.target, 0.0).ravel()
    model.cam_fovy[index] = options.fovy


def _drawn_by(options: argparse.Namespace) -> tuple[str, Quality]:
    """The renderer that is wanted, and its effort: with `options.samples` that of the final pass; empty for the usual one."""
    return ("", "video") if options.samples is None else (FINAL, options.samples)


def _frame(at_s: float, film: "Described", fps: int) -> int:
    return min(max(round(at_s * fps), 0), film.frames - 1)


def _of_shots(film: "Described") -> list[tuple[int, str]]:
    """(frame, word) of every shot's first, middle and last; a shot of one frame shows it three times."""
    return [
        (shot["first"] + part * (shot["frames"] - 1) // (len(WORDS) - 1), word)
        for shot in film.shots
        for part, word in enumerate(WORDS)
    ]

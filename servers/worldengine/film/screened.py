"""Write the film that `film.py` describes: what an earlier film shows as well is taken from it, the rest is drawn."""

import argparse
import os
from collections import Counter
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from .chosen_frames import FILM
from .encode import Video

if TYPE_CHECKING:
    import mujoco

    from ..given import Given
    from ..recording.stored import Recording
    from .described import Described


def screen(
    model: "mujoco.MjModel",
    recording: "Recording",
    film: "Described",
    given: "Given",
    options: argparse.Namespace,
    tick: Callable[[int], object],
    about: str = "",
) -> dict[str, Any]:
    """Draw `film.mp4`, the recording as the film's author shows it, but for the shots that stand in an earlier one.

    With the words of this process's own command line (`options.words`), other processes draw a part of it, within a room for all.

    Returns:
        Its entry for the result, `film`; its shots as a later pass may take them, `parts`; and how many frames were drawn.
    """
    from . import kept_shots
    from .directed import Screening
    from .side_by_side import Drawn, Others

    out, words, room = options.out, getattr(options, "words", ()), getattr(options, "room_mb", 0) << 20
    name = f"{FILM}.mp4"
    with Screening(given.world, model, recording, film, given.size, given.fps) as screening:
        shots = kept_shots.of(screening, model, about, options.film, name, out, getattr(options, "reuse", ()))
        new = [(shot.first, shot.frames) for shot in shots if shot.packets is None]
        only = ("--only", ",".join(f"{first}+{count}" for first, count in new))
        parts, drawn = {}, 0
        with (
            Others([*words, *only] if words else (), sum(count for _, count in new), given.size, room) as others,
            Video(out / name, *given.size, given.fps) as file,
        ):
            for number, shot in enumerate(shots):
                hidden = Counter(shot.hidden)
                if shot.packets is not None:
                    file.take(shot.packets)
                    tick(shot.first + shot.frames)
                for frame in range(shot.first, shot.first + shot.frames) if shot.packets is None else ():
                    shown = others.take(drawn, screening.frames.renderer) or Drawn(
                        screening.picture(frame), screening.hidden()
                    )
                    file.add(shown.picture)
                    hidden.update(shown.hidden)
                    drawn += 1
                    tick(frame + 1)
                file.cut()
                parts[str(number)] = shot.told(dict(hidden))
        renderer, fell_back = screening.frames.told(), screening.frames.renderer != screening.frames.wanted
    if fell_back and any(shot.packets is not None for shot in shots):  # what another renderer drew does not go with it
        options = argparse.Namespace(**{**vars(options), "reuse": ()})
        return screen(model, recording, film, given, options, tick, about)
    said = {"frames": film.frames, "seconds": film.frames / given.fps, "renderer": renderer, **film.told(given.fps)}
    covered = sum((Counter(part["hidden"]) for part in parts.values()), Counter())
    hides = {what: round(count / given.fps, 3) for what, count in sorted(covered.items())}
    return {"film": said | {"hidden": hides}, "parts": parts, "drawn": drawn}


def draw_share(
    model: "mujoco.MjModel", recording: "Recording", film: "Described", given: "Given", options: argparse.Namespace
) -> None:
    """Draw a share of a film for the process that asked for it (`side_by_side`)."""
    from . import side_by_side
    from .directed import Screening

    with (
        Screening(given.world, model, recording, film, given.size, given.fps) as screening,
        os.fdopen(options.to, "wb") as pipe,
    ):
        only = options.only or [(0, film.frames)]
        frames = [frame for first, count in only for frame in range(first, first + count)]
        side_by_side.draw(screening, options.share, frames, pipe)

"""Whether stamped pictures show the stamped world: stills, and frames of films by chance, are drawn again and compared.

A signature of somebody known vouches for them; this is for a stamp that nobody known signed, where whoever sent it could have
laid any picture beside an honest world. Which frames are compared is drawn anew each time, so that nobody can spare them.
"""

import json
import math
import random
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from worldkit.files import write_atomic

from ..model.errors import CallOverError, WorldwrightError
from ..model.evidence import handed_in, pictures_of
from ..model.evidence.run import Run
from ..model.plan.plan_text import read_plan
from . import poster
from .proof import Proved
from .statement import Statement

if TYPE_CHECKING:
    import numpy as np

PICTURES = (".png", ".mp4", ".webp")
FRAMES = 2
"""Frames of each film that are drawn again; each takes about a second."""
CELLS = (32, 18)
"""The mosaic that two pictures are compared in: fine detail differs between drivers and by the film's compression."""
APART = 40.0
"""Of 255: how far one cell may differ. Honest pictures stay below 10 (33 at 160 pixels); a body painted in or out exceeds it."""


def differ(folder: Path, statement: Statement, proved: Proved) -> Iterator[str]:
    """A sentence for each stamped picture in `folder` that another picture of the proof run's recording contradicts."""
    run = proved.run
    for name, content in pictures_of.files(Run(folder)).items():
        write_atomic(run.folder / name, content)
    taken = [
        s.name for s in statement.subject if s.name not in handed_in.NAMES
    ]  # of `video/handed_in.mp4` the camera is so called
    for path in (folder / name for name in taken if (folder / name).is_file()):
        try:
            if path.name == poster.NAME:
                yield from _poster(path, folder, statement, proved)
            elif path.suffix == ".png" and path.parent.name == "stills":
                yield from _picture(path, run, 0.0, path.stem)
            elif path.suffix == ".mp4":
                yield from _film(path, run)
        except CallOverError:
            raise  # it tells nothing of the picture
        except WorldwrightError as error:
            yield f"{path.name} cannot be drawn again: {error}"


def _poster(path: Path, folder: Path, statement: Statement, proved: Proved) -> Iterator[str]:
    """Compare it with the author's film, or else with the plan's first camera, at the moment that `poster` takes."""
    names = [Path(s.name) for s in statement.subject if s.name not in handed_in.NAMES]
    films = {name.stem for name in names if name.suffix == ".mp4"}
    drawn = films or {name.stem for name in names if name.suffix == ".png"}
    run, filmed = proved.run, statement.predicate.film
    cameras = [c.name for c in read_plan(run.plan).plan.cameras() if c.name in drawn]
    cameras = [poster.FILM, *cameras] if poster.FILM in films else cameras
    if not cameras:
        return
    at_s = poster.moment(folder) if films else 0.0
    if cameras[0] == poster.FILM:
        at_s = poster.filmed(filmed.shots if filmed else (), at_s)
    fps = json.loads((proved.recording.parent / "program.json").read_bytes())["fps"]
    yield from _picture(path, run, math.ceil(at_s * fps - 1e-6) / fps, cameras[0])


def _picture(path: Path, run: Run, at_s: float, camera: str) -> Iterator[str]:
    import cv2

    yield from _compared(path.name, cv2.imread(str(path)), run, at_s, camera)


def _film(path: Path, run: Run) -> Iterator[str]:
    import cv2

    film = cv2.VideoCapture(str(path))
    try:
        count, fps = int(film.get(cv2.CAP_PROP_FRAME_COUNT)), film.get(cv2.CAP_PROP_FPS)
        for number in sorted(random.SystemRandom().sample(range(count), min(FRAMES, count))) or [0]:
            film.set(cv2.CAP_PROP_POS_FRAMES, number)
            shown = film.read()[1]
            at_s = number / fps if fps else 0.0
            yield from _compared(f"{path.name} at {at_s:.2f} s", shown, run, at_s, path.stem)
    finally:
        film.release()


def _compared(what: str, shown: "np.ndarray | None", run: Run, at_s: float, camera: str) -> Iterator[str]:
    import cv2
    import numpy as np

    from ..stage import tools as stage

    if shown is None:
        yield f"{what} is no picture"
        return
    height, width = shown.shape[:2]
    drawn = stage.draw_moment(run, at_s, camera, (width, height))
    now = cv2.imdecode(np.frombuffer(drawn, np.uint8), cv2.IMREAD_COLOR)
    apart = 255.0 if now is None else np.abs(_mosaic(shown) - _mosaic(now)).max()
    if apart > APART:
        yield f"{what} does not show this world: a part of it differs by {apart:.0f} of 255 from the picture drawn again"


def _mosaic(picture: "np.ndarray") -> "np.ndarray":
    import cv2
    import numpy as np

    return cv2.resize(picture, CELLS, interpolation=cv2.INTER_AREA).astype(np.float64)

"""Whether pictures show the world they are stamped with: stills, and frames of films by chance, are drawn again and compared.

A signature of somebody known vouches for them, so whoever signs looks before (`glance`). Of a stamp that nobody known signed,
where whoever sent it could have laid any picture beside an honest world, all are looked at (`differ`). Which frames are
compared is drawn anew each time, so that nobody can spare them.
"""

import json
import math
import random
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from worldkit.files import write_atomic

from ..model import mp4_file
from ..model.errors import CallOverError, WorldwrightError
from ..model.evidence import handed_in, pictures_of
from ..model.evidence.run import Run
from ..model.plan.plan_text import read_plan
from . import film_told, poster
from .proof import Proved
from .statement import Filmed, Statement

if TYPE_CHECKING:
    import numpy as np

PICTURES = (".png", ".mp4", ".webp")
FRAMES = 2
"""Frames of each film that are drawn again."""
AT_ONCE = 12
"""Pictures that one process draws: to begin one costs more than most pictures."""
GLANCE_S = 20.0
"""For so long an acceptance begins to look at further pictures, s."""
CELLS = (32, 18)
"""The mosaic that two pictures are compared in: fine detail differs between drivers and by the film's compression."""
APART = 40.0
"""Of 255: how far one cell may differ. Honest pictures stay below 10 (33 at 160 pixels); a body painted in or out exceeds it."""
STROKES = 0.02
"""Of a still, which no film's compression blurs: the share of a cell that may be darker or lighter by `APART` than all that lies
beside it in the other picture. Edges that another driver smooths otherwise lie between what is beside them; a thin stroke does not."""
FILM_STROKES, FILM_APART = 0.04, 32
"""The same of a film's frame, of its brightness alone: compression keeps a fourth of the colours, and smears red letters by 0.13 of a
cell. Of brightness it left under 0.001 beyond in pictures of eight worlds, letters and hard edges and all, at 480 pixels across;
a line of grey letters one pixel thin was 0.24 and more wherever its background differed from it."""
STROKE_PX, READABLE_PX = 12, 480
"""So many pixels of a cell at least, in a still at least so wide: on a smaller one nobody reads a thin caption."""


@dataclass(frozen=True)
class Shown:
    """What a stamped picture shows, and of which moment through which camera it says it is."""

    name: str
    """The file's."""
    what: str
    """The picture, for a sentence about it."""
    cells: "np.ndarray"
    size: tuple[int, int]
    """Pixels."""
    at_s: float
    camera: str
    still: Path | None = None
    """A still's file, of which every stroke is looked at."""
    frame: "np.ndarray | None" = None
    """A film's frame, the same."""

    @classmethod
    def of(
        cls, picture: "np.ndarray", name: str, what: str, at_s: float, camera: str, still: Path | None = None
    ) -> "Shown":
        """A picture as it was read, uint8 (height, width, 3)."""
        frame = picture if Path(name).suffix == ".mp4" else None
        return cls(name, what, _mosaic(picture), (picture.shape[1], picture.shape[0]), at_s, camera, still, frame)

    def against(self, drawn: bytes) -> str:
        """How the picture drawn again, an encoded one, contradicts it; empty where it does not."""
        import cv2
        import numpy as np

        now = cv2.imdecode(np.frombuffer(drawn, np.uint8), cv2.IMREAD_COLOR)
        apart = 255.0 if now is None else np.abs(self.cells - _mosaic(now)).max()
        if now is not None and apart <= APART:
            return self._strokes(now)
        return f"{self.what} does not show this world: a part of it differs by {apart:.0f} of 255 from the picture drawn again"

    def _strokes(self, now: "np.ndarray") -> str:
        """Whether something too thin for the mosaic is painted in or out of a still, which is read once more, or of a film's frame."""
        import cv2

        mine = self.frame if self.still is None else cv2.imread(str(self.still))
        if mine is None or mine.shape != now.shape or mine.shape[1] < READABLE_PX:
            return ""
        enough = STROKE_PX * CELLS[0] * CELLS[1] / (mine.shape[0] * mine.shape[1])
        if self.still is None:
            mine, now = (cv2.cvtColor(one, cv2.COLOR_BGR2GRAY)[..., None] for one in (mine, now))
        share = max(_beyond(mine, now, self.still is None), _beyond(now, mine, self.still is None))
        if share <= max(FILM_STROKES if self.still is None else STROKES, enough):
            return ""
        return f"{self.what} does not show this world: strokes over {share:.0%} of a part of it are not in the picture drawn again"


def differ(folder: Path, statement: Statement, proved: Proved) -> Iterator[str]:
    """A sentence for each stamped picture in `folder` that another picture of the proof run's recording contradicts."""
    _film_of(folder, proved.run)
    taken = [
        s.name for s in statement.subject if s.name not in handed_in.NAMES
    ]  # of `video/handed_in.mp4` the camera is so called
    found: list[Shown | str] = []
    for path in (folder / name for name in taken if (folder / name).is_file()):
        if path.name == poster.NAME:
            found += _told(path, lambda path: _poster(path, folder, statement, proved))
        else:
            found += _shown(path, proved, FRAMES)
    yield from _compared(found, proved.run, filmed=statement.predicate.film)


def glance(folder: Path, proved: Proved, within_s: float = GLANCE_S, filmed: Filmed | None = None) -> Iterator[str]:
    """The same of the stills, and of one frame of each film, in an order by chance; at least one of them, and no other
    picture is begun after `within_s` seconds. `filmed`: what is to be stamped of the author's film, of which a frame comes first then.
    """
    _film_of(folder, proved.run)
    paths = [*(folder / "stills").glob("*.png"), *(folder / "video").glob("*.mp4")]
    random.SystemRandom().shuffle(paths)
    paths.sort(key=lambda path: filmed is None or path.name != f"{poster.FILM}.mp4")
    until, found = time.monotonic() + within_s, list[Shown | str]()
    for path in paths:
        if found and time.monotonic() > until:
            break
        found += _shown(path, proved, 1)
    yield from _compared(found, proved.run, until, filmed)


def _film_of(folder: Path, run: Run) -> None:
    """Lay the author's film beside the recording of the proof run."""
    for name, content in pictures_of.files(Run(folder)).items():
        write_atomic(run.folder / name, content)


def _shown(path: Path, proved: Proved, frames: int) -> "Iterator[Shown | str]":
    """What a still shows, or so many frames of a film, or why it shows nothing; other files are no pictures."""
    if path.suffix == ".png" and path.parent.name == "stills":
        yield from _told(path, lambda path: _picture(path, 0.0, path.stem))
    elif path.suffix == ".mp4":
        yield from _told(path, lambda path: _film(path, proved, frames))


def _told(path: Path, look: "Callable[[Path], Iterator[Shown | str]]") -> "Iterator[Shown | str]":
    try:
        yield from look(path)
    except CallOverError:
        raise  # it tells nothing of the picture
    except WorldwrightError as error:
        yield f"{path.name} cannot be drawn again: {error}"


def _poster(path: Path, folder: Path, statement: Statement, proved: Proved) -> "Iterator[Shown | str]":
    """It is to show what the author's film does, or else the plan's first camera, at the moment that `poster` takes."""
    names = [Path(s.name) for s in statement.subject if s.name not in handed_in.NAMES]
    films = {name.stem for name in names if name.suffix == ".mp4"}
    drawn = films or {name.stem for name in names if name.suffix == ".png"}
    filmed = statement.predicate.film
    cameras = [c.name for c in read_plan(proved.run.plan).plan.cameras() if c.name in drawn]
    cameras = [poster.FILM, *cameras] if poster.FILM in films else cameras
    if not cameras:
        return
    at_s = poster.moment(folder) if films else 0.0
    if cameras[0] == poster.FILM:
        at_s = poster.filmed(filmed.shots if filmed else (), at_s)
    fps = _fps(proved)
    yield from _picture(path, math.ceil(at_s * fps - 1e-6) / fps, cameras[0])


def _picture(path: Path, at_s: float, camera: str) -> "Iterator[Shown | str]":
    import cv2

    still = path if path.suffix == ".png" else None
    picture = cv2.imread(str(path))
    yield (
        f"{path.name} is no picture"
        if picture is None
        else Shown.of(picture, path.name, path.name, at_s, camera, still)
    )


def _film(path: Path, proved: Proved, frames: int = FRAMES) -> "Iterator[Shown | str]":
    """Frames by chance; refuse a film whose frames are not, one after the other, as many as it says and should be."""
    import av
    from av.codec.context import ThreadType

    try:
        with mp4_file.opened(path) as film:
            stream = film.streams.video[0]
            stream.codec_context.thread_type = ThreadType.AUTO  # every frame is decoded, on all processors
            fps, said = float(stream.average_rate or 0), stream.frames
            if odd := _paced(path, proved, fps, said):
                yield f"{path.name} is not as it was drawn: {odd}"
                return
            chosen, taken, count = random.SystemRandom().sample(range(said), min(frames, said)), {}, 0
            for count, frame in enumerate(film.decode(stream), 1):
                if count > said or abs(float(frame.time or 0.0) - (count - 1) / fps) > 0.5 / fps:
                    break
                if count - 1 in chosen:
                    taken[count - 1] = frame.to_ndarray(format="bgr24")
            if count != said or len(taken) != len(chosen):
                yield f"{path.name} is not as it was drawn: it says {said} frames, {fps:g} a second, and has others"
                return
    except (av.FFmpegError, mp4_file.NoFilmError) as cause:
        yield getattr(cause, "cause", "") or f"{path.name} is no film to be shown: {cause}"
        return
    for number, shown in sorted(taken.items()):
        at_s = number / fps
        yield Shown.of(shown, path.name, f"{path.name} at {at_s:.2f} s", at_s, path.stem)


def _paced(path: Path, proved: Proved, fps: float, said: int) -> str:
    """How the rate and the number of frames that a film tells contradict the recording; empty where they do not.

    Of the author's own film, whose cuts are its own, only the rate is known.
    """
    from worldengine.recording import stored
    from worldengine.recording.replay import frame_rows

    full = _fps(proved)
    if fps not in (full, max(1, round(full / 2))):  # half as often beside an author's film
        return f"it shows {fps:g} frames a second, the program asks for {full}"
    wanted = said if path.stem == poster.FILM else len(frame_rows(stored.open(proved.recording).time, fps))
    if said != wanted or said < 1:
        return f"it says {said} frames, and the recording has {wanted}"
    return ""


def _fps(proved: Proved) -> int:
    """Frames a second that the program asks for."""
    return int(json.loads((proved.recording.parent / "program.json").read_bytes())["fps"])


def _compared(
    found: "Sequence[Shown | str]", run: Run, until: float = math.inf, filmed: Filmed | None = None
) -> Iterator[str]:
    """The sentences among what was found, and one for each picture that another one contradicts, in their order."""
    shown = [one for one in found if isinstance(one, Shown)]
    told: list[str] = []
    apart = iter(_apart(shown, run, until, AT_ONCE, filmed, told))
    yield from filter(None, (one if isinstance(one, str) else next(apart) for one in found))
    yield from told[:1]


def _apart(
    shown: "Sequence[Shown]", run: Run, until: float, at_once: int, filmed: Filmed | None, told: list[str]
) -> list[str]:
    """What contradicts each picture; empty where nothing does, and of those that would be begun after `until`, but the first.

    In `told` it leaves how the film, which was described anew for its frames, contradicts what is told of it (`filmed`).
    """
    from ..stage import tools as stage

    said: list[str] = []
    for first in range(0, len(shown), at_once):
        left_s = until - time.monotonic()
        if said and left_s < 0:
            break
        some = shown[first : first + at_once]
        try:
            wanted = [("still" if one.still else "video", one.at_s, one.camera, one.size) for one in some]
            drawn, film = stage.draw_moments(run, wanted, max(left_s, 0.0))
        except CallOverError:
            raise  # it tells nothing of the pictures
        except WorldwrightError as error:
            alone = len(some) == 1  # else each is drawn for itself, which tells whose fault it is
            said += (
                [f"{some[0].name} cannot be drawn again: {error}"]
                if alone
                else _apart(some, run, until, 1, filmed, told)
            )
        else:
            if filmed is not None and (wrong := film_told.otherwise(filmed, film)):
                told.append(f"{poster.FILM}.mp4 is told otherwise than it is drawn: {wrong}")
            said += ["" if data is None else one.against(data) for one, data in zip(some, drawn, strict=True)]
    return [*said, *[""] * (len(shown) - len(said))]


def _mosaic(picture: "np.ndarray") -> "np.ndarray":
    import cv2
    import numpy as np

    return cv2.resize(picture, CELLS, interpolation=cv2.INTER_AREA).astype(np.float64)


def _beyond(one: "np.ndarray", other: "np.ndarray", filmed: bool) -> float:
    """The largest share of a cell of one picture that is beyond all that lies beside it in the other one."""
    import cv2
    import numpy as np

    apart = FILM_APART if filmed else APART
    beside = np.ones((2 * max(1, round(one.shape[1] / 400)) + 1,) * 2, np.uint8)
    low, high = (bound(other, beside).reshape(one.shape).astype(np.int16) for bound in (cv2.erode, cv2.dilate))
    out = np.asarray(((one < low - apart) | (one > high + apart)).any(axis=2), np.float32)
    return float(cv2.resize(out, CELLS, interpolation=cv2.INTER_AREA).max())

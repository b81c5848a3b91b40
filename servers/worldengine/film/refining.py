"""The final pass: a film that is whole after its first minute and becomes better until its minutes are over.

Frames far apart are drafted first, at half the size with their surfaces' colours at the whole: every eighth, then those between
that cannot be reckoned from them (`between.py`), so that a film stands whenever it is cut. Then these are drawn again in place,
shot by shot, with more samples, twice before any other is traced; and so on with three times the samples each round, as long as
the minutes last. A film that cannot be traced in its minutes is drawn as a whole by the preview (`in_time.py`). What is not traced by then is reckoned from the traced frames before and after it while the file is written. Of a
shot whose camera and light stand still, the last frame and the first are traced as a whole, the others only where they differ
from both. What is drawn lies in `frames/`, a folder for each film, without its words, and is gone on with later.
"""

import argparse
import hashlib
import itertools
import json
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from worldkit.files import write_json

from . import renderers
from .drawing_order import rounds
from .encode import Video
from .identity import identity
from .in_time import InTime
from .kept_frames import DRAFT, FACTOR, FIRST, Refined

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..given import Given
    from ..recording.stored import Recording
    from .described import Described

NAME, FRAMES = "final", "frames"
PLAIN_LEVELS = (1, 4)
"""The same of the preview: its still is drawn twice as large each way."""
ENCODE_S = 0.06
"""Kept back for each frame of the film, s: reading it again and encoding it took 54 ms of a processor's time at 1280x720."""
RECKON_S = 0.16
"""Kept back besides for each frame of the film, s at 1280x720: two in three may have to be reckoned, and at 960x540 one took 0.14 s
of a processor's time."""
LATE = 1.5
"""Once so many times the minutes are over no frame is reckoned any more: the nearest traced one is shown."""


class Shown(Protocol):
    """A film of which each frame can be drawn by itself."""

    count: int
    """The number of its frames."""
    shots: Sequence[range]
    """The frames of each of its shots."""

    def levels(self) -> Iterable[float]:
        """Samples a pixel, round by round; without end where more always make it better."""

    lacking: Callable[[int, int, int], bool] | None
    """Whether a frame cannot well be reckoned from two others; None where every frame has to be drawn."""

    give_way: Callable[[float], None] | None
    """Let a plainer renderer draw from now on, since a whole film takes so many seconds; None where there is none."""

    def picture(self, number: int, samples: float) -> "np.ndarray":
        """One frame with so many samples a pixel, without its words: uint8 (height, width, 3)."""

    def reckoned(self, number: int, drawn: Sequence[float], read: "Callable[[int], np.ndarray]") -> "np.ndarray | None":
        """A frame by the drawn ones of its shot, those with samples; None where they show too little of it, or would mislead."""

    def lettered(self, number: int, image: "np.ndarray") -> "np.ndarray":
        """A picture with the words of a frame."""

    def stills(self, number: int, samples: float) -> float:
        """What is drawn with this frame, if it is the first of its shot with so many samples, in frames of these."""

    def told(self) -> dict[str, Any]:
        """What the result says of it: cameras, renderer, …"""


class FellBackError(Exception):
    """A plainer renderer draws from now on: its pictures belong to no set that the other one began."""


class OfTheAuthor:
    """The film that `film.py` describes; `tick` is called whenever something of a frame begins to be drawn."""

    _takes_s = 0.0
    """What tracing all of it takes, s, where it gave way."""

    def __init__(
        self,
        given: "Given",
        model: "mujoco.MjModel",
        recording: "Recording",
        film: "Described",
        stack: ExitStack,
        tick: Callable[[], object] | None = None,
    ) -> None:
        from .between import Geometry
        from .directed import Screening

        self._film, self._fps, self.count = film, given.fps, film.frames
        self.shots: Sequence[range] = [range(shot["first"], shot["first"] + shot["frames"]) for shot in film.shots]
        screening = Screening(given.world, model, recording, film, given.size, given.fps, renderers.FINAL)
        self._screening = stack.enter_context(screening)
        if tick is not None:
            screening.tick = tick
        self.renderer = screening.frames.renderer
        self._geometry: Geometry | None = Geometry(screening.surfaces, screening.placed) if self._traced else None
        self.lacking: Callable[[int, int, int], bool] | None = self._lacking if self._traced else None
        self._unreckoned = ""
        self.give_way: Callable[[float], None] | None = self._give_way if self._traced else None

    def _give_way(self, takes_s: float) -> None:
        """The preview draws, where tracing takes longer than there is time."""
        self._takes_s = takes_s
        self._screening.frames.give_way()
        self.renderer, self.lacking, self.give_way = self._screening.frames.renderer, None, None

    @property
    def _traced(self) -> bool:
        return self.renderer == renderers.FINAL

    def levels(self) -> Iterable[float]:
        """Ever more samples where paths are traced; the two kinds of picture that any other renderer has."""
        return traced_levels() if self._traced else PLAIN_LEVELS

    def picture(self, number: int, samples: float) -> "np.ndarray":
        """One frame without its words.

        Raises:
            FellBackError: the renderer gave up meanwhile.
        """
        plain: renderers.Quality = "still" if samples >= PLAIN_LEVELS[-1] else "video"
        image = self._screening.wordless(number, samples if self._traced else plain)
        if self._screening.frames.renderer != self.renderer:
            self.renderer, self.lacking = self._screening.frames.renderer, None
            raise FellBackError
        return image

    def _lacking(self, frame: int, before: int, after: int) -> bool:
        """Any is traced where the driver cannot draw what they show; so are those across wide gaps where the breeze moves things, and
        where light, developing or focus change otherwise than evenly."""
        from .fitting import uneven

        if (after - before > 2 and self._screening.sways) or uneven(self._film, before, after, self._fps):
            return True
        if self._geometry is not None:
            try:
                return self._geometry.lacking(frame, before, after)
            except Exception as error:  # drivers fail in ways of their own, and a traced film needs none
                self._give_up(error)
        return True

    def reckoned(self, number: int, drawn: Sequence[float], read: "Callable[[int], np.ndarray]") -> "np.ndarray | None":
        """By where what is seen stands in the nearest traced frames before and after it."""
        from .between import neighbours, reckoned
        from .fitting import uneven

        shot = next(shot for shot in self.shots if number in shot)
        sides = neighbours(number, drawn, shot)
        if self._geometry is None or not sides:
            return None
        try:
            image = reckoned(number, sides, self._geometry, read, self._film.shutter)
            first, last = min(number, *sides), max(number, *sides)
            return None if image is None or uneven(self._film, first, last, self._fps) else image
        except Exception as error:  # as above
            self._give_up(error)
            return None

    def _give_up(self, error: Exception) -> None:
        """No frame is asked about or reckoned from now on."""
        self._geometry, self._unreckoned = None, f"{type(error).__name__}: {error}"[:300]

    def lettered(self, number: int, image: "np.ndarray") -> "np.ndarray":
        """With its captions, and how fast it runs."""
        return self._screening.lettered(number, image)

    def stills(self, number: int, samples: float) -> float:
        """What the frames take that stand in for what does not change in its shot, as far as the renderer draws any."""
        return self._screening.stills(number, samples) if self._traced else 0.0

    def told(self) -> dict[str, Any]:
        """The renderer, what the film tells of itself, and, as `unreckoned`, why frames were reckoned no more."""
        failed: dict[str, Any] = {"unreckoned": self._unreckoned} if self._unreckoned else {}
        failed |= {"puffless": self._screening.puffless} if getattr(self._screening, "puffless", "") else {}
        failed |= {"tracing_takes_s": round(self._takes_s, 1)} if self._takes_s else {}
        told = {"cameras": ["film"], "renderer": self._screening.frames.told(), "film": self._film.told(self._fps)}
        return told | failed


def run(given: "Given", options: argparse.Namespace) -> None:
    """Draw the recording `options.recording` into `options.out` for `options.minutes`.

    Raises:
        WorldkitError: the recording is of another world, or cannot be read; the film asks for what may not be shown.
    """
    from worldkit import lights
    from worldkit.reporting import Progress

    from ..recording import stored
    from . import described
    from .graphics_library import choose_headless
    from .known_pictures import drawn

    choose_headless()
    started = time.perf_counter()
    recording, model, out = stored.open(options.recording), given.model(), options.out
    film = described.read(options.film, recording, lights.of(model))
    name = named(options.film, recording.shown_sha256, given.world)
    about = [given.size, given.fps, drawn(model).hex()]
    seconds = options.minutes * 60.0
    progress = Progress(out, round(seconds), "s")

    def tick() -> None:
        progress(min(round(time.perf_counter() - started), round(seconds)))

    with ExitStack() as stack:
        shown = OfTheAuthor(given, model, recording, film, stack, tick)
        end = started + drawing_s(seconds, shown.count, given.size)
        complete, state = refined(shown, out / FRAMES / name, about, end, tick)
        tell = Progress(out, shown.count, "frames in the file")
        encode(shown, state, out / f"{NAME}.mp4", given.size, given.fps, tell, started + LATE * seconds)
        told = shown.told()
    if takes_s := told.get("tracing_takes_s"):  # of drawing alone: the file takes its share of the minutes
        told["tracing_takes_s"] = round(given_s(takes_s, shown.count, given.size), 1)
    result = {"ok": True, "pass": NAME, **told, "frames": shown.count, "fps": given.fps, "size": list(given.size)}
    result |= {
        "seconds": shown.count / given.fps,
        **state.told(),
        "rest_s": round(given_s(state.told()["rest_s"], shown.count, given.size), 1),
        "complete": complete,
        "trajectory_sha256": recording.sha256,
    }
    write_json(out / "result.json", {**result, "wall_s": round(time.perf_counter() - started, 3)})
    sys.stdout.write(f"{NAME}: {state.text()}, in {out}\n")


def drawing_s(seconds: float, count: int, size: Sequence[int]) -> float:
    """Seconds of those given in which frames are drawn; the rest is for the file, but never more than half."""
    return max(seconds / 2, seconds - _file_s(count, size))


def given_s(drawing: float, count: int, size: Sequence[int]) -> float:
    """Seconds to give so that frames are drawn for so many, s: the inverse of `drawing_s`; none for none."""
    return min(2 * drawing, drawing + _file_s(count, size)) if drawing > 0 else 0.0


def _file_s(count: int, size: Sequence[int]) -> float:
    return (ENCODE_S + RECKON_S) * count * size[0] * size[1] / (1280 * 720)


def refined(shown: OfTheAuthor, folder: Path, about: list[Any], end: float, tick: Any) -> "tuple[bool, Refined]":
    """`refine` on the frames in a folder; where a plainer renderer draws, from the start or since the other gave up, on those of
    its own, in a folder beside it: what was traced stands."""
    while True:
        plain = "" if shown.renderer == renderers.FINAL else f"-{shown.renderer}"
        own = folder.with_name(folder.name + plain)
        state = Refined(own, shown.count, json.dumps([own.name, *about, identity(shown.renderer).sha256]))
        with suppress(FellBackError):
            return refine(shown, state, end, tick), state


def named(described: Path, shown_sha256: str, world: Path) -> str:
    """The name of the set of frames of a film: a hash of its description, in this folder, and of what it shows: the motion and
    what changes beside it (`Recording.shown_sha256`), and the world's file, which also has all looks, lights and planned cameras."""
    files = [world, *sorted(described.iterdir())]
    said = [shown_sha256, *(hashlib.sha256(path.read_bytes()).hexdigest() for path in files)]
    return hashlib.sha256("\n".join(said).encode()).hexdigest()[:16]


def traced_levels() -> Iterator[float]:
    """Samples a pixel, round by round, without end."""
    yield DRAFT
    for number in itertools.count():
        yield FIRST * FACTOR**number


def refine(shown: Shown, state: Refined, end: float, tick: Any) -> bool:
    """Draw frames until the clock (`time.perf_counter`) reaches `end`, s; at least one that can be shown.

    Returns whether nothing is left that would make it better; raises `FellBackError` where a film gives way. A frame is begun only if it is likely to be done in time, by what
    the last ones took for each sample: the first of a shot are the dearest, since what stands still is drawn with them. The very
    first is begun whatever is expected, since that was found by another process, maybe beside others; and with it the renderer
    gets ready, which tells of those after it only that they take no longer.
    """
    begun: set[tuple[int, float]] = set()
    draft, keeping, asked = next(iter(shown.levels())), 0.0, shown.lacking

    judge = InTime(shown.shots, asked, end) if asked is not None and shown.give_way is not None else None

    def lacking(frame: int, before: int, after: int) -> bool:
        return asked is None or time.perf_counter() > end or asked(frame, before, after)

    for number, samples in rounds(shown.shots, shown.levels(), asked and lacking):
        now = time.perf_counter()  # to ask what is lacking takes time that is not this frame's own
        if now > end and any(state.samples):
            return False
        if (
            judge is not None
            and not judge.done
            and (takes_s := judge.judged(state, now))
            and shown.give_way is not None
        ):
            shown.give_way(takes_s)
            raise FellBackError
        if state.samples[number] >= samples:
            continue
        shot = 0 if samples == draft else max(k for k, shot in enumerate(shown.shots) if shot.start <= number)
        first = (shot, samples) not in begun
        stills = shown.stills(number, samples) if first else 0.0
        if begun and now + state.pace.expected(samples, first, stills) > end:
            return False
        image = shown.picture(number, samples)
        learn = state.pace.add if begun else state.pace.doubt
        begun.add((shot, samples))
        since = time.perf_counter()
        learn(samples, since - now + keeping, stills)  # what keeping the frame before it took is counted, too
        state.keep(number, image, samples)
        keeping = time.perf_counter() - since
        tick()
    return True


def encode(
    shown: Shown,
    state: Refined,
    path: Path,
    size: tuple[int, int],
    fps: int,
    tick: Callable[[int], object],
    until: float = float("inf"),
) -> None:
    """Write the film out of the frames that there are, and of those reckoned between them before the clock reaches `until`, s;
    `tick` is called with the number written."""
    from functools import lru_cache

    read = lru_cache(maxsize=2)(state.read)
    state.reckoned = 0
    with Video(path, *size, fps) as film:
        for number, samples in enumerate(state.samples):
            image = None
            if samples <= 0 and time.perf_counter() < until:
                image = shown.reckoned(number, state.samples, read)
                state.reckoned += image is not None
            if image is None:
                held = state.nearest(number, shown.shots)
                alike = any(number in shot and held in shot for shot in shown.shots)
                image = shown.lettered(number if alike else held, read(held))  # of another shot with the words of that
            else:
                image = shown.lettered(number, image)
            film.add(image)
            tick(number + 1)

"""The final pass: a film that is whole after its first minute and becomes better until its minutes are over.

All frames are drafted first, at half the size with their surfaces' colours at the whole, every eighth, then those between, so
that a film stands whenever it is cut: a frame that is missing is shown by the one before it. Then they are drawn again in
place, shot by shot, with three times the samples each round, as long as the minutes last. Of a shot whose camera and light stand still, the last
frame and the first are traced as a whole, the others only where they differ from both. What is drawn lies in `frames/`, a folder
for each film, and is gone on with later.
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
from .encode import Video, write_png
from .identity import identity

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..given import Given
    from ..recording.stored import Recording
    from .described import Described

NAME, FRAMES, STATE = "final", "frames", "state.json"
DRAFT, FIRST, FACTOR = 0.5, 2, 3
"""Samples a pixel of the draft, of the first round after it, and how many times more each further round takes."""
PLAIN_LEVELS = (1, 4)
"""The same of the preview: its still is drawn twice as large each way."""
STRIDES = (8, 4, 2, 1)
ENCODE_S = 0.06
"""Kept back for each frame of the film, s: reading it again and encoding it took 54 ms of a processor's time at 1280x720."""

CALMER = 0.8
"""After a dear frame the next ones are expected to take this share of it, and this share of that, …"""


class Shown(Protocol):
    """A film of which each frame can be drawn by itself."""

    count: int
    """The number of its frames."""
    shots: Sequence[range]
    """The frames of each of its shots."""

    def levels(self) -> Iterable[float]:
        """Samples a pixel, round by round; without end where more always make it better."""

    def picture(self, number: int, samples: float) -> "np.ndarray":
        """One frame with so many samples a pixel: uint8 (height, width, 3)."""

    def stills(self, number: int, samples: float) -> int:
        """How many other frames are drawn with this one, if it is the first of its shot with so many samples."""

    def told(self) -> dict[str, Any]:
        """What the result says of it: cameras, renderer, …"""


class FellBackError(Exception):
    """A plainer renderer draws from now on: its pictures belong to no set that the other one began."""


class OfTheAuthor:
    """The film that `film.py` describes; `tick` is called whenever something of a frame begins to be drawn."""

    def __init__(
        self,
        given: "Given",
        model: "mujoco.MjModel",
        recording: "Recording",
        film: "Described",
        stack: ExitStack,
        tick: Callable[[], object] | None = None,
    ) -> None:
        from .directed import Screening

        self._film, self._fps, self.count = film, given.fps, film.frames
        self.shots: Sequence[range] = [range(shot["first"], shot["first"] + shot["frames"]) for shot in film.shots]
        screening = Screening(given.world, model, recording, film, given.size, given.fps, renderers.FINAL)
        self._screening = stack.enter_context(screening)
        if tick is not None:
            screening.tick = tick
        self.renderer = screening.frames.renderer

    @property
    def _traced(self) -> bool:
        return self.renderer == renderers.FINAL

    def levels(self) -> Iterable[float]:
        """Ever more samples where paths are traced; the two kinds of picture that any other renderer has."""
        return traced_levels() if self._traced else PLAIN_LEVELS

    def picture(self, number: int, samples: float) -> "np.ndarray":
        """One frame, words and all.

        Raises:
            FellBackError: the renderer gave up meanwhile.
        """
        plain: renderers.Quality = "still" if samples >= PLAIN_LEVELS[-1] else "video"
        image = self._screening.picture(number, samples if self._traced else plain)
        if self._screening.frames.renderer != self.renderer:
            self.renderer = self._screening.frames.renderer
            raise FellBackError
        return image

    def stills(self, number: int, samples: float) -> int:
        """The frames that stand in for what does not change in its shot, as far as the renderer draws any."""
        return self._screening.stills(number, samples) if self._traced else 0

    def told(self) -> dict[str, Any]:
        """The renderer, and what the film tells of itself."""
        return {"cameras": ["film"], "renderer": self._screening.frames.told(), "film": self._film.told(self._fps)}


def run(given: "Given", options: argparse.Namespace) -> None:
    """Draw the recording `options.recording` into `options.out` for `options.minutes`.

    Raises:
        WorldkitError: the recording is of another world, or cannot be read; the film asks for what may not be shown.
    """
    from worldkit import lights
    from worldkit.reporting import Progress

    from ..recording import stored
    from . import described
    from .known_pictures import drawn
    from .passes import headless_gl

    headless_gl()
    started = time.perf_counter()
    recording, model, out = stored.open(options.recording), given.model(), options.out
    film = described.read(options.film, recording, lights.of(model))
    name = named(options.film, recording.sha256, given.world)
    about = [given.size, given.fps, drawn(model).hex()]
    seconds = options.minutes * 60.0
    progress = Progress(out, round(seconds), "s")

    def tick() -> None:
        progress(min(round(time.perf_counter() - started), round(seconds)))

    with ExitStack() as stack:
        shown = OfTheAuthor(given, model, recording, film, stack, tick)
        end = started + drawing_s(seconds, shown.count, given.size)
        complete, state = refined(shown, out / FRAMES / name, about, end, tick)
        told = shown.told()
    encode(state, out / f"{NAME}.mp4", given.size, given.fps, Progress(out, shown.count, "frames in the file"))
    result = {"ok": True, "pass": NAME, **told, "frames": shown.count, "fps": given.fps, "size": list(given.size)}
    result |= {
        "seconds": shown.count / given.fps,
        **state.told(),
        "complete": complete,
        "trajectory_sha256": recording.sha256,
    }
    write_json(out / "result.json", {**result, "wall_s": round(time.perf_counter() - started, 3)})
    sys.stdout.write(f"{NAME}: {state.text()}, in {out}\n")


def drawing_s(seconds: float, count: int, size: Sequence[int]) -> float:
    """Seconds of those given in which frames are drawn; the rest is for the file, but never more than half."""
    return max(seconds / 2, seconds - ENCODE_S * count * size[0] * size[1] / (1280 * 720))


def refined(shown: OfTheAuthor, folder: Path, about: list[Any], end: float, tick: Any) -> "tuple[bool, Refined]":
    """`refine` on the frames in a folder; where a plainer renderer draws, from the start or since the other gave up, on those of
    its own, in a folder beside it: what was traced stands."""
    while True:
        plain = "" if shown.renderer == renderers.FINAL else f"-{shown.renderer}"
        own = folder.with_name(folder.name + plain)
        state = Refined(own, shown.count, json.dumps([own.name, *about, identity(shown.renderer).sha256]))
        with suppress(FellBackError):
            return refine(shown, state, end, tick), state


def named(described: Path, recording_sha256: str, world: Path) -> str:
    """The name of the set of frames of a film: a hash of its description, in this folder, and of what it shows: the motion, and
    the world's file, which also has all looks, lights and planned cameras."""
    files = [world, *sorted(described.iterdir())]
    said = [recording_sha256, *(hashlib.sha256(path.read_bytes()).hexdigest() for path in files)]
    return hashlib.sha256("\n".join(said).encode()).hexdigest()[:16]


class Pace:
    """What frames take for each sample a pixel, s: the `dearest` of a level, and the `recent` ones, by which the next is judged."""

    def __init__(self, level: float = 0.0, dearest: float = 0.0, recent: float = 0.0) -> None:
        self.level, self.dearest, self.recent = level, dearest, recent

    def expected(self, samples: float, first: bool, stills: int) -> float:
        """Seconds of a frame; if it is the `first` of its shot at this level, as many as the dearest, or as it and its `stills`."""
        return samples * (max(self.dearest, (1 + stills) * self.recent) if first else self.recent)

    def doubt(self, samples: float, took: float, stills: int) -> None:
        """Learn from a frame with which the renderer got ready: others take no longer, whatever an earlier process found."""
        each = took / samples
        self.dearest, self.recent = min(self.dearest, each), min(self.recent, each / (1 + stills))

    def add(self, samples: float, took: float, stills: int) -> None:
        """Learn what a frame and its `stills`, which were drawn with it, took, s."""
        each = took / samples
        self.dearest = max(each, self.dearest) if samples == self.level else each
        self.level, self.recent = samples, max(each / (1 + stills), CALMER * self.recent)


class Refined:
    """The frames drawn so far, with how many samples each.

    Args:
        folder: where they lie; those of another film, recording or renderer are forgotten.
        count: frames of the film.
        about: what they depend on, in one text.
    """

    def __init__(self, folder: Path, count: int, about: str) -> None:
        self._folder, self._about = folder, hashlib.sha256(about.encode()).hexdigest()
        folder.mkdir(parents=True, exist_ok=True)
        try:
            said = json.loads((folder / STATE).read_text(encoding="utf-8"))
            samples = [float(n) for n in said["samples"]] if said["about"] == self._about else []
            self.pace = Pace(*(float(n) for n in said["pace"])) if samples else Pace()
        except (OSError, ValueError, KeyError, TypeError):
            samples, self.pace = [], Pace()
        self.samples = samples if len(samples) == count else [0.0] * count
        self.samples = [n if self.path(k).is_file() else 0.0 for k, n in enumerate(self.samples)]
        self.taken_over = sum(n > 0 for n in self.samples)
        """So many frames stood already."""

    def path(self, number: int) -> Path:
        """The file of a frame."""
        return self._folder / f"{number:05d}.png"

    def keep(self, number: int, image: "np.ndarray", samples: float) -> None:
        """Replace a frame by a better one."""
        write_png(self.path(number), image)
        self.samples[number] = samples
        pace = [self.pace.level, self.pace.dearest, self.pace.recent]
        write_json(self._folder / STATE, {"about": self._about, "samples": self.samples, "pace": pace})

    def nearest(self, number: int) -> int:
        """The frame that is shown at this place: itself, or the last drawn before it, or the first of all."""
        drawn = [k for k, n in enumerate(self.samples) if n > 0]
        return max((k for k in drawn if k <= number), default=drawn[0])

    def told(self) -> dict[str, Any]:
        """How far it has come: `samples` a pixel, least and most; the number `drawn`; of these, those `taken_over`."""
        least, most = min(self.samples), max(self.samples)
        drawn = sum(n > 0 for n in self.samples)
        return {"samples": {"least": least, "most": most}, "drawn": drawn, "taken_over": self.taken_over}

    def text(self) -> str:
        """The same in words."""
        said = self.told()
        head = f"{said['drawn']} of {len(self.samples)} frames"
        return f"{head}, {said['samples']['least']:g} to {said['samples']['most']:g} samples a pixel"


def traced_levels() -> Iterator[float]:
    """Samples a pixel, round by round, without end."""
    yield DRAFT
    for number in itertools.count():
        yield FIRST * FACTOR**number


def rounds(shots: Sequence[range], levels: Iterable[float]) -> Iterator[tuple[int, float]]:
    """(frame, samples) in the order of drawing: of the film, and after its draft of each shot, every eighth frame first, then
    those between. What stands still in a shot is drawn once for it, and need not be kept for another."""
    parts: Sequence[range] = [range(shots[-1].stop)]
    for samples in levels:
        for part in parts:
            done: set[int] = set()
            for stride in STRIDES:
                for number in part[::stride]:
                    if number not in done:
                        done.add(number)
                        yield number, samples
        parts = shots


def refine(shown: Shown, state: Refined, end: float, tick: Any) -> bool:
    """Draw frames until the clock (`time.perf_counter`) reaches `end`, s; at least one that can be shown.

    Returns whether nothing is left that would make it better. A frame is begun only if it is likely to be done in time, by what
    the last ones took for each sample: the first of a shot are the dearest, since what stands still is drawn with them. The very
    first is begun whatever is expected, since that was found by another process, maybe beside others; and with it the renderer
    gets ready, which tells of those after it only that they take no longer.
    """
    begun: set[tuple[int, float]] = set()
    draft, now = next(iter(shown.levels())), time.perf_counter()
    for number, samples in rounds(shown.shots, shown.levels()):
        if state.samples[number] >= samples:
            continue
        shot = 0 if samples == draft else max(k for k, shot in enumerate(shown.shots) if shot.start <= number)
        first = (shot, samples) not in begun
        stills = shown.stills(number, samples) if first else 0
        if begun and now + state.pace.expected(samples, first, stills) > end:
            return False
        image = shown.picture(number, samples)
        learn = state.pace.add if begun else state.pace.doubt
        begun.add((shot, samples))
        since, now = now, time.perf_counter()  # what keeping the frame before it took is counted, too
        learn(samples, now - since, stills)
        state.keep(number, image, samples)
        tick()
    return True


def encode(state: Refined, path: Path, size: tuple[int, int], fps: int, tick: Callable[[int], object]) -> None:
    """Write the film out of the frames that there are; `tick` is called with the number written."""
    import cv2
    import numpy as np

    with Video(path, *size, fps) as film:
        last = -1
        image: np.ndarray = np.zeros(1)
        for number in range(len(state.samples)):
            nearest = state.nearest(number)
            if nearest != last:
                read = cv2.imread(str(state.path(nearest)), cv2.IMREAD_COLOR)
                assert read is not None  # it was written by us
                last, image = nearest, cv2.cvtColor(read, cv2.COLOR_BGR2RGB)
            film.add(image)
            tick(number + 1)

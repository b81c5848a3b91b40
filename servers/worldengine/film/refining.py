"""The final pass: a film that is whole after its first minute and becomes better until its minutes are over.

All frames are drafted first, at half the size with their surfaces' colours at the whole, every eighth, then those between, so that a film stands whenever it is cut: a frame that
is missing is shown by the one before it. Then they are drawn again in place, with more samples. What is drawn lies in
`frames/` and is gone on with later.
"""

import argparse
import hashlib
import json
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from worldkit.files import write_json

from . import renderers
from .encode import Video, write_png

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..given import Given
    from ..recording.stored import Recording
    from .described import Described

NAME, FRAMES, STATE = "final", "frames", "state.json"
LEVELS = (0.5, 2, 6, 18, 54)
"""Samples a pixel, round by round; less than one is a draft, which costs about a quarter of the next."""
STRIDES = (8, 4, 2, 1)
ENCODE_S = 0.06
"""Kept back for each frame of the film, s: reading it again and encoding it."""


class Shown(Protocol):
    """A film of which each frame can be drawn by itself."""

    count: int
    """The number of its frames."""

    def picture(self, number: int, samples: float) -> "np.ndarray":
        """One frame with so many samples a pixel: uint8 (height, width, 3)."""

    def told(self) -> dict[str, Any]:
        """What the result says of it: cameras, renderer, …"""


class OfThePlan:
    """The recording through one camera of the plan."""

    def __init__(
        self, model: "mujoco.MjModel", recording: "Recording", size: tuple[int, int], fps: int, stack: ExitStack
    ) -> None:
        from worldkit import cameras

        from ..recording.replay import Replay, frame_rows
        from .drawn_frames import Frames
        from .passes import choose_cameras

        self._name = choose_cameras(model, [])[0]
        self._model, self._replay = model, Replay(model, recording)
        cameras.aim(model, recording.pos, orientations=recording.quat, aspect=size[0] / size[1])
        self._rows = frame_rows(recording.time, fps)
        self.count = len(self._rows)
        self._frames = stack.enter_context(Frames(model, *size, renderers.FINAL))

    def picture(self, number: int, samples: float) -> "np.ndarray":
        """One frame."""
        from worldkit import cameras

        data = self._replay.show(int(self._rows[number]))
        cameras.track(self._model, data)
        return self._frames.image(data, self._name, samples)

    def told(self) -> dict[str, Any]:
        """The camera and the renderer."""
        return {"cameras": [self._name], "renderer": self._frames.told()}


class OfTheAuthor:
    """The film that `film.py` describes."""

    def __init__(
        self, given: "Given", model: "mujoco.MjModel", recording: "Recording", film: "Described", stack: ExitStack
    ) -> None:
        from .directed import Screening

        self._film, self._fps, self.count = film, given.fps, film.frames
        screening = Screening(given.world, model, recording, film, given.size, given.fps, renderers.FINAL)
        self._screening = stack.enter_context(screening)

    def picture(self, number: int, samples: float) -> "np.ndarray":
        """One frame, words and all."""
        return self._screening.picture(number, samples)

    def told(self) -> dict[str, Any]:
        """The renderer, and what the film tells of itself."""
        return {"cameras": ["film"], "renderer": self._screening.frames.told(), "film": self._film.told(self._fps)}


def run(given: "Given", options: argparse.Namespace) -> None:
    """Draw the recording `options.recording` into `options.out` for `options.minutes`.

    Raises:
        WorldkitError: the recording is of another world, or cannot be read; the film asks for what may not be shown.
    """
    from worldkit.reporting import Progress

    from ..recording import stored
    from . import described
    from .passes import headless_gl

    headless_gl()
    started = time.perf_counter()
    recording, model, out = stored.open(options.recording), given.model(), options.out
    film = None if options.film is None else described.read(options.film, recording)
    about = [recording.sha256, renderers.FINAL, given.size, given.fps]
    if film is not None:
        about += [_sha256(path) for path in sorted(options.film.iterdir())]
    seconds = options.minutes * 60.0
    tick = Progress(out, round(seconds), "s")
    with ExitStack() as stack:
        shown: Shown
        if film is not None:
            shown = OfTheAuthor(given, model, recording, film, stack)
        else:
            shown = OfThePlan(model, recording, given.size, given.fps, stack)
        told = shown.told()
        state = Refined(out / FRAMES, shown.count, json.dumps([*about, told["renderer"]]))
        end = started + seconds - ENCODE_S * shown.count
        refine(shown, state, end, lambda: tick(min(round(time.perf_counter() - started), round(seconds))))
        told = shown.told()
    encode(state, out / f"{NAME}.mp4", given.size, given.fps)
    result = {"ok": True, "pass": NAME, **told, "frames": shown.count, "fps": given.fps, "size": list(given.size)}
    result |= {"seconds": shown.count / given.fps, **state.told(), "trajectory_sha256": recording.sha256}
    write_json(out / "result.json", {**result, "wall_s": round(time.perf_counter() - started, 3)})
    sys.stdout.write(f"{NAME}: {state.text()}, in {out}\n")


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
        except (OSError, ValueError, KeyError, TypeError):
            samples = []
        self.samples = samples if len(samples) == count else [0.0] * count
        self.samples = [n if self.path(k).is_file() else 0.0 for k, n in enumerate(self.samples)]

    def path(self, number: int) -> Path:
        """The file of a frame."""
        return self._folder / f"{number:05d}.png"

    def keep(self, number: int, image: "np.ndarray", samples: float) -> None:
        """Replace a frame by a better one."""
        write_png(self.path(number), image)
        self.samples[number] = samples
        write_json(self._folder / STATE, {"about": self._about, "samples": self.samples})

    def nearest(self, number: int) -> int:
        """The frame that is shown at this place: itself, or the last drawn before it, or the first of all."""
        drawn = [k for k, n in enumerate(self.samples) if n > 0]
        return max((k for k in drawn if k <= number), default=drawn[0])

    def told(self) -> dict[str, Any]:
        """How far it has come: `samples` a pixel, least and most; the number `drawn`; whether it is `complete`."""
        least, most = min(self.samples), max(self.samples)
        drawn = sum(n > 0 for n in self.samples)
        return {"samples": {"least": least, "most": most}, "drawn": drawn, "complete": least >= LEVELS[-1]}

    def text(self) -> str:
        """The same in words."""
        said = self.told()
        head = f"{said['drawn']} of {len(self.samples)} frames"
        return f"{head}, {said['samples']['least']:g} to {said['samples']['most']:g} samples a pixel"


def rounds(count: int) -> Iterator[tuple[int, float]]:
    """(frame, samples) in the order of drawing: each level over every eighth frame first, then those between."""
    for samples in LEVELS:
        done: set[int] = set()
        for stride in STRIDES:
            for number in range(0, count, stride):
                if number not in done:
                    done.add(number)
                    yield number, samples


def refine(shown: Shown, state: Refined, end: float, tick: Any) -> None:
    """Draw frames until the clock (`time.perf_counter`) reaches `end`, s; at least one that can be shown.

    A frame is begun only if it is likely to be done in time, by what the last one took for each sample.
    """
    per_sample = 0.0
    for number, samples in rounds(shown.count):
        if state.samples[number] >= samples:
            continue
        now = time.perf_counter()
        if any(state.samples) and now + per_sample * samples > end:
            return
        state.keep(number, shown.picture(number, samples), samples)
        per_sample = (time.perf_counter() - now) / samples
        tick()


def encode(state: Refined, path: Path, size: tuple[int, int], fps: int) -> None:
    """Write the film out of the frames that there are."""
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


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()

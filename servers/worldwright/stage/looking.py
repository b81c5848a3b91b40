"""Look at a recording at once: one moment from anywhere, or five through every camera, each read by an instrument."""

from collections.abc import Sequence
from typing import Any

from pydantic import ValidationError

from ..model.errors import JobError, NotFoundError
from ..model.evidence.reports import EvidenceKey
from ..model.evidence.run import Run
from ..model.frozen import Frozen
from ..model.picture import Illustrated, Picture
from . import plain, storyboards
from .one_frame import FILM, FRAME, draw_frame, given_words, recorded
from .pictures import jpeg
from .short_runs import engine

WIDTH, MOST_BYTES = 960, 100_000
"""Pixels across one moment, and the most bytes of one picture or one sheet."""
TRACED_WIDTH, SAMPLES = 640, 8
"""Pixels across one that is traced, and its samples a pixel: light can be judged by it, and it takes seconds."""


class Reading(Frozen):
    """What an instrument reads in a picture; all but the pixels are from 0 to 1."""

    luma: float
    """Mean brightness."""
    blown: float
    """Share of the picture that is as good as white."""
    crushed: float
    """Share of it that is as good as black."""
    contrast: float
    """Standard deviation of brightness."""
    saturation: float
    """Mean of (max - min) / max over red, green and blue."""
    subjects: dict[str, int] = {}
    """Pixels of each moving body, with all that hangs on it; 0: it is not in the picture."""

    def text(self) -> str:
        """One line."""
        lost = f"{self.blown:.1%} blown, {self.crushed:.1%} crushed"
        head = f"luma {self.luma:.2f}, {lost}, contrast {self.contrast:.2f}, saturation {self.saturation:.2f}"
        return head + "".join(f", {name} {pixels} px" for name, pixels in self.subjects.items())


class Glance(Frozen):
    """One picture's place and time, and what an instrument reads in it."""

    camera: str
    at_s: float
    """Seconds of the recording."""
    word: str = ""
    """In a storyboard: setup, event, aftermath, or a claim."""
    reading: Reading

    def text(self) -> str:
        """One line."""
        return f"{self.camera} at {self.at_s:.3f} s{f' ({self.word})' if self.word else ''}: {self.reading.text()}"


class Looked(Frozen):
    """The pictures that were drawn, in their order; those of one camera of a storyboard lie on one sheet."""

    size: tuple[int, int]
    """Of one moment, pixels."""
    renderer: str
    glances: tuple[Glance, ...]

    def text(self) -> str:
        """A line for each moment."""
        return "\n".join(glance.text() for glance in self.glances)


def moment(
    run: Run,
    key: EvidenceKey,
    at_s: float,
    camera: str | None,
    eye: str | None,
    target: str | None,
    fov_deg: float,
    traced: bool = False,
) -> Illustrated:
    """One moment, through a camera of the plan, the film's own (the house's where there is no `film.py`), or one that stands at
    `eye` and looks at `target` ("x,y,z", m); `traced` by the renderer of the final pass, small and with few samples.

    Raises:
        GateError: nothing is recorded of this program and plan.
        NotFoundError: a place is no three numbers, or there is one without the other.
        JobError: there is no such camera, `film.py` does not run, or nothing can be traced here.
    """
    physics = recorded(run, key)
    through = standpoint(camera, eye, target, fov_deg)
    width, height = plain.read_json(physics / "program.json")["size"]
    across = min(TRACED_WIDTH if traced else WIDTH, width)
    size = across, max(16, round(across * height / width / 2) * 2)
    by = ["--samples", str(SAMPLES)] if traced else []
    found = draw_frame(run, physics, at_s, size, camera == FILM, [*through, *by], by)
    said = found["result.json"]
    if traced and (why := said["renderer"].get("because")):
        raise JobError(
            f"the final pass's renderer cannot draw here: {why}",
            code="missing_renderer",
            next_move="worldwright doctor; without --traced the usual renderer draws",
        )
    glance = _glance(str(said["cameras"][0]), said["recorded_s"], "", said["reading"])
    picture = Picture(_small(found[FRAME]), glance.text(), "jpeg")
    return Illustrated(_looked(said, (glance,)), (picture,))


def storyboard(run: Run, key: EvidenceKey) -> Illustrated:
    """Setup, three moments of the event and the aftermath, through every camera, on a sheet each.

    Raises:
        GateError: nothing is recorded of this program and plan.
    """
    physics = recorded(run, key)
    words = ["storyboard", *given_words(physics), *storyboards.arguments(run, key)]
    found = engine(words, (physics,), ("*.jpg",), run.folder)
    said = found["result.json"]
    glances = [
        _glance(camera, at, word, read)
        for camera in said["cameras"]
        for (at, word), read in zip(said["moments"], said["readings"][camera], strict=True)
    ]
    pictures = tuple(
        Picture(_small(found[f"{camera}.jpg"]), f"{camera}: storyboard, row by row", "jpeg")
        for camera in said["cameras"]
    )
    return Illustrated(_looked(said, tuple(glances)), pictures)


def standpoint(camera: str | None, eye: str | None, target: str | None, fov_deg: float) -> list[str]:
    """The engine's words for a camera of the plan, or for one that stands at `eye` and looks at `target`; none for the first.

    Raises:
        NotFoundError: a place is no three numbers, or there is one without the other, or with a name.
    """
    if (eye is None) != (target is None) or (eye is not None and camera is not None):
        raise NotFoundError(
            "an unplanned camera needs the place where it stands and the one that it looks at, and no name",
            next_move="--from 3,-2,1.5 --to 0,0,0.5 [--fov 40], or --camera NAME",
        )
    if eye is not None and target is not None:
        return [f"--eye={place(eye)}", f"--target={place(target)}", "--fovy", str(fov_deg)]
    return [] if camera is None else ["--camera", camera]


def place(text: str) -> str:
    """Three numbers, as they were given.

    Raises:
        NotFoundError: they are not.
    """
    try:
        numbers = [float(word) for word in text.split(",")]
        if len(numbers) != 3 or not all(abs(number) < 1e5 for number in numbers):
            raise ValueError(text)
    except ValueError as cause:
        raise NotFoundError(f"{text!r} is no place", next_move="give x,y,z in metres: --from 3,-2,1.5") from cause
    return ",".join(f"{number:.9g}" for number in numbers)


def _small(picture: bytes) -> bytes:
    """The same picture as a JPEG of at most `MOST_BYTES`."""
    import cv2
    import numpy as np

    image = cv2.imdecode(np.frombuffer(picture, np.uint8), cv2.IMREAD_COLOR)
    assert image is not None  # it is one of our own
    return jpeg(cv2.cvtColor(image, cv2.COLOR_BGR2RGB), MOST_BYTES)


def _glance(camera: str, at_s: Any, word: str, read: Any) -> Glance:
    return Glance(camera=camera, at_s=float(at_s), word=word, reading=Reading.model_validate(read))


def _looked(said: dict[str, Any], glances: Sequence[Glance]) -> Looked:
    try:
        return Looked(size=said["size"], renderer=said["renderer"]["name"], glances=tuple(glances))
    except (KeyError, TypeError, ValidationError) as cause:
        raise JobError(f"the picture came without its facts: {cause}", code="no_result") from cause

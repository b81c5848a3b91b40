"""Draw moments of a run at once, of its author's film or through any camera, or three of every shot; `drawn_once` keeps them."""

import math
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from worldkit.files import write_atomic
from worldkit.film_files import ARRAYS, DESCRIPTION

from ..model.belief import JUDGE_NOW
from ..model.errors import GateError, NotFoundError
from ..model.evidence import pictures_of
from ..model.evidence.reports import EvidenceKey
from ..model.evidence.run import Run
from ..model.picture import Illustrated, Picture
from . import authoring, gates, plain
from .kept_sculpts import given
from .pictures import BUDGET_BYTES, Shown, jpeg
from .short_runs import WALL_S, engine, run_process

SIZE, SHOT_WIDTH = (640, 360), 432
"""Of a moment of a film of 16:9, others as many pixels in their own shape; and across each on a sheet of shots."""
MOST_MOMENTS = 12
MOVING, ROUGH_SHEET = "moving.mp4", "moving.jpg"
ROUGH_S = 25.0
"""A film is drawn roughly in about so long, s; a longer one in fewer frames."""
FILM = "film"
FRAME = "frame.png"


def draw(
    run: Run,
    key: EvidenceKey,
    at_s: float | Sequence[float],
    camera: str | None = None,
    size: tuple[int, int] | None = None,
) -> Illustrated:
    """Draw the pictures of some moments in one process, and say what a whole film of them costs.

    Args:
        run: the run with its program and plan, and its film if it has one.
        key: the hashes of the recording.
        at_s: seconds of the film, or of the recording where a camera of the plan is named, or none is and there is no `film.py`.
        camera: a camera of the plan; None or `film` for the film's own; without a `film.py`, `film` is the house's own film.
        size: pixels; None: as many as `SIZE` has, in the film's own shape.

    Raises:
        GateError: nothing is recorded of this program and plan.
        JobError: `film.py` does not run, or asks for what may not be shown; the error has its line.
        NotFoundError: too many moments, or one before the start.
    """
    moments = [at_s] if isinstance(at_s, int | float) else list(at_s)
    if not (0 < len(moments) <= MOST_MOMENTS and all(0 <= at < 1e5 for at in moments)):
        raise NotFoundError(
            f"{len(moments)} moments, or one before the start, cannot be drawn at once",
            next_move=f"name 1 to {MOST_MOMENTS} in seconds from 0, or ask for every shot: `--show shots`",
        )
    filmed = camera == FILM or (camera is None and (run.folder / pictures_of.FILM).is_file())
    through = ["--camera", camera] if camera else []
    physics = recorded(run, key)
    found = draw_frame(run, physics, moments, size or _shaped(physics), filmed, through)
    said = found["result.json"]
    captions = []
    for row in said["moments"]:
        shown = f"{row['recorded_s']:.3f} s of the recording"
        captions.append(
            f"film at {row['film_s']:.2f} s: {shown}" if filmed else f"{', '.join(said['cameras'])}: {shown}"
        )
    lines = [*captions, *(_of_film(said) if filmed else ())]
    names = [FRAME, *(f"frame-{number}.png" for number in range(2, len(moments) + 1))]
    pictures = [Picture(found[name], caption) for name, caption in zip(names, captions, strict=True)]
    if len(pictures) > 1:  # one picture is sent as it was drawn, several only as far as they fit
        share = BUDGET_BYTES // len(pictures)
        pictures = [Picture(_smaller(one.data, share), one.caption, "jpeg") for one in pictures]
    return Illustrated(Shown(cameras=tuple(said["cameras"]), captions=tuple(lines)), tuple(pictures))


def each(
    run: Run, key: EvidenceKey, wanted: Sequence[tuple[str, float, str, tuple[int, int]]], within_s: float = math.inf
) -> tuple[list[bytes | None], dict[str, Any]]:
    """Draw pictures of many cameras in one process: PNG of each, None of those that would have begun after `within_s` seconds.

    Beside them, where one is of the film: what is told of it, described anew (`film`), and what frames of it by chance hide (`hides`).

    Args:
        run: the run with its program and plan, and its film if it has one.
        key: the hashes of the recording.
        wanted: of each whether it is drawn as a `still` or as a frame of a `video`, its moment, s (of the film for its own camera, `film`, else of the recording), its camera and its size, pixels.
        within_s: the first one is drawn all the same.

    Raises:
        GateError: nothing is recorded of this program and plan.
        JobError: one of them cannot be drawn, or the film cannot be described; nothing is drawn then.
        NotFoundError: too many pictures.
    """
    if not 0 < len(wanted) <= MOST_MOMENTS:
        raise NotFoundError(f"{len(wanted)} pictures cannot be drawn at once", next_move=f"name 1 to {MOST_MOMENTS}")
    words = [] if within_s == math.inf else ["--within", str(within_s)]
    for quality, at_s, camera, (width, height) in wanted:
        words += ["--seen", f"{quality}:{width}x{height}:{float(at_s)}:{camera}"]
    filmed = any(camera == FILM for _, _, camera, _ in wanted)
    named = (FRAME[:-4] + "*.png",)
    found = draw_frame(run, recorded(run, key), (), SIZE, filmed, words, words, named, wall_s=WALL_S * len(wanted))
    names = [FRAME, *(f"frame-{number}.png" for number in range(2, len(wanted) + 1))]
    return [found.get(name) for name in names], found["result.json"]


def _shaped(physics: Path) -> tuple[int, int]:
    """As many pixels as `SIZE` has, in the shape of the film, both sides even."""
    width, height = plain.read_json(physics / "program.json")["size"]
    scale = math.sqrt(math.prod(SIZE) / (width * height))
    return max(16, 2 * round(width * scale / 2)), max(16, 2 * round(height * scale / 2))


def shots(run: Run, key: EvidenceKey) -> Illustrated:
    """Draw every shot's first, middle and last frame on sheets, in one process, and read each: what to look at before a video pass.

    Raises:
        GateError: nothing is recorded of this program and plan.
        JobError: `film.py` does not run, or asks for what may not be shown; the error has its line.
    """
    physics = recorded(run, key)
    width, height = plain.read_json(physics / "program.json")["size"]
    size = SHOT_WIDTH, max(16, round(SHOT_WIDTH * height / width / 2) * 2)
    found = draw_frame(run, physics, (), size, True, (), ("--shots",), ("shots-*.jpg",))
    said = found["result.json"]
    lines = []
    for number, told in enumerate(said["film"]["shots"], 1):
        three = [row for row in said["moments"] if row["shot"] == number]
        sizes = [
            f"{name} {', '.join(str(row['reading']['subjects'].get(name, 0)) for row in three)} px"
            for name in three[0]["reading"]["subjects"]
        ]
        luma = ", ".join(f"{row['reading']['luma']:.2f}" for row in three)
        until = told["film_s"] + told["seconds"]
        times = f"{told['film_s']:.2f} to {until:.2f} s, recorded {told['from_s']:.2f} to {told['to_s']:.2f} s"
        lines.append(f"shot {number}: {times}, speed {told['speed']:g}; luma {luma}; {'; '.join(sizes)}")
    lines += [*said["unlit"], *_of_film(said), JUDGE_NOW]
    sheets = sorted((name for name in found if name.startswith("shots-")), key=lambda n: int(n[6:-4]))
    share = BUDGET_BYTES // max(len(sheets), 1)
    pictures = tuple(
        Picture(
            _smaller(found[name], share), f"shots, sheet {number}: first, middle and last of each, row by row", "jpeg"
        )
        for number, name in enumerate(sheets, 1)
    )
    return Illustrated(Shown(cameras=(FILM,), captions=tuple(lines)), pictures)


def moving(run: Run, key: EvidenceKey) -> Illustrated:
    """Draw the whole film roughly, to see it move: an MP4 of a quarter of its pixels and every second frame, and a sheet of it.

    Raises:
        GateError: nothing is recorded of this program and plan.
        JobError: `film.py` does not run, or asks for what may not be shown; the error has its line.
    """
    words = ["--moving", "--within", str(ROUGH_S)]
    found = draw_frame(
        run, recorded(run, key), (), SIZE, True, words, words, (MOVING, ROUGH_SHEET), sized=False, wall_s=6 * ROUGH_S
    )
    said = found["result.json"]
    rows = said["moments"]
    named = rows[0]["reading"]["subjects"]
    sizes = [
        f"{name} {min(px)} to {max(px)} px"
        for name in named
        for px in [[row["reading"]["subjects"].get(name, 0) for row in rows]]
    ]
    width, height = said["size"]
    lines = [
        f"roughly: {said['drawn']} of {said['frames']} frames, {width} x {height}; no evidence; {'; '.join(sizes)}",
        *(
            f"shot {n}: from {one['film_s']:.2f} s, {one['seconds']:.2f} s"
            for n, one in enumerate(said["film"]["shots"], 1)
        ),
        f"the film itself, {said['frames']} frames, takes about {minutes(said['frames'] * said['frame_s'])} to draw alone",
        JUDGE_NOW,
    ]
    sheet = Picture(_smaller(found[ROUGH_SHEET], BUDGET_BYTES), "the film, roughly, row by row", "jpeg")
    return Illustrated(Shown(cameras=(FILM,), captions=tuple(lines)), (sheet,), film=found[MOVING])


def _of_film(said: dict[str, Any]) -> list[str]:
    """What all of a film costs, what it only draws, and which looks it changes."""
    cost = minutes(said["frames"] * said["frame_s"])
    return [
        f"all {said['frames']} frames like {'this one' if len(said['moments']) == 1 else 'these'} take about {cost} to draw alone",
        f"drawn only: {', '.join(said['film']['drawn_only']) or 'nothing'}",
        *(f"{name} looks like {look}" for name, look in said["film"]["looks"].items()),
    ]


def _smaller(data: bytes, budget: int) -> bytes:
    """An encoded picture of ours as a JPEG of at most `budget` bytes."""
    import cv2
    import numpy as np

    image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)
    assert image is not None  # the engine has just encoded it
    return jpeg(cv2.cvtColor(image, cv2.COLOR_BGR2RGB), budget)


def draw_frame(
    run: Run,
    physics: Path,
    at_s: float | Sequence[float],
    size: tuple[int, int],
    filmed: bool,
    through: Sequence[str],
    more: Sequence[str] = (),
    wanted: Sequence[str] = (FRAME, "frame-*.png"),
    unmoved: bool = False,
    sized: bool = True,
    **limits: float,
) -> dict[str, Any]:
    """What the engine tells and leaves (`FRAME`, `frame-2.png` …) of moments of the film where it is `filmed`, else `through` a camera.

    Args:
        run: the run.
        physics: the evidence that holds its recording.
        at_s: seconds of the film, or of the recording.
        size: pixels.
        filmed: by the film's own camera: that of `film.py`, else of the house's film.
        through: the engine's words for a camera; the first of the plan when empty.
        more: further words for the engine, of a film.
        wanted: names of what the engine must leave, or patterns of what it may.
        unmoved: `physics` holds no recording, but a world that stands still.
        sized: whether the pictures have `size`; else the engine's own for what is asked.
        limits: of the process, if they are not the usual ones; see `short_runs`.
    """
    moments = [at_s] if isinstance(at_s, int | float) else at_s
    with tempfile.TemporaryDirectory(prefix="worldwright-frame-") as folder:
        told = [describe(run, physics, Path(folder), unmoved)] if filmed else []
        words = ["frame", *given_words(physics), *(("--size", f"{size[0]}x{size[1]}") if sized else ())]
        words += [word for at in moments for word in ("--at", str(float(at)))]
        words += ["--film", str(told[0]), *more] if told else through
        return engine(words, (physics, *told), wanted, run.folder, **limits)


def recorded(run: Run, key: EvidenceKey) -> Path:
    """The evidence of the physics pass; a `GateError` where nothing is recorded."""
    physics = run.evidence(key) / "physics"
    if gates.passed(run, key, "physics") is None:
        raise GateError(
            "there is no recording of this program and plan to show",
            place=str(physics),
            next_move=f"worldwright stage start {run.folder} --stage physics",
        )
    return physics


def minutes(seconds: float) -> str:
    """A duration as one says it."""
    return f"{seconds / 60:.0f} min" if seconds > 100 else f"{seconds:.0f} s"


def describe(run: Run, physics: Path, here: Path, unmoved: bool = False) -> Path:
    """Have the run's film described in the sandbox, or the house's own where it has none; returns the folder of the description, below `here`.

    `unmoved`: `physics` holds no recording, but a world that stands still.
    """
    source, told = here / "source", here / authoring.FOLDER
    files = pictures_of.files(run)
    for name, content in files.items():
        write_atomic(source / name, content)
    motion, written = source / authoring.MOTION, source / authoring.PROGRAM
    source.mkdir(parents=True, exist_ok=True)
    authoring.lay_out(physics / "trajectory", physics / "program.json", motion, run.source)
    call = authoring.call(written if written.is_file() else authoring.UNASKED, motion, "{out}", unmoved)
    found = run_process(call, (source,), (DESCRIPTION, ARRAYS), sculpts=given(files) if files else None)
    for name in (DESCRIPTION, ARRAYS):
        write_atomic(told / name, found[name])
    return told


def given_words(physics: Path) -> list[str]:
    """The engine's words for the world, its facts and its recording in the evidence of a physics pass."""
    files = {"world": "world.mjz", "program": "program.json", "inputs": "inputs.json", "from": "trajectory"}
    found = {name: physics / file for name, file in files.items() if name != "inputs" or (physics / file).is_file()}
    return [word for name, path in found.items() for word in (f"--{name}", str(path))]

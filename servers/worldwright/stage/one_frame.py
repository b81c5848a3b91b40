"""Draw one moment of a run at once, from its author's film or through any camera; the picture is not kept."""

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from worldkit.files import write_atomic
from worldkit.film_files import ARRAYS, DESCRIPTION

from ..model.errors import GateError
from ..model.evidence import pictures_of
from ..model.evidence.reports import EvidenceKey
from ..model.evidence.run import Run
from ..model.picture import Illustrated, Picture
from . import authoring, gates
from .kept_sculpts import given
from .pictures import Shown
from .short_runs import engine, run_process

SIZE = (640, 360)
FILM = "film"
FRAME = "frame.png"


def draw(
    run: Run, key: EvidenceKey, at_s: float, camera: str | None = None, size: tuple[int, int] = SIZE
) -> Illustrated:
    """Draw the picture of one moment, and say what a whole film of it costs.

    Args:
        run: the run with its program and plan, and its film if it has one.
        key: the hashes of the recording.
        at_s: seconds of the film, or of the recording where a camera of the plan is named, or none is and there is no `film.py`.
        camera: a camera of the plan; None or `film` for the film's own; without a `film.py`, `film` is the house's own film.
        size: pixels.

    Raises:
        GateError: nothing is recorded of this program and plan.
        JobError: `film.py` does not run, or asks for what may not be shown; the error has its line.
    """
    filmed = camera == FILM or (camera is None and (run.folder / pictures_of.FILM).is_file())
    through = ["--camera", camera] if camera else []
    found = draw_frame(run, recorded(run, key), at_s, size, filmed, through)
    said = found["result.json"]
    shown = f"{said['recorded_s']:.3f} s of the recording"
    caption = f"film at {said['film_s']:.2f} s: {shown}" if filmed else f"{', '.join(said['cameras'])}: {shown}"
    lines = [caption]
    if filmed:
        lines += [
            f"all {said['frames']} frames like this one take about {minutes(said['frames'] * said['frame_s'])} to draw"
        ]
        lines += [f"drawn only: {', '.join(said['film']['drawn_only']) or 'nothing'}"]
        lines += [f"{name} looks like {look}" for name, look in said["film"]["looks"].items()]
    picture = Picture(found[FRAME], caption)
    return Illustrated(Shown(cameras=tuple(said["cameras"]), captions=tuple(lines)), (picture,))


def draw_frame(
    run: Run, physics: Path, at_s: float, size: tuple[int, int], filmed: bool, through: Sequence[str]
) -> dict[str, Any]:
    """What the engine tells and leaves (`FRAME`) of one moment, of the film where it is `filmed`, else seen `through` a camera.

    Args:
        run: the run.
        physics: the evidence that holds its recording.
        at_s: seconds of the film, or of the recording.
        size: pixels.
        filmed: by the film's own camera: that of `film.py`, else of the house's film.
        through: the engine's words for a camera; the first of the plan when empty.
    """
    with tempfile.TemporaryDirectory(prefix="worldwright-frame-") as folder:
        told = [describe(run, physics, Path(folder))] if filmed else []
        words = ["frame", *given_words(physics), "--at", str(at_s), "--size", f"{size[0]}x{size[1]}"]
        words += ["--film", str(told[0])] if told else through
        return engine(words, (physics, *told), (FRAME,))


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


def describe(run: Run, physics: Path, here: Path) -> Path:
    """Have the run's film described in the sandbox, or the house's own where it has none; returns the folder of the description, below `here`."""
    source, told = here / "source", here / authoring.FOLDER
    files = pictures_of.files(run)
    for name, content in files.items():
        write_atomic(source / name, content)
    motion, written = source / authoring.MOTION, source / authoring.PROGRAM
    source.mkdir(parents=True, exist_ok=True)
    authoring.lay_out(physics / "trajectory", physics / "program.json", motion, run.source)
    call = authoring.call(written if written.is_file() else authoring.UNASKED, motion, "{out}")
    found = run_process(call, (source,), (DESCRIPTION, ARRAYS), sculpts=given(files) if files else None)
    for name in (DESCRIPTION, ARRAYS):
        write_atomic(told / name, found[name])
    return told


def given_words(physics: Path) -> list[str]:
    """The engine's words for the world, its facts and its recording in the evidence of a physics pass."""
    files = {"world": "world.mjz", "program": "program.json", "inputs": "inputs.json", "from": "trajectory"}
    return [word for name, file in files.items() for word in (f"--{name}", str(physics / file))]

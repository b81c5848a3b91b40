"""Draw one moment of a run at once, from its author's film or through a camera of the plan; the picture is not kept."""

import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from worldkit.files import write_atomic
from worldkit.filming.telling import ARRAYS, DESCRIPTION

from ..model.errors import GateError, JobError
from ..model.evidence import pictures_of
from ..model.evidence.reports import EvidenceKey
from ..model.evidence.run import Run
from ..model.picture import Illustrated, Picture
from . import authoring, compiled_shaders, confined, gates, plain
from .kept_sculpts import Given
from .limits import failed
from .pictures import Shown

SIZE = (640, 360)
FILM = "film"
MB = 1 << 20


def draw(
    run: Run, key: EvidenceKey, at_s: float, camera: str | None = None, size: tuple[int, int] = SIZE
) -> Illustrated:
    """Draw the picture of one moment.


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
    physics = recorded(run, key)
    authored = camera == FILM or (camera is None and (run.folder / pictures_of.FILM).is_file())
    with tempfile.TemporaryDirectory(prefix="worldwright-frame-") as folder:
        here = Path(folder)
        told = describe(run, physics, here) if authored else None
        words = ["frame", *given_words(physics), "--out", "{out}", "--at", str(at_s), "--size", f"{size[0]}x{size[1]}"]
        words += ["--film", str(told)] if told else ["--camera", camera] if camera else []
        found = run_process(
            [sys.executable, "-s", "-m", "worldengine", *words],
            (physics, *([told] if told else ())),
            ("frame.png",),
            here,
            compiled_shaders.lay,
        )
    said = found["result.json"]
    shown = f"{said['recorded_s']:.3f} s of the recording"
    caption = f"film at {said['film_s']:.2f} s: {shown}" if told else f"{', '.join(said['cameras'])}: {shown}"
    lines = [caption]
    if told:
        lines += [
            f"all {said['frames']} frames like this one take about {minutes(said['frames'] * said['frame_s'])} to draw"
        ]
        lines += [f"drawn only: {', '.join(said['film']['drawn_only']) or 'nothing'}"]
        lines += [f"{name} looks like {look}" for name, look in said["film"]["looks"].items()]
    picture = Picture(found["frame.png"], caption)
    return Illustrated(Shown(cameras=tuple(said["cameras"]), captions=tuple(lines)), (picture,))


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
    for name, content in pictures_of.files(run).items():
        write_atomic(source / name, content)
    motion, written = source / authoring.MOTION, source / authoring.PROGRAM
    source.mkdir(parents=True, exist_ok=True)
    authoring.lay_out(physics / "trajectory", physics / "program.json", motion, run.source)
    call = authoring.call(written if written.is_file() else authoring.UNASKED, motion, "{out}")
    found = run_process(call, (source,), (DESCRIPTION, ARRAYS), here)
    for name in (DESCRIPTION, ARRAYS):
        write_atomic(told / name, found[name])
    return told


def given_words(physics: Path) -> list[str]:
    """The engine's words for the world, its facts and its recording in the evidence of a physics pass."""
    files = {"world": "world.mjz", "program": "program.json", "inputs": "inputs.json", "from": "trajectory"}
    return [word for name, file in files.items() for word in (f"--{name}", str(physics / file))]


def run_process(
    call: Sequence[str],
    reads: Sequence[Path],
    wanted: Sequence[str],
    here: Path,
    home: Callable[[Path], object] | None = None,
    sculpts: Given | None = None,
) -> dict[str, Any]:
    """Run a process of the author or the engine, confined; returns what it left, by name, with its `result.json` read."""
    ended = confined.run(
        call,
        reads=reads,
        wanted=(*wanted, "result.json", "error.json"),
        wall_s=120.0,
        memory_mb=8192,
        file_mb=512,
        home=home,
        sculpts=sculpts,
    )
    said = {}
    for name in ("result.json", "error.json"):
        if name in ended.files:
            write_atomic(here / name, ended.files[name])
        said[name] = plain.read_json(here / name) if name in ended.files else {}
    if ended.status != "ended":
        failure: dict[str, str] | None = {"code": ended.status, "message": f"it was stopped: {ended.status}"}
    else:
        failure = failed(
            ended.exit_code, said["result.json"], said["error.json"], "worldwright stage frames RUN --at S"
        )
    if failure or any(name not in ended.files for name in wanted if "*" not in name):
        failure = failure or {"code": "no_result", "message": ended.log[-500:] or "it left nothing"}
        raise JobError(
            failure["message"],
            code=failure["code"],
            place=failure.get("place", ""),
            next_move=failure.get("next_move", ""),
        )
    return {**ended.files, "result.json": said["result.json"]}

"""`worldwright watch RUN`: one picture of a run, drawn again each time a file that decides it is saved, until it is ended.

What is recorded of program and plan is shown at the moment asked for; while nothing is, the world as it would start, which needs
no approval and leaves no evidence. `film.py` counts where the film itself is looked at, which it is by default where there is one.
"""

import contextlib
import signal
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import FrameType

import click

from worldkit.files import write_atomic

from .model import companions
from .model.errors import GateError, WorldwrightError
from .model.evidence.run import Run
from .model.picture import Illustrated
from .model.plan import taken_along

FILES = ("plan.md", "simulation.py", "film.py")
TICK_S, STILL_S = 0.2, 0.3
"""How often files are looked at, and how long they must stay as they are: an editor writes in several steps."""
PICTURE = "look.jpg"
Stamp = tuple[tuple[str, int, int], ...]


@click.command("watch")
@click.argument("run", type=click.Path(path_type=Path))
@click.option("--at", type=click.FloatRange(min=0), default=0.0, help="Seconds of the recording, or of the film.")
@click.option("--camera", help="A camera of the plan, or `film`; the film where there is one, else the first.")
@click.option("--from", "eye", help="x,y,z of a free camera, m.")
@click.option("--to", "target", help="x,y,z it looks at.")
@click.option("--fov", type=click.FloatRange(1, 150), default=45.0, help="Degrees.")
@click.option(
    "--save", type=click.Path(path_type=Path, file_okay=False), help="Folder of look.jpg; else the run's `out`."
)
def command(
    run: Path, at: float, camera: str | None, eye: str | None, target: str | None, fov: float, save: Path | None
) -> None:
    """Look at a run and leave it open: one frame now, and one for each change of plan.md, simulation.py, film.py or what they read."""
    from .cli import report_errors

    found = report_errors(lambda: Run.find(run))
    picture = (save or found.folder / "out") / PICTURE

    def draw() -> None:
        began = time.monotonic()
        try:
            shown = frame(found, at, camera, eye, target, fov)
        except WorldwrightError as error:  # whoever is writing saves what is half written, too
            for finding in getattr(error, "findings", ())[:5]:
                click.echo(str(finding))
            click.echo(f"{error.code}: {error}")
            return
        write_atomic(picture, shown.pictures[0].data)
        click.echo(
            f"{time.strftime('%H:%M:%S')} {picture} in {time.monotonic() - began:.1f} s: {shown.pictures[0].caption}"
        )

    with _ended_by_signals():
        watch(found, draw)
    sys.exit(0)


def frame(run: Run, at: float, camera: str | None, eye: str | None, target: str | None, fov: float) -> Illustrated:
    """The moment that is asked for; the start of the world where nothing is recorded of it as it stands."""
    from .stage.tools import look, look_at_start

    filmed = camera == "film" or (camera is None and eye is None and (run.folder / "film.py").is_file())
    try:
        return look(str(run.folder), at, "film" if filmed else camera, eye, target, fov)
    except GateError:  # nothing is recorded
        return look_at_start(run, None if filmed else camera, eye, target, fov)


def watch(run: Run, draw: Callable[[], None], ended: Callable[[], bool] = lambda: False) -> None:
    """Call `draw` now, and once for each change that came to rest, until `ended` or `KeyboardInterrupt`.

    Changes made while it draws are one change, drawn next.
    """
    with contextlib.suppress(KeyboardInterrupt):
        while True:
            drawn = state(run)
            draw()
            while state(run) == drawn:
                if ended():
                    return
                time.sleep(TICK_S)
            settled = state(run)
            while True:
                time.sleep(STILL_S)
                if settled == (settled := state(run)):
                    break


def state(run: Run) -> Stamp:
    """Names, times and sizes of the files that decide the picture."""
    paths = {run.folder / name for name in FILES}
    with contextlib.suppress(WorldwrightError, OSError):
        for author in (run.program, run.folder / "film.py"):
            if author.is_file():
                paths |= {run.folder / name for name in companions.of(author)}
    paths |= {run.folder / name for name in taken_along.of(run.folder)}
    found = []
    for path in sorted(paths):
        with contextlib.suppress(OSError):
            told = path.stat()
            found.append((str(path), told.st_mtime_ns, told.st_size))
    return tuple(found)


@contextlib.contextmanager
def _ended_by_signals() -> Iterator[None]:
    """Let a request to end be one at the keyboard."""

    def end(_number: int, _frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    before = {number: signal.signal(number, end) for number in (signal.SIGTERM, signal.SIGHUP)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)

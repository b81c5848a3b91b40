"""How a world starts, before anything of it is approved, recorded or kept: the program as it stands, built and drawn."""

import sys
import tempfile
from pathlib import Path

from worldkit.files import write_atomic

from ..model import companions, syntax
from ..model.errors import JobError
from ..model.evidence.run import Run, sha256_file
from ..model.picture import Illustrated, Picture
from ..model.plan import imported
from . import kept_sculpts, sculpting_step
from .looking import Looked, standpoint
from .short_runs import engine, run_process

WORLD, FACTS, SHEET = "world.mjz", "program.json", "sheet.jpg"
SIZE = "960x540"
AGAIN = "worldwright watch RUN"


def at_start(run: Run, camera: str | None, eye: str | None, target: str | None, fov_deg: float) -> Illustrated:
    """The world of a run at t = 0, through one of its cameras, or one that stands at `eye` and looks at `target`.

    A program that is as it was drafted is drafted anew from the plan as it stands.

    Raises:
        NotFoundError, PlanError: there is no program, and no plan that makes one; or `eye` and `target` are no standpoint.
        JobError: the program does not run; the error has its line.
    """
    through = standpoint(camera, eye, target, fov_deg)
    with tempfile.TemporaryDirectory(prefix="worldwright-first-") as folder:
        here = Path(folder)
        built(run, here)
        words = ["sheet", f"--world={here / WORLD}", f"--program={here / FACTS}", "--size", SIZE, *through]
        found = engine(words, (here / WORLD, here / FACTS), (SHEET,), again=AGAIN)
    said = found["result.json"]
    caption = f"{', '.join(said['cameras'])} at the start; nothing is recorded of this program and plan"
    shown = Looked(size=said["size"], renderer=said["renderer"]["name"], glances=())
    return Illustrated(shown, (Picture(found[SHEET], caption, "jpeg"),))


def built(run: Run, here: Path) -> None:
    """Build the program's world in the sandbox, and leave it and its facts in the folder `here`: `WORLD`, `FACTS`.

    Raises:
        PlanError, JobError: as `at_start`.
    """
    from ..model.plan.plan_text import read_plan

    plan = read_plan(run.plan).plan if run.plan.is_file() else None
    if plan is not None:
        sculpting_step.prepare(plan)
    program, beside = _program(run)
    files = {"simulation.py": program, **beside}
    for name, content in files.items():
        _readable(run.folder / name, content)
    source = here / "source"
    for name, content in files.items():
        write_atomic(source / name, content)
    words = [sys.executable, "-s", str(source / "simulation.py"), "--pass", "build", "--out", "{out}"]
    made = run_process(words, (source,), (WORLD, FACTS), sculpts=kept_sculpts.given(files), again=AGAIN)
    for name in (WORLD, FACTS):
        write_atomic(here / name, made[name])


def _readable(path: Path, content: bytes) -> None:
    """Tell what is half written by its line, before it is run."""
    try:
        if path.suffix == ".py":
            syntax.module(content)
    except (SyntaxError, ValueError) as cause:
        where = f"{path}:{cause.lineno}" if isinstance(cause, SyntaxError) else str(path)
        raise JobError(f"it is not Python: {cause}", code="unreadable", place=where, next_move="correct it") from cause


def _program(run: Run) -> tuple[bytes, dict[str, bytes]]:
    """The program as it stands, and the files beside it; a draft of an older plan, or none, is drafted from the plan as it stands,
    without the laws of the author's, which need not be written yet."""
    from ..draft import draft
    from ..model.plan.plan_text import read_plan
    from ..place.tools import laid_out

    if run.program.is_file():
        present = sha256_file(run.program)
        if not any(e.get("action") == "draft" and e.get("program_sha256") == present for e in run.entries()):
            return run.program.read_bytes(), companions.of(run.program)
    plan = read_plan(run.plan).plan
    layout = laid_out(plan)
    if run.program.is_file() and run.program.read_text(encoding="utf-8") == draft(plan, layout).source:
        return run.program.read_bytes(), companions.of(run.program)
    return draft(plan, layout, alone=True).source.encode(), imported.contents(plan)

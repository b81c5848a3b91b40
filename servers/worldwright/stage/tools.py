"""The tools of `stage`: start a pass, follow it, look at what it shows."""

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from ..expose import Also, Positional, reads
from ..model.errors import NotFoundError
from ..model.evidence.reports import PASSES, PassName
from ..model.evidence.run import Run
from ..model.frozen import Frozen
from ..model.picture import Illustrated
from ..model.progress import Progress, silent
from .disk import Disk, used
from .for_servers import (
    compile_laws,
    declared_inputs,
    draw_moments,
    free_earlier,
    latest,
    look_at_start,
    may_run_strangers,
    model_files,
    read_plain,
    run_confined,
    run_variant,
    sculpt_of,
    simulate_given,
    spent,
    start_fresh,
    start_storyboard,
    try_film,
    variant_folder,
)
from .job import Job, JobStatus

__all__ = [
    "TOOLS",
    "compile_laws",
    "declared_inputs",
    "draw_moments",
    "free_earlier",
    "latest",
    "look_at_start",
    "may_run_strangers",
    "model_files",
    "read_plain",
    "run_confined",
    "run_variant",
    "sculpt_of",
    "simulate_given",
    "spent",
    "start_fresh",
    "start_storyboard",
    "try_film",
    "variant_folder",
]

RunName = Annotated[str, Field(description="The run folder, or its name.")]
JobName = Annotated[str | None, Field(description="Job id; the latest pass when left out.")]
PAGE = 16_000


class RunStages(Frozen):
    """The passes of the current program and plan, and the run's latest jobs."""

    key: str
    passed: tuple[PassName, ...]
    jobs: tuple[JobStatus, ...]
    """The jobs of the passes, newest first, at most ten."""
    audits: tuple[JobStatus, ...] = ()
    """Repetitions for an audit that are under way, too."""
    disk: Disk | None = None
    """What the run takes, and what `worldwright gc` would free."""

    def text(self) -> str:
        """The jobs, one per line."""
        head = f"key {self.key}: {', '.join(self.passed) or 'no pass'} succeeded"
        tail = [self.disk.text()] if self.disk else []
        return "\n".join([head, *(job.text() for job in (*self.jobs, *self.audits)), *tail])


class LogPage(Frozen):
    """A stretch of a job's log."""

    job: str
    content: str
    offset: int
    next_offset: int | None
    size: int

    def text(self) -> str:
        """The log itself."""
        return self.content


class Drafted(Frozen):
    """The outcome of a draft."""

    file: str
    outcome: Literal["written", "unchanged", "kept"]
    """It is `kept` when an author's program exists, which is not touched."""
    lines: int
    open_places: tuple[str, ...] = ()
    """Places left to the author, each marked `AUTHOR:` in the file."""
    unread: tuple[str, ...] = ()
    """Constants of the plan that the draft reads nowhere."""
    film: str = ""
    """The first `film.py`, if it was written just now."""

    def text(self) -> str:
        """One line, the open places, and the constants without a reader."""
        left = "".join(f"\n- AUTHOR: {place}" for place in self.open_places)
        if self.outcome != "kept" and not self.open_places:
            left = ", no open places"
        if self.unread:
            left += f"\n- read nowhere: {', '.join(self.unread)}; does a step's description ask for them?"
        if self.film:
            left += f"\n{self.film}: a first film, drafted; change what it marks CHANGE"
        return f"{self.file}: {self.outcome}, {self.lines} lines{left}"


def draft(run: RunName) -> Drafted:
    """Write simulation.py from the approved plan, as far as the plan declares the world, and a first film.py if there is none.

    For rigid bodies, joints and initial motion the draft is whole; what else the plan asks for is left as places marked
    `AUTHOR:`. What an author wrote is never overwritten.
    """
    from ..draft.writing import write_film, write_program

    found = Run.find(run)
    written = write_program(found, actor="code")
    return Drafted.model_validate(
        {
            "file": str(found.program),
            "outcome": written.outcome,
            "lines": written.lines,
            "open_places": written.open_places,
            "unread": written.unread,
            "film": str(found.folder / "film.py") if write_film(found, actor="code") else "",
        }
    )


def start(
    run: Annotated[
        str | None, Field(description="The run folder; with `model`, where to record it."), Positional()
    ] = None,
    stage: Annotated[
        PassName, Field(description="bundle, physics, storyboard, stills, video; final: a traced film."), Also("--pass")
    ] = "physics",
    force: Annotated[bool, Field(description="Run again although it succeeded, and compare.")] = False,
    still_s: Annotated[float, Field(description="Ended when nothing advances for so long.", gt=0)] = 180,
    memory_mb: Annotated[int, Field(description="Resident memory limit (final: 6144 at least).", ge=64)] = 4096,
    cpu_s: Annotated[float | None, Field(description="Limit of processor time.", gt=0)] = None,
    file_mb: Annotated[int, Field(description="Size limit of one file.", ge=1)] = 2048,
    disk_mb: Annotated[int, Field(description="Size limit of all it writes.", ge=1)] = 8192,
    model: Annotated[
        Path | None,
        Field(description="MJCF or URDF (or a folder, an archive) to record without any plan."),
    ] = None,
    duration: Annotated[float | None, Field(description="Simulated seconds of `model`.", gt=0, le=3600)] = None,
    minutes: Annotated[float, Field(description="`final` draws for so long; again goes on.", gt=0, le=600)] = 5,
) -> JobStatus:
    """Start one pass of the run's program in the sandbox and return at once with its job; follow it with `wait`.

    Physics needs an approved plan and a clean lint; what needs a pass under way queues. What succeeded for this program,
    plan and environment is answered from its evidence. With `model`, any MJCF file is recorded (runs/<its name>).
    `final` needs physics alone: film.py's film (else our own) traced, whole soon, then better.
    """
    from ..model.evidence import environment
    from . import bare_models, refined, storyboards
    from .account import with_account
    from .launch import launch

    if model is not None:
        folder = bare_models.prepare(model, duration, Path(run) if run else None)
    elif run is None:
        raise NotFoundError("name a run, or a model to record", next_move="worldwright stage start RUN")
    elif duration is not None:
        raise NotFoundError("a run's duration is in its plan", next_move="give duration only together with model")
    else:
        folder = Run.find(run)
    key = folder.evidence_key(environment.current().sha256())
    limits: dict[str, Any] = {"still_s": still_s, "memory_mb": memory_mb, "cpu_s": cpu_s}
    if stage == "storyboard":
        limits["arguments"] = storyboards.arguments(folder, key)
    elif stage == "final":
        limits |= {"arguments": refined.arguments(minutes), "memory_mb": max(memory_mb, refined.MEMORY_MB)}
        limits["still_s"] = max(still_s, 60 * minutes)  # one frame of many samples may take all the minutes given
    job = launch(folder, key, stage, force=force, **limits, file_mb=file_mb, disk_mb=disk_mb)
    return with_account(folder, job) if job.cached else job


@reads
def wait(
    run: RunName,
    job: JobName = None,
    timeout_s: Annotated[float, Field(description="Return after this long at the latest.", gt=0, le=40)] = 40,
    progress: Progress = silent,
) -> JobStatus:
    """Wait until a job ends, or `timeout_s` has passed, reporting progress on the way; call again while it runs.

    Of a finished physics pass it tells what the recording shows at a glance: warnings, what acted besides the engine's
    step, the deepest penetration, the speed, which movers never moved.
    """
    from .account import with_account
    from .variants import follow

    folder = Run.find(run)
    return with_account(folder, follow(Job.find(folder, job), timeout_s, progress))


@reads
def status(run: RunName) -> RunStages:
    """Which passes have succeeded for the current program and plan, how the latest jobs stand, what disk the run takes."""
    from ..model.evidence import environment
    from . import gates
    from .account import with_account

    folder = Run.find(run)
    key = folder.evidence_key(environment.current().sha256())
    passed = tuple(stage for stage in PASSES if gates.passed(folder, key, stage) is not None)
    known = Job.all(folder)
    jobs = [job.read() for job in [job for job in known if not job.spec.variant][:10]]
    newest = next((n for n, job in enumerate(jobs) if job.stage == "physics"), None)
    if newest is not None:
        jobs[newest] = with_account(folder, jobs[newest])
    audits = tuple(job for job in (job.read() for job in known if job.spec.variant) if not job.ended)
    return RunStages(key=key.key, passed=passed, jobs=tuple(jobs), audits=audits, disk=used(folder, key))


def cancel(run: RunName, job: JobName = None) -> JobStatus:
    """Stop a job, or without one every pass that runs (no audit), and everything it started. Earlier evidence is untouched."""
    folder = Run.find(run)
    found = [] if job else [one for one in Job.all(folder) if not (one.spec.variant or one.read().ended)]
    # Told is the oldest that runs, or is about to: others wait for it.
    first = next((one for one in reversed(found) if one.read().state == "running"), None)
    first = first or (found[-1] if found else Job.find(folder, job))
    for one in found or [first]:  # the newest first, as it may wait for an older one
        one.cancel()
    others = tuple(f"ended with it: {one.folder.name}" for one in found if one is not first)
    told = first.read()
    return told.model_copy(update={"account": (*told.account, *others)})


@reads
def frames(
    run: RunName,
    camera: Annotated[str | None, Field(description="One camera; all of them when left out.")] = None,
    count: Annotated[int, Field(description="Pictures on a contact sheet.", ge=1, le=24)] = 8,
    show: Annotated[
        Literal["all", "storyboard", "stills", "sheet", "key", "reference", "shots", "moving"],
        Field(
            description="Stills, contact sheets, key frames (setup, midway, event, aftermath), or all of them; `storyboard`: five "
            "moments a camera, there before all others; `reference`: the given image beside the first camera's still; "
            "`shots`: film.py's, first, middle and last of each, drawn now; `moving`: all of it, roughly, a film and its sheet, within s."
        ),
    ] = "all",
    start_s: Annotated[float, Field(description="Contact sheets begin at this time.", ge=0)] = 0.0,
    end_s: Annotated[float | None, Field(description="And end at this one; None is the film's end.", ge=0)] = None,
    at: Annotated[
        list[float] | float | None,
        Field(description="Draw these moments now: s of film.py's film, or of the recording with a `camera`."),
    ] = None,
) -> Illustrated:
    """Show the current program's pictures: stills, a contact sheet of each film with the times, and key frames.

    Key frames are chosen by motion energy: the setup, the event (where it changes fastest) and the aftermath (where
    it has calmed down), with one on the way there. `count: 1` shows one frame, at `start_s`, as large as it fits.
    Together under 1 MB; with many cameras, name one to see it larger.
    """
    from ..model.evidence import environment
    from . import gates, storyboards
    from .pictures import beside, contact

    folder = Run.find(run)
    key = folder.evidence_key(environment.current().sha256())
    if at is not None and at != []:
        from . import drawn_once
        from .one_frame import SIZE, draw

        asked = {"at": at, "camera": camera, "size": SIZE}
        return drawn_once.drawn(folder, key, "moments", asked, lambda: draw(folder, key, at, camera))
    if show == "moving":
        from . import drawn_once
        from .one_frame import moving

        return drawn_once.drawn(folder, key, "moving", {}, lambda: moving(folder, key))
    if show == "shots":
        from . import drawn_once
        from .one_frame import SHOT_WIDTH, shots

        return drawn_once.drawn(folder, key, "shots", {"width": SHOT_WIDTH}, lambda: shots(folder, key))
    evidence = folder.evidence(key)
    if show == "storyboard":
        return storyboards.shown(evidence, camera)
    other = gates.of_another_film(folder, key)
    if (other or not any((evidence / name).is_dir() for name in ("stills", "video"))) and folder.accepted.is_dir():
        evidence = folder.accepted  # it was accepted elsewhere: the pictures that came with it stand in
    elif other:
        raise NotFoundError(
            f"the {other[0]} of this program were made by other film code, or another renderer, than there is now",
            place=str(evidence / other[0]),
            next_move=f"worldwright stage start {folder.folder} --stage {other[0]}",
        )
    if end_s is not None and end_s < start_s:
        raise NotFoundError(f"the sheet would end at {end_s:g} s, before it begins", next_move="give end_s >= start_s")
    if show == "reference":
        given = next((p for p in sorted(folder.folder.glob("reference.*")) if p.suffix != ".md"), None)
        return beside(given or folder.folder / "reference.png", evidence, camera or _first_camera(folder))
    return contact(evidence, camera, count, show, (start_s, 1e9 if end_s is None else end_s))


@reads
def sheet(
    thing: Annotated[str, Field(description="FILE.py or FILE.py:NAME (else the last thing in it).")],
) -> Illustrated:
    """Draw what a file sculpts from four sides, with extents, mass and hulls: `skills/sculpting`."""
    from .sheets import drawn

    return drawn(thing)


def _first_camera(run: Run) -> str:
    """The plan's first camera; with a reference image, it looks from where that was taken."""
    from ..model.plan.plan_text import read_plan

    return next((camera.name for camera in read_plan(run.plan).plan.cameras()), "")


@reads
def look(
    run: RunName,
    at: Annotated[float | None, Field(description="Recorded s, or of the film.", ge=0)] = None,
    camera: Annotated[str | None, Field(description="A camera of the plan, or `film`.")] = None,
    eye: Annotated[str | None, Field(description="x,y,z of a free camera, m."), Also("--from")] = None,
    target: Annotated[str | None, Field(description="x,y,z it looks at."), Also("--to")] = None,
    fov: Annotated[float, Field(description="Degrees.", gt=1, lt=150)] = 45,
    traced: Annotated[bool, Field(description="One moment in the final pass's light.")] = False,
) -> Illustrated:
    """See a recording at once: one moment through any camera, planned or not; else a storyboard of all cameras.

    With each picture: luma, blown and crushed shares, contrast, each mover's pixels.
    """
    from ..model.evidence import environment
    from . import looking

    folder = Run.find(run)
    key = folder.evidence_key(environment.current().sha256())
    if (at, camera, eye, target) == (None,) * 4 and not traced:
        return looking.storyboard(folder, key)
    return looking.moment(folder, key, at or 0.0, camera, eye, target, fov, traced)


@reads
def log(
    run: RunName,
    job: JobName = None,
    offset: Annotated[int, Field(description="Byte to start from.", ge=0)] = 0,
) -> LogPage:
    """Read what a job's program printed, a page at a time."""
    found = Job.find(Run.find(run), job)
    path = found.log
    if not path.is_file():
        raise NotFoundError("this job has printed nothing yet", place=str(path), next_move="wait for it")
    size = path.stat().st_size
    with path.open("rb") as stream:
        stream.seek(offset)
        content = stream.read(PAGE)
    end = offset + len(content)
    name, text, more = found.folder.name, content.decode(errors="replace"), end if end < size else None
    return LogPage(job=name, content=text, offset=offset, next_offset=more, size=size)


TOOLS = (draft, start, wait, status, cancel, look, frames, sheet, log)

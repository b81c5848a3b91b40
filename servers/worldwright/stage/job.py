"""A job on disk: its specification, its state, and how to tell a live one from one that was killed.

`jobs/<id>/` holds `spec.json` (what to do, written once), `state.json` (written by the supervisor alone),
`inputs/` (the snapshot that is run), `filming/` (all that the author of its film sees), `author/` (what the program's process
writes), `out/` (what the engine writes, which becomes evidence), `log.txt`, `lock` (held by the live supervisor) and, once asked
for, `cancel`.
"""

import json
import time
from pathlib import Path
from typing import Literal

from pydantic import ValidationError

from worldkit import lock
from worldkit.files import write_atomic, write_json

from ..model import companions, try_lock
from ..model.errors import GateError, NotFoundError
from ..model.evidence import pictures_of
from ..model.evidence.reports import EvidenceKey, PassName
from ..model.evidence.run import Run
from ..model.frozen import Frozen
from ..model.storage import link_on_the_way
from .gates import folder_name, passed
from .sandbox.confinement import gl_backend

CANCEL_S = 10.0
"""A job that is cancelled is waited for so long."""
State = Literal["queued", "running", "succeeded", "failed", "cancelled", "lost"]


class Spec(Frozen):
    """What a job does, fixed when it starts."""

    job: str
    run: str
    stage: PassName
    variant: str = ""
    """Name of a repetition beside the pass's evidence; empty for the pass itself."""
    arguments: tuple[str, ...] = ()
    """More words on the program's command line."""
    key: EvidenceKey
    film_sha256: str = ""
    """For pictures: the identity of the film that is made."""
    still_s: float
    """The job ends when nothing advances for so long, s; while it advances, it may take all the time it needs."""
    memory_mb: int
    output_mb: int
    file_mb: int
    cpu_s: float | None = None
    """Processor time of all its processes together; None: no limit."""
    disk_mb: int
    """The most that it may write in all, MiB."""
    reads: tuple[str, ...] = ()
    """Files outside its folder that the program may read: what a recorded model is made of."""
    reuse: tuple[str, ...] = ()
    """Folders of earlier passes whose recording or pictures may fit already."""
    given: str = ""
    """A folder with a world, its facts and its recorded inputs, which are simulated without running the program."""
    after: str = ""
    """The job that makes what this one needs; this one waits for its end."""
    token: int = 0
    """A number that each of its processes carries as a resource limit."""
    force: bool = False
    fresh: bool = False
    """It proves what the program makes, so it is given no shape that was kept of an earlier run."""
    created: float
    """Seconds since the epoch."""


class JobStatus(Frozen):
    """The state of a job."""

    job: str
    stage: PassName
    variant: str = ""
    key: str
    state: State
    cached: bool = False
    """The answer came from evidence: nothing ran."""
    code: str = "ok"
    message: str = ""
    place: str = ""
    next_move: str = ""
    done: float = 0
    total: float = 0
    unit: str = ""
    wall_s: float = 0
    cpu_s: float = 0
    """Processor time of all its processes, once it has ended, s."""
    eta_s: float | None = None
    sandbox: str = ""
    result: str = ""
    """The folder of what the pass made, once it has succeeded."""
    account: tuple[str, ...] = ()
    """For a finished physics pass: speed, warnings, what acted, the deepest penetration, what never moved. Of one just asked for:
    which outdated jobs were ended for it."""

    @property
    def name(self) -> str:
        """The pass, and its variant if it is one."""
        return folder_name(self.stage, self.variant)

    @property
    def ok(self) -> bool:
        """Whether it has not failed."""
        return self.state in ("queued", "running", "succeeded")

    @property
    def ended(self) -> bool:
        """Whether it has ended and will not change any more."""
        return self.state not in ("queued", "running")

    def text(self) -> str:
        """One line, and the cause when it failed."""
        line = f"{self.name} {self.state}" + (" (from its evidence)" if self.cached else "")
        line += f" · job {self.job} · {self.wall_s:.1f} s" + (f" · sandbox {self.sandbox}" if self.sandbox else "")
        if self.state == "running" and self.total:
            line += f" · {self.done:g}/{self.total:g} {self.unit}"
            line += f", about {self.eta_s:.0f} s left" if self.eta_s is not None else ""
        line += f"\n{self.result}" if self.result else ""
        line += "".join(f"\n- {said}" for said in self.account)
        if self.message:
            line += f"\n{self.code}: {f'{self.place}: ' if self.place else ''}{self.message}"
        return line + (f"\nnext: {self.next_move}" if self.next_move else "")


class Job:
    """One job folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.out = folder / "out"
        self.author = folder / "author"
        self.filming = folder / "filming"
        self.inputs = folder / "inputs"
        self.scratch = folder / "tmp"
        self.lock = self.inputs / "environment.json"
        self.log = folder / "log.txt"

    @classmethod
    def create(cls, run: Run, spec: Spec) -> "Job":
        """Lay out a new job with a snapshot of the program and the plan, for which its result will vouch."""
        job = cls(run.jobs / spec.job)
        for folder in (job.out, job.inputs, job.scratch):
            folder.mkdir(parents=True)
        for path in (run.program, run.source):
            write_atomic(job.inputs / path.name, path.read_bytes())
        for name, content in companions.of(run.program).items():
            write_atomic(job.inputs / name, content)
        for name, content in pictures_of.files(run).items() if spec.stage in pictures_of.AUTHORED else ():
            write_atomic(job.filming / name, content)
        write_json(job.lock, lock.observe(gl_backend()))
        write_json(job.folder / "spec.json", spec.model_dump(mode="json"))
        return job

    @classmethod
    def all(cls, run: Run) -> "list[Job]":
        """Every readable job, newest first: by their numbers, since a clock may jump.

        Raises:
            GateError: the folder of the jobs is a link: what lies behind it is no job of this run.
        """
        return [cls(path.parent) for path in sorted(_specs(run), key=_number, reverse=True)]

    @classmethod
    def next_number(cls, run: Run) -> int:
        """The number after the newest job's."""
        return max(map(_number, _specs(run)), default=0) + 1

    @classmethod
    def find(cls, run: Run, name: str | None) -> "Job":
        """A job by id, or the latest pass, never an audit's repetition; a `NotFoundError` lists the known ones."""
        known = cls.all(run)
        if name is None and known:
            return next((job for job in known if not job.spec.variant), known[0])
        for job in known:
            if job.folder.name == name:
                return job
        raise NotFoundError(
            f"there is no job '{name}' in this run" if name else "no job was started in this run",
            place=str(run.jobs),
            next_move=f"known jobs: {', '.join(job.folder.name for job in known[:10]) or '(none)'}; "
            f"start one with `worldwright stage start {run.folder}`",
        )

    @property
    def spec(self) -> Spec:
        """What the job does."""
        try:
            return Spec.model_validate_json((self.folder / "spec.json").read_text(encoding="utf-8"))
        except (OSError, ValidationError) as cause:
            raise NotFoundError(
                f"the job's specification cannot be read: {cause}",
                place=str(self.folder / "spec.json"),
                next_move="start the pass again",
            ) from cause

    def write(self, state: JobStatus) -> None:
        """Publish the state (the supervisor's call)."""
        write_json(self.folder / "state.json", state.model_dump(mode="json"))

    def read(self) -> JobStatus:
        """The state now; it is `lost` when the supervisor died without a word."""
        spec = self.spec
        try:
            state = JobStatus.model_validate_json((self.folder / "state.json").read_text(encoding="utf-8"))
        except (OSError, ValidationError):
            state = JobStatus(job=spec.job, stage=spec.stage, variant=spec.variant, key=spec.key.key, state="queued")
        if state.ended or self.supervised():
            return state
        try:  # the job may have ended between the two looks
            again = json.loads((self.folder / "state.json").read_text(encoding="utf-8"))
            if again.get("state") not in ("queued", "running"):
                return JobStatus.model_validate(again)
        except (OSError, ValueError):
            pass
        run = Run(spec.run)
        if (proof := passed(run, spec.key, spec.stage, spec.variant)) and proof.get("job") == spec.job:
            # The supervisor was killed between its last two steps: its result stands.
            folder = run.evidence(spec.key) / folder_name(spec.stage, spec.variant)
            return state.model_copy(update={"state": "succeeded", "code": "ok", "result": str(folder)})
        return state.model_copy(
            update={
                "state": "lost",
                "code": "killed",
                "message": "the job's supervisor was killed before it finished",
                "next_move": f"start the {spec.stage} pass again; earlier evidence is untouched",
            }
        )

    def cancel(self, why: str = "") -> None:
        """Ask for the job's end, and wait for it a while; `why` is told of it instead of that somebody asked."""
        if self.read().ended:
            return
        write_atomic(self.folder / "cancel", why)  # its supervisor looks for it, and reads what it says at once
        deadline = time.monotonic() + CANCEL_S
        while not self.read().ended and time.monotonic() < deadline:
            time.sleep(0.05)

    def asked_to_end(self) -> dict[str, str]:
        """What is told of a job that was asked to end."""
        try:
            why = (self.folder / "cancel").read_text(encoding="utf-8")
        except (OSError, ValueError):
            why = ""
        return {"code": "cancelled", "message": why or "cancelled on request"}

    def supervised(self) -> bool:
        """Whether a live supervisor holds the job's lock (a lock dies with its process, unlike a process number)."""
        try:
            with (self.folder / "lock").open("rb") as handle:
                return not try_lock.taken(handle.fileno())
        except OSError:
            return False


def _specs(run: Run) -> list[Path]:
    """The specifications of a run's jobs; what is reached by a link is somebody else's."""
    if run.jobs.is_symlink():
        raise GateError(
            "jobs/ is a link: what lies behind it is no job of this run",
            place=str(run.jobs),
            next_move="remove the link; a folder is made in its place, and evidence is untouched",
        )
    return [path for path in run.jobs.glob("*/spec.json") if link_on_the_way(run.jobs, path) is None]


def _number(spec: Path) -> int:
    """The middle of a job's id, `physics-12-0a1b2c3d`."""
    word = spec.parent.name.rsplit("-", 2)[-2:][0]
    return int(word) if word.isdecimal() else 0

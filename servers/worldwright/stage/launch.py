"""Start a job: answer it from evidence, join it if it is under way, or hand it to a detached supervisor.

The launcher takes the job's lock before the supervisor exists and passes it on, so a job has a live owner from its
first moment: no grace period, and no clock that could jump.
"""

import errno
import fcntl
import os
import secrets
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from ..model.errors import GateError, JobError
from ..model.evidence import pictures_of
from ..model.evidence.reports import EvidenceKey, PassName
from ..model.evidence.run import Run
from ..model.storage import link_on_the_way, own
from . import bare_models, family, gates, refined
from .job import Job, JobStatus, Spec
from .warm import kept_warm

STILL_S = 180.0
LIBRARIES, OPENCVS = "LD_LIBRARY_PATH", "cv2/../../lib64"
"""The variable of the folders in which libraries are looked for, and the end of the one that OpenCV puts first when it is imported."""
MEMORY_MB, FILE_MB, DISK_MB, OUTPUT_MB = 4096, 2048, 8192, 16


def launch(
    run: Run,
    key: EvidenceKey,
    stage: PassName,
    *,
    variant: str = "",
    arguments: Sequence[str] = (),
    force: bool = False,
    still_s: float = STILL_S,
    memory_mb: int = MEMORY_MB,
    cpu_s: float | None = None,
    file_mb: int = FILE_MB,
    disk_mb: int = DISK_MB,
    given: Path | None = None,
    fresh: bool = False,
) -> JobStatus:
    """Start one pass, or answer with its result if it exists already.

    Args:
        run: the run folder.
        key: the hashes of its program, plan and environment.
        stage: which pass.
        variant: name of a repetition beside the pass's own evidence; empty for the pass itself.
        arguments: more words on the program's command line.
        force: run it although it has succeeded, and compare.
        still_s: the job ends when nothing advances for so long, s.
        memory_mb: resident memory limit, MiB.
        cpu_s: processor time of all its processes together, s; not limited when None.
        file_mb: size of one file, MiB.
        disk_mb: size of all it writes, MiB.
        given: a world with its recorded inputs, simulated in place of the program's; nothing has to be approved or linted
            for it.
        fresh: give the program no shape that was kept of an earlier run.

    Raises:
        GateError: something the pass needs has not been proven yet.
        JobError: a variant of this name exists already, made with other arguments.
    """
    with _writable(run), one_at_a_time(run):
        film = pictures_of.identity(run, stage)

        def ended() -> tuple[str, ...]:
            return () if given or fresh else tuple(_end_outdated(run, stage, variant, key, film))

        own(run.folder, run.evidence(key) / gates.folder_name(stage, variant))
        earlier = gates.passed(run, key, stage, variant)
        if earlier is not None and stage == "final" and not (earlier.get("summary") or {}).get("complete"):
            earlier = None  # more minutes make it better
        if earlier is not None and stage != "final" and tuple(earlier.get("arguments", ())) != tuple(arguments):
            raise JobError(
                f"'{stage}@{variant}' stands already, made with {list(earlier.get('arguments', ()))}",
                code="refused",
                place=str(run.evidence(key) / gates.folder_name(stage, variant)),
                next_move="give a variant with other arguments another name",
            )
        if earlier is not None and not force:
            return JobStatus(
                job=earlier.get("job", ""),
                stage=stage,
                variant=variant,
                key=key.key,
                state="succeeded",
                cached=True,
                wall_s=earlier.get("wall_s", 0.0),
                sandbox=earlier.get("sandbox", ""),
                result=str(run.evidence(key) / gates.folder_name(stage, variant)),
                account=ended(),
            )
        gates.require_environment(run)
        after = ""
        if given is None:
            try:
                gates.require(run, key, stage, variant)
            except GateError:
                after = _needed_job(run, key, stage, variant)
                if not after:
                    raise
        reads = tuple(str(path) for path in bare_models.files(run))
        # Whatever its minutes, one final pass at a time goes on with the same frames.
        told = () if stage == "final" else tuple(arguments)
        wanted = (stage, variant, told, key, film)
        for other in Job.all(run):
            spec = other.spec
            theirs = () if stage == "final" else spec.arguments
            if force or (spec.stage, spec.variant, theirs, spec.key, spec.film_sha256) != wanted:
                continue
            if not (state := other.read()).ended:
                return state.model_copy(update={"account": ended()})
        outdated = ended()
        spec = Spec(
            job=f"{gates.folder_name(stage, variant)}-{Job.next_number(run)}-{secrets.token_hex(4)}",
            run=str(run.folder),
            stage=stage,
            variant=variant,
            arguments=tuple(arguments),
            key=key,
            film_sha256=film,
            still_s=still_s,
            memory_mb=memory_mb,
            cpu_s=cpu_s,
            output_mb=OUTPUT_MB,
            file_mb=file_mb,
            disk_mb=disk_mb,
            reads=reads,
            reuse=() if force or given else tuple(map(str, _earlier(run, key, stage, variant))),
            after=after,
            token=family.new_token(),
            given=str(given.absolute()) if given else "",
            force=force,
            fresh=fresh,
            created=time.time(),
        )
        for left in end_orphans(run):
            for folder in (left.scratch, left.out):
                if link_on_the_way(run.folder, folder) is None:
                    shutil.rmtree(folder, ignore_errors=True)
        job = Job.create(run, spec)
        _detach(job)
        return job.read().model_copy(update={"account": outdated})


def _earlier(run: Run, key: EvidenceKey, stage: PassName, variant: str) -> list[Path]:
    """Earlier passes that may hold what this one is to make."""
    if stage == "physics":
        return gates.earlier(run, key, variant)
    return gates.earlier_pictures(run, stage) if stage in ("stills", "video") else []


def _needed_job(run: Run, key: EvidenceKey, stage: PassName, variant: str) -> str:
    """The job under way that makes what a pass needs; empty when there is none."""
    before = None if variant else gates.BEFORE.get(stage)
    jobs = (job for job in Job.all(run) if before and not job.spec.variant and job.spec.key == key)
    return next((job.folder.name for job in jobs if job.spec.stage == before and not job.read().ended), "")


def orphans(run: Run) -> list[Job]:
    """Jobs whose supervisor was killed: they have ended, and what they were writing lies there still."""
    return [job for job in Job.all(run) if job.scratch.exists() and job.read().ended]


def end_orphans(run: Run) -> list[Job]:
    """End the processes that killed supervisors have left, and put their frames aside; returns the jobs, whose output may go."""
    found = orphans(run)
    for job in found:
        family.sweep(job.spec.token)
        refined.put_aside(job)
    return found


def _end_outdated(run: Run, stage: PassName, variant: str, key: EvidenceKey, film: str) -> Iterator[str]:
    """End the jobs of this kind that work for other files than there are now, which prove nothing any more; tells which.

    One of these is left when what started it was killed: the supervisor is detached, and goes on.
    """
    for other in Job.all(run):
        spec = other.spec
        same = (spec.stage, spec.variant, spec.given, spec.fresh) == (stage, variant, "", False)
        if not same or (spec.key, spec.film_sha256) == (key, film) or other.read().ended:
            continue
        what = "another film than there is now" if spec.key == key else "another program or plan than there is now"
        other.cancel(f"it was made for {what}, and the {stage} pass was started anew")  # or its answer stands already
        (other.folder / "told").touch()  # nobody waits for it: it is no news that it ended
        done = "ended" if other.read().ended else "asked to end"
        yield f"{done} {other.folder.name}, which was at work for {what}"


def _detach(job: Job) -> None:
    """Start the supervisor in a session of its own, holding the job's lock already."""
    with (job.folder / "supervisor.log").open("wb") as errors, (job.folder / "lock").open("wb") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        environment = _environment()
        if kept_warm.supervisor(job.folder, errors.fileno(), lock.fileno(), environment):
            return
        subprocess.Popen(
            [sys.executable, "-P", "-m", "worldwright.stage.supervisor", str(job.folder), str(lock.fileno())],
            stdin=subprocess.DEVNULL,
            stdout=errors,
            stderr=errors,
            start_new_session=True,
            pass_fds=(lock.fileno(),),
            env=environment,
        )


def _environment() -> dict[str, str]:
    """A supervisor's: this process's, less the folder of libraries that OpenCV adds, and with an empty entry the one a process stands in."""
    environment = {**os.environ, "PYDANTIC_DISABLE_PLUGINS": "__all__"}  # else it asks every installed package for some
    first, _, others = environment.get(LIBRARIES, "").partition(":")
    if first.endswith(OPENCVS):
        del environment[LIBRARIES]
    return environment | ({LIBRARIES: others} if first.endswith(OPENCVS) and others else {})


@contextmanager
def _writable(run: Run) -> Iterator[None]:
    """Turn a full disk or a read-only folder into an error that tells the user how to mend it."""
    try:
        yield
    except OSError as cause:
        full = cause.errno in (errno.ENOSPC, errno.EDQUOT)
        raise JobError(
            f"the job cannot be set up: {cause.strerror or cause}",
            code="disk_full" if full else "not_writable",
            place=str(cause.filename or run.jobs),
            next_move="free some space there" if full else "make the run folder writable, or copy the run elsewhere",
        ) from cause


@contextmanager
def one_at_a_time(run: Run) -> Iterator[None]:
    """Let callers in one after the other, so that two who ask at once get one job."""
    Job.all(run)  # refuses a link in the folder's place
    run.jobs.mkdir(parents=True, exist_ok=True)
    folder = os.open(run.jobs, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    try:
        fcntl.flock(folder, fcntl.LOCK_EX)
        yield
    finally:
        os.close(folder)

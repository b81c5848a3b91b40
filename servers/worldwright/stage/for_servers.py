"""What the stage does for other servers, which reach it through `stage.tools`; none of it is a tool."""

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..model.errors import NotFoundError, WorldwrightError
from ..model.evidence.reports import PassName
from ..model.evidence.run import Run
from ..model.progress import Progress, silent
from .job import Job, JobStatus

if TYPE_CHECKING:
    from ..model.picture import Illustrated
    from ..model.plan.committed import Plan
    from .confined import Confined


def run_variant(
    run: Run,
    variant: str,
    arguments: tuple[str, ...],
    *,
    still_s: float | None = None,
    timeout_s: float = 40,
    progress: Progress = silent,
) -> JobStatus:
    """See `stage.variants.run`; with `still_s` None as long as any pass."""
    from . import launch, variants

    patience = launch.STILL_S if still_s is None else still_s
    return variants.run(run, variant, arguments, still_s=patience, timeout_s=timeout_s, progress=progress)


def start_storyboard(run: Run, claimed: Sequence[tuple[float, str]]) -> JobStatus:
    """For another server's walk (no tool): start the storyboard with (instant in s, name) of proven objectives."""
    from ..model.evidence import environment
    from . import storyboards
    from .launch import launch

    key = run.evidence_key(environment.current().sha256())
    return launch(run, key, "storyboard", arguments=storyboards.arguments(run, key, claimed))


def latest(run: Run, stage: PassName) -> JobStatus | None:
    """For the walk of another server (no tool): the newest job of a pass on the current key and film, if there is one."""
    from ..model.evidence import environment, pictures_of

    wanted = (stage, "", run.evidence_key(environment.current().sha256()), pictures_of.identity(run, stage))
    jobs = (job for job in Job.all(run) if (s := job.spec) and (s.stage, s.variant, s.key, s.film_sha256) == wanted)
    return next((job.read() for job in jobs), None)


def free_earlier(run: Run) -> None:
    """For another server's walk (no tool): cancel what is under way in a run, and free all that is not of its present files."""
    from ..model.evidence import environment
    from . import disk

    for job in Job.all(run):
        job.cancel()
    with suppress(WorldwrightError):  # without a program there is no key; what a job still holds goes another time
        disk.free(run, run.evidence_key(environment.current().sha256()), dry=False)


def spent(run: Run) -> float:
    """For another server's walk (no tool): processor time of the passes of the program and plan as they stand, s."""
    from ..model.evidence import environment

    key = run.evidence_key(environment.current().sha256())
    return sum(job.read().cpu_s for job in Job.all(run) if job.spec.key == key)


def start_fresh(run: Run, stage: PassName) -> JobStatus:
    """For proofs of other servers (no tool): start a pass whose program makes everything anew, kept shapes included."""
    from ..model.evidence import environment
    from .launch import launch

    return launch(run, run.evidence_key(environment.current().sha256()), stage, fresh=True)


def simulate_given(run: Run, given: Path) -> JobStatus:
    """For proofs of other servers (no tool): simulate a world that exists as a file, with its recorded inputs.

    `given` holds `world.mjz`, `program.json`, `inputs.json`, and `inputs.arrows` and `edits.arrows` if it was driven. The
    program is not run. Follow the job with `wait`.
    """
    from ..model.evidence import environment
    from .launch import launch

    return launch(run, run.evidence_key(environment.current().sha256()), "physics", given=given)


def declared_inputs(plan: Path) -> list[dict[str, Any]]:
    """The inputs that a plan declares, as `inputs.json` has them; see `stage.processes`."""
    from .processes import declared

    return declared(plan)


def read_plain(path: Path, limit: int) -> bytes | None:
    """For other servers (no tool): a plain file of a pass, None for a link or a larger one; see `stage.plain.read`."""
    from . import plain

    return plain.read(path, limit)


def variant_folder(run: Run, variant: str) -> Path | None:
    """See `stage.variants.folder`."""
    from . import variants

    return variants.folder(run, variant)


def run_confined(call: Sequence[str], *, program: Path | None = None, **limits: Any) -> "Confined":
    """For other servers (no tool): a short confined run that leaves nothing behind but what it sculpted; see `confined.run`.

    `program` is the author's file that runs in it, with the files beside it that it may read.
    """
    from . import confined, kept_sculpts

    sculpts = None if program is None else kept_sculpts.of_files(program, limits.get("reads", ()))
    return confined.run(call, sculpts=sculpts, **limits)


def compile_laws(folder: Path) -> None:
    """For other servers (no tool): have compiled what the laws of a program in `folder` need, once on this machine.

    A confined process may not keep what it compiles, and its short time would go into that.
    """
    from ..model import call_time
    from . import compiled_laws

    if (folder / "laws").is_dir() and compiled_laws.lacking(folder / "laws"):
        compiled_laws.compile_ahead(lambda: call_time.left_s() <= 0)


def may_run_strangers() -> bool:
    """For other servers (no tool): whether a program that nobody has read may be run here; see `confined.allowed`."""
    from . import confined, sandbox

    return confined.allowed(sandbox.level())


def sculpt_of(plan: "Plan") -> int:
    """For other servers (no tool): have what a plan's files sculpt made, once; see `stage.sculpting_step.prepare`."""
    from .sculpting_step import prepare

    return prepare(plan)


def draw_moment(run: Run, at_s: float, camera: str | None, size: tuple[int, int]) -> bytes:
    """For other servers (no tool): one moment of a run as PNG; see `stage.one_frame.draw`."""
    from ..model.evidence import environment
    from .one_frame import draw

    return draw(run, run.evidence_key(environment.current().sha256()), at_s, camera, size).pictures[0].data


def draw_moments(
    run: Run, wanted: "Sequence[tuple[str, float, str, tuple[int, int]]]", within_s: float
) -> "tuple[list[bytes | None], dict[str, Any]]":
    """For other servers (no tool): moments through cameras as PNG, in one process; see `stage.one_frame.each`."""
    from ..model.evidence import environment
    from .one_frame import each

    return each(run, run.evidence_key(environment.current().sha256()), wanted, within_s)


def look_at_start(run: Run, camera: str | None, eye: str | None, target: str | None, fov_deg: float) -> "Illustrated":
    """For another command (no tool): the world as it would start, unrecorded; see `stage.first_look.at_start`."""
    from .first_look import at_start

    return at_start(run, camera, eye, target, fov_deg)


def try_film(folder: Path) -> dict[str, str] | None:
    """For other servers (no tool): let the author describe the film of a run, and draw one small picture of it.

    Where nothing is recorded yet it is tried on the world as it starts (`stage.film_trial`).

    Returns how it failed (`code`, `message`, `line`, `next_move`), empty if it did not; None where there is no world to try it on.
    The code `needs_recording` says that the missing recording may be why.
    """
    from ..model.errors import CallOverError, GateError, JobError, PlanError
    from ..model.evidence import environment
    from . import film_trial

    run = Run.find(folder)
    try:
        try:
            draw_moment(run, 0.0, None, (64, 36))
        except (NotFoundError, GateError):
            key = run.evidence_key(environment.current().sha256()) if run.program.is_file() else None
            film_trial.tried(run, key)
    except (NotFoundError, GateError, PlanError):
        return None
    except CallOverError:
        raise  # it tells nothing of the film
    except JobError as failure:
        if not film_trial.is_films(failure):
            return None
        line = failure.place.rpartition(":")[2]
        said = {"code": failure.code, "message": failure.cause, "next_move": failure.next_move}
        return {**said, "line": line if line.isdecimal() else ""}
    return {}


def model_files(model: Path) -> list[Path]:
    """For other servers (no tool): a model file and every file it names; see `stage.bare_models.made_of`."""
    from . import bare_models, given_models

    return bare_models.made_of(model, given_models.package_of(model) or model.parent)

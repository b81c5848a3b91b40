"""The process that runs one job: `python -m worldwright.stage.supervisor JOB`.

It has a session of its own, so a job outlives a restart of its server. A physics pass has the program
build its world in one sandbox, takes the file out of it, and hands it to the engine's process in another; where the program
controls its world, its process runs beside the engine's and answers through memory that both see. Stills and video need
the engine alone. Only when everything ended well are the engine's files moved into the run's evidence, in one rename.
"""

import os
import resource
import shutil
import sys
import time
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from worldkit.files import write_atomic, write_json
from worldkit.law_work import GROWING

from ..model.errors import GateError, JobError
from ..model.evidence.reports import PassResult
from ..model.evidence.run import Run, sha256_file
from ..model.storage import FULL, own
from . import bare_models, compiled_laws, plain, refined, sandbox
from .crew import Crew, adopt_orphans, reap_all
from .gates import folder_name, require
from .job import Job, JobStatus, Spec
from .pace import Pace
from .processes import Acting, Ended
from .warm import kept_warm

QUEUE_TICK_S = 0.2
LEFTOVERS = ("progress.json", "MUJOCO_LOG.TXT", "result.json")


class Supervision:
    """One job from start to end."""

    def __init__(self, job: Job) -> None:
        self.job = job
        self.spec: Spec = job.spec
        self.run = Run(self.spec.run)
        self.started = time.monotonic()
        self.started_at = datetime.now(UTC).isoformat(timespec="seconds")
        self.level = ""
        self.confinement: dict[str, str] = {}
        self.published = 0.0
        self.last: dict[str, Any] = {}
        """The engine's last report of its progress."""
        self.pace, self.weighed = Pace(), False

    def state(self, name: Any, **more: Any) -> None:
        """Publish the job's state."""
        wall = round(time.monotonic() - self.started, 3)
        common = {
            "job": self.spec.job,
            "stage": self.spec.stage,
            "key": self.spec.key.key,
            "variant": self.spec.variant,
        }
        self.job.write(JobStatus(**common, state=name, wall_s=wall, sandbox=self.level, **more))

    def supervise(self) -> None:
        """Run the job's processes, then settle how it ended."""
        self.level = sandbox.level()
        if self.spec.after and (refused := self.queue()):
            self.settle(Ended(refused))
            return
        self.compile_ahead()
        self.started = time.monotonic()
        self.state("running")
        crew = Crew(self.job, self.level)
        try:
            ended = Acting(self.job, self.run, crew, self.tick).act()
        finally:
            crew.end()
        self.confinement = crew.facts
        self.settle(ended)

    def compile_ahead(self) -> None:
        """Have compiled what a law of this job needs, before its time and its limits begin."""
        if self.spec.stage == "physics" and not self.spec.given and compiled_laws.lacking(self.job.inputs):
            self.state("running", code="compiling", message="numba compiles worldkit.matter, once on this machine")
            compiled_laws.compile_ahead(lambda: (self.job.folder / "cancel").exists())

    def queue(self) -> dict[str, str] | None:
        """Wait for the job that makes what this one needs; returns why it cannot begin, if it cannot."""
        before = Job(self.run.jobs / self.spec.after)
        self.state("queued", code="waiting", message=f"for {self.spec.after}")
        while not before.read().ended:
            if (self.job.folder / "cancel").exists():
                return self.job.asked_to_end()
            time.sleep(QUEUE_TICK_S)
        try:
            require(self.run, self.spec.key, self.spec.stage)
        except GateError as refusal:
            return {"code": "refused", "message": refusal.cause, "next_move": refusal.next_move}
        return None

    def tick(self, elapsed: float) -> bool:
        """Publish progress now and then; returns whether there was any."""
        if elapsed - self.published <= 0.4:
            return False
        self.published = elapsed
        said = self.progress()
        if said and said["done"] and not self.weighed:
            self.weighed = True  # the laws have told it before the first step
            self.pace.spread(plain.read_json(self.job.author / "control" / GROWING).get("shares"))
        advanced = bool(said) and self.pace.advanced(elapsed, said["done"])
        if said:
            left = self.pace.left_s(said["total"])
            self.last = {**said, "eta_s": None if left is None else round(left, 1)}
        self.state("running", **self.last)
        return advanced

    def progress(self) -> dict[str, Any]:
        """The engine's progress: `done`, `total` and their `unit`."""
        said = plain.read_json(self.job.out / "progress.json")
        try:
            return {
                "done": float(said["done"]),
                "total": float(said["total"]),
                "unit": str(said.get("unit", ""))[:40],
            }
        except (KeyError, TypeError, ValueError):
            return {}

    def settle(self, ended: Ended) -> None:
        """Decide how the pass ended, write its result, and move a success into the evidence."""
        out = self.job.out
        failure = ended.failure or self.changed() or self.strange()
        refined.put_aside(self.job)
        result = PassResult(
            stage=self.spec.stage,
            variant=self.spec.variant,
            arguments=self.spec.arguments,
            ok=failure is None,
            started=self.started_at,
            wall_s=round(time.monotonic() - self.started, 3),
            sandbox=self.level,
            confinement=self.confinement,
            job=self.spec.job,
            film_sha256=self.spec.film_sha256,
            summary=ended.summary,
            **(failure or {"code": "ok"}),
        )
        for folder in (self.job.scratch, self.job.author):  # nothing that a program left is of use to anybody
            shutil.rmtree(folder, ignore_errors=True)
        message = refined.said(result.summary)
        if source := str(result.summary.get("reused_from", "")):
            message = f"moves as {source} did, whose recording is taken over: only cameras, lights or looks differ"
        if failure is None and message:
            result = result.model_copy(update={"message": message})
        if failure is None:
            for leftover in LEFTOVERS:
                (out / leftover).unlink(missing_ok=True)
            for path in (self.job.lock, *ended.kept):
                write_atomic(out / path.name, path.read_bytes())
            files = {
                path.relative_to(out).as_posix(): sha256_file(path) for path in sorted(out.rglob("*")) if path.is_file()
            }
            result = result.model_copy(update={"files": files})
            if self.job.log.is_file():
                write_atomic(out / "log.txt", self.job.log.read_bytes())
            write_json(out / "result.json", result.model_dump(mode="json"))
            result = self.commit(result)
        else:
            if result.code == "disk_full":  # files that filled the disk must not keep the next run from starting
                shutil.rmtree(out, ignore_errors=True)
            write_json(self.job.folder / "result.json", result.model_dump(mode="json"))
            self.journal(result)
        name = "succeeded" if result.ok else "cancelled" if result.code == "cancelled" else "failed"
        told = {k: getattr(result, k) for k in ("code", "message", "place", "next_move")}
        told |= {name: self.last[name] for name in ("done", "total", "unit") if name in self.last}
        if result.ok:
            told["done"] = self.last.get("total", 0)
            told["result"] = str(self.run.evidence(self.spec.key) / folder_name(self.spec.stage, self.spec.variant))
        self.state(name, cpu_s=_cpu_s(), **told)

    def journal(self, result: PassResult, **more: str) -> None:
        """Write one line: which pass of which program and plan ended how."""
        key = self.spec.key
        self.run.log(
            "stage",
            "stage",
            key=key.key,
            stage=folder_name(self.spec.stage, self.spec.variant),
            ok=result.ok,
            code=result.code,
            job=self.spec.job,
            wall_s=result.wall_s,
            sandbox=self.level,
            program_sha256=key.program_sha256,
            plan_sha256=key.plan_sha256,
            **({} if result.ok else {"message": result.message[:300]}),
            **more,
        )

    def changed(self) -> dict[str, str] | None:
        """Refuse a bare model that is no longer the one in its folder's record: the recording would be of something else."""
        try:
            bare_models.files(self.run)
        except JobError as refusal:
            return {"code": refusal.code, "message": refusal.cause, "next_move": refusal.next_move}
        return None

    def strange(self) -> dict[str, str] | None:
        """Refuse anything but plain files as evidence, and to write it behind a link: that could lead anywhere."""
        try:
            own(self.run.folder, self.run.evidence(self.spec.key) / folder_name(self.spec.stage, self.spec.variant))
        except GateError as refusal:
            return {"code": "not_plain", "message": refusal.cause, "next_move": refusal.next_move}
        names = list(plain.odd(self.job.out)) if self.job.out.is_dir() else []
        if not names:
            return None
        message = f"its results are no plain files: {', '.join(names[:5])}"
        return {"code": "not_plain", "message": message, "next_move": "leave no links and no pipes behind"}

    def commit(self, result: PassResult) -> PassResult:
        """Move the result into the evidence by one rename; if evidence of this key exists, compare and keep the first.

        The journal vouches for the result before the rename: a kill in between leaves a line about nothing, which
        proves nothing, and never a result that nobody vouches for.
        """
        folder = self.run.evidence(self.spec.key)
        target = folder / folder_name(self.spec.stage, self.spec.variant)
        write_json(folder / "key.json", self.spec.key.model_dump(mode="json"))
        earlier = plain.read_json(target / "result.json")
        better = self.spec.stage == "final"  # it goes on where the earlier one ended
        if better or not earlier.get("ok") or earlier.get("film_sha256", "") != self.spec.film_sha256:
            if (
                target.exists()
            ):  # an interrupted result proves nothing, and pictures of another film prove nothing any more
                target.rename(self.job.folder / f"replaced-{target.name}")
            self.journal(result, result_sha256=sha256_file(self.job.out / "result.json"))
            self.job.out.rename(target)
            return result
        made = "world_sha256" if self.spec.stage == "bundle" else "trajectory_sha256"
        first, again = (earlier.get("summary") or {}).get(made), result.summary.get(made)
        if first == again:
            result = result.model_copy(update={"message": "the same result as before; the first evidence is kept"})
            self.journal(result)
            return result
        result = result.model_copy(
            update={
                "ok": False,
                "code": "not_repeatable",
                "message": f"the {made.partition('_')[0]} differs from the first run's ({again} against {first})",
                "next_move": "seed every random draw and take wall-clock and set order out of the program",
            }
        )
        self.journal(result)
        return result


def _cpu_s() -> float:
    """Processor time of this process and of all that it has started and that has ended, s."""
    if (nursery := kept_warm.use(None)) is not None:
        nursery.close()
    reap_all()
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return round(sum(one.ru_utime + one.ru_stime for one in used), 2)


def main() -> int:
    """Supervise the job whose folder is given."""
    job = Job(Path(sys.argv[1]))
    # The launcher took the lock for this process; the kernel drops it when the process ends, however it ends.
    os.set_inheritable(int(sys.argv[2]), False)
    adopt_orphans()
    supervision = Supervision(job)
    try:
        supervision.supervise()
    except BaseException as defect:
        code = "disk_full" if getattr(defect, "errno", None) in FULL else getattr(defect, "code", "internal")
        code = code if code in ("disk_full", "not_writable") else "internal"
        message = f"the supervisor failed: {type(defect).__name__}: {defect}"
        supervision.state("failed", code=code, message=message, next_move=getattr(defect, "next_move", ""))
        raise
    return 0


if __name__ == "__main__":
    main()
    os._exit(0)  # the job's state is its last word; taking every module apart costs a tenth of the supervisor's time

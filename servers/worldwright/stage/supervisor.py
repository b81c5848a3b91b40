"""The process that runs one job: `python -m worldwright.stage.supervisor JOB`.

It is detached from whoever asked (own session), so a job outlives a restart of its server. It starts the program in
the sandbox, keeps a capped log, watches time, memory, output and the number of processes, and publishes progress. Only
when everything ended well are the files moved into the run's evidence, in one rename.
"""

import contextlib
import json
import math
import os
import shutil
import subprocess
import sys
import threading
import time
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from worldkit.files import write_json

from ..model.errors import JobError
from ..model.evidence import PassResult
from ..model.run import Run, sha256_file
from ..model.storage import FULL
from . import family, models, sandbox
from .gates import folder_name
from .job import Job, JobStatus, Spec
from .limits import Guard, failed
from .sandbox.confinement import Confinement, environment
from .sandbox.enter import enter

LOG_BYTES = 1_000_000
TICK_S = 0.1
ADDRESS_SPACE_SLACK = 12 << 30
"""Software OpenGL and its compiler reserve far more address space than they use; resident memory is the real limit."""
OPTION = {"physics": "physics", "stills": "still", "video": "video"}
MB = 1 << 20


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
        self.last: dict[str, Any] = {}
        """What the program last said of its progress."""
        self.printed = 0

    def state(self, name: Any, **more: Any) -> None:
        """Publish where the job stands."""
        wall = round(time.monotonic() - self.started, 3)
        common = {
            "job": self.spec.job,
            "stage": self.spec.stage,
            "key": self.spec.key.key,
            "variant": self.spec.variant,
        }
        self.job.write(JobStatus(**common, state=name, wall_s=wall, sandbox=self.level, **more))

    @property
    def log_command(self) -> str:
        """What shows the program's last words."""
        return f"worldwright stage log {self.run.folder} --job {self.spec.job}"

    def call(self) -> list[str]:
        """The program's command line for this pass."""
        program = str(self.job.inputs / "simulation.py")
        call = [sys.executable, "-s", program, "--pass", OPTION[self.spec.stage], "--out", str(self.job.out)]
        earlier = [word for folder in self.spec.reuse for word in ("--reuse", folder)]
        recording = [] if self.spec.stage == "physics" else ["--from", str(self.recording)]
        return [*call, *recording, *self.spec.arguments, *earlier]

    @property
    def recording(self) -> Path:
        """The physics pass's recording of the same key."""
        return self.run.evidence(self.spec.key) / "physics" / "trajectory"

    def supervise(self) -> None:
        """Run the program, then settle how it ended."""
        self.level = sandbox.level()
        self.state("running")
        scratch = self.job.scratch
        reads = (self.job.inputs, *map(Path, (*self.spec.reads, *self.spec.reuse)))
        reads = reads if self.spec.stage == "physics" else (*reads, self.recording)
        confinement = Confinement(
            out=self.job.out,
            reads=reads,
            scratch=scratch,
            cpu_s=math.ceil(self.spec.cpu_s),
            file_bytes=self.spec.file_mb * MB,
            memory_bytes=self.spec.memory_mb * MB + ADDRESS_SPACE_SLACK,
            token=self.spec.token,
            environment=environment(str(scratch), str(self.job.lock)),
        )
        rung = sandbox.LADDER[self.level]
        pipes: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
        entered = enter(rung, self.call(), confinement, root=os.getpid(), **pipes)
        self.confinement = entered.facts
        process = entered.process
        reader = threading.Thread(target=self.keep_log, args=(process.stdout,), daemon=True)
        reader.start()
        guard = Guard(self.spec, self.job, entered.births, confinement)
        stopped = self.watch(process, guard)
        family.end(process.pid, self.spec.token)
        process.wait()
        reader.join(timeout=5)
        self.settle(process.returncode, stopped or guard.look(self.printed))

    def watch(self, process: "subprocess.Popen[bytes]", guard: Guard) -> dict[str, str] | None:
        """Wait for the end; returns why it was stopped, when a limit stopped it."""
        published = 0.0
        while process.poll() is None:
            time.sleep(TICK_S)
            reap_orphans(process.pid)
            elapsed = time.monotonic() - self.started
            if (self.job.folder / "cancel").exists():
                return {"code": "cancelled", "message": "cancelled on request"}
            if stopped := guard.look(self.printed):
                return stopped
            if elapsed > self.spec.wall_s:
                return {
                    "code": "timed_out",
                    "message": f"still running after its limit of {self.spec.wall_s:g} s",
                    "next_move": "look for a loop that never ends, or give it more time with --wall-s",
                }
            if elapsed - published > 0.4:
                published = elapsed
                self.last = self.progress(elapsed) or self.last
                self.state("running", **self.last)
        return None

    def progress(self, elapsed: float) -> dict[str, Any]:
        """What the program says of its progress, with an estimate of the time left."""
        said = _json(self.job.out / "progress.json")
        try:
            done, total = float(said["done"]), float(said["total"])
        except (KeyError, TypeError, ValueError):
            return {}
        left = elapsed * (total - done) / done if done > 0 and total > done else None
        unit = str(said.get("unit", ""))[:40]
        return {"done": done, "total": total, "unit": unit, "eta_s": None if left is None else round(left, 1)}

    def keep_log(self, stream: Any) -> None:
        """Copy the program's output into the log, up to the cap; go on counting and discarding beyond it."""
        with self.job.log.open("wb") as log:
            while chunk := stream.read1(65536):
                room = LOG_BYTES - self.printed
                self.printed += len(chunk)
                if room > 0:
                    log.write(chunk[:room])
                    log.flush()
                    if len(chunk) > room:
                        log.write(b"\n[the log is cut here: its limit is 1 MB]\n")

    def settle(self, status: int, stopped: dict[str, str] | None) -> None:
        """Decide how the pass ended, write its result, and move a success into the evidence."""
        out = self.job.out
        summary = _json(out / "result.json")
        error = _json(out / "error.json")
        failure = stopped or failed(status, summary, error, self.log_command) or self.changed()
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
            summary=summary if isinstance(summary, dict) else {},
            **(failure or {"code": "ok"}),
        )
        shutil.rmtree(self.job.scratch, ignore_errors=True)
        if failure is None and (source := str(result.summary.get("reused_from", ""))):
            message = f"moves as {source} did, whose recording is taken over: only cameras, lights or looks differ"
            result = result.model_copy(update={"message": message})
        if failure is None:
            for leftover in ("progress.json", "MUJOCO_LOG.TXT", "result.json"):
                (out / leftover).unlink(missing_ok=True)
            (out / self.job.lock.name).write_bytes(self.job.lock.read_bytes())
            files = {
                path.relative_to(out).as_posix(): sha256_file(path) for path in sorted(out.rglob("*")) if path.is_file()
            }
            result = result.model_copy(update={"files": files})
            if self.job.log.is_file():
                (out / "log.txt").write_bytes(self.job.log.read_bytes())
            write_json(out / "result.json", result.model_dump(mode="json"))
            result = self.commit(result)
        else:
            if result.code == "disk_full":  # what filled the disk must not keep the next run from starting
                shutil.rmtree(out, ignore_errors=True)
            write_json(self.job.folder / "result.json", result.model_dump(mode="json"))
            self.journal(result)
        name = "succeeded" if result.ok else "cancelled" if result.code == "cancelled" else "failed"
        told = {k: getattr(result, k) for k in ("code", "message", "place", "next_move")}
        told |= {name: self.last[name] for name in ("done", "total", "unit") if name in self.last}
        if result.ok:
            told["done"] = self.last.get("total", 0)
            told["result"] = str(self.run.evidence(self.spec.key) / folder_name(self.spec.stage, self.spec.variant))
        self.state(name, **told)

    def journal(self, result: PassResult, **more: str) -> None:
        """One line: which pass of which program and plan ended how."""
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
        """A recorded model must still be what its folder says, or the recording is of something else."""
        try:
            models.files(self.run)
        except JobError as refusal:
            return {"code": refusal.code, "message": refusal.cause, "next_move": refusal.next_move}
        return None

    def commit(self, result: PassResult) -> PassResult:
        """One rename into the evidence; where evidence of this key already stands, compare and keep the first.

        The journal vouches for the result before the rename: a kill in between leaves a line about nothing, which
        proves nothing, and never a result that nobody vouches for.
        """
        folder = self.run.evidence(self.spec.key)
        target = folder / folder_name(self.spec.stage, self.spec.variant)
        write_json(folder / "key.json", self.spec.key.model_dump(mode="json"))
        earlier = _json(target / "result.json")
        if not earlier.get("ok"):
            if target.exists():  # what an older, interrupted version left behind proves nothing
                target.rename(self.job.folder / f"replaced-{target.name}")
            self.journal(result, result_sha256=sha256_file(self.job.out / "result.json"))
            self.job.out.rename(target)
            return result
        first = (earlier.get("summary") or {}).get("trajectory_sha256")
        again = result.summary.get("trajectory_sha256")
        if first == again:
            result = result.model_copy(update={"message": "the same result as before; the first evidence is kept"})
            self.journal(result)
            return result
        result = result.model_copy(
            update={
                "ok": False,
                "code": "not_repeatable",
                "message": f"the trajectory differs from the first run's ({again} against {first})",
                "next_move": "seed every random draw and take wall-clock and set order out of the program",
            }
        )
        self.journal(result)
        return result


def _json(path: Path) -> dict[str, Any]:
    """A JSON object written by the confined program, or an empty one: its content is never trusted."""
    try:
        if path.is_symlink() or path.stat().st_size > 4 * MB:
            return {}
        value = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    return value if isinstance(value, dict) else {}


def adopt_orphans() -> None:
    """Become the parent of whatever the program leaves behind, so that it is counted and ended with it."""
    import ctypes

    ctypes.CDLL(None).prctl(36, 1, 0, 0, 0)  # PR_SET_CHILD_SUBREAPER


def reap_orphans(program: int) -> None:
    """Bury adopted processes that have ended; the program itself is left to its own handle."""
    with contextlib.suppress(OSError):
        while (ended := os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOHANG | os.WNOWAIT)) and ended.si_pid != program:
            os.waitpid(ended.si_pid, 0)


def main() -> int:
    """Supervise the job whose folder is given."""
    job = Job(Path(sys.argv[1]))
    # The launcher took the lock and left it to us; the kernel drops it when this process ends, however it ends.
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
    sys.exit(main())

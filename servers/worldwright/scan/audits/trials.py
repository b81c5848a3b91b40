"""Repeat the physics pass with something changed, as often as an audit asks, a few at a time, within one call's time."""

import hashlib
import json
import re
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from worldkit.files import write_json

from ...model.errors import JobError, NotFoundError
from ...model.evidence.audits import Trial
from ...model.evidence.run import Run
from ...model.progress import Progress, silent
from ...model.recording.trajectory import Trajectory
from ...model.recording.trajectory_files import read_trajectory

AT_ONCE = 2
POLL_S = 0.2
LIMITS = frozenset(
    (
        *("timed_out", "out_of_memory", "out_of_cpu_time", "too_much_output", "file_too_large", "too_many_processes"),
        *("disk_full", "not_writable", "killed", "cancelled", "refused", "internal"),
    )
)
"""Codes of ends that say nothing of a world: of a limit, of the machine, of a person or of the suite. A pass that cannot begin
is `refused`."""


@dataclass
class Trials:
    """The repetitions of one run's physics pass; ask for them, then `collect`."""

    run: Run
    words: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """The program's options, by label."""
    made: dict[str, Trajectory] = field(default_factory=dict)
    failed: dict[str, str] = field(default_factory=dict)
    limited: set[str] = field(default_factory=set)
    """Labels that could not begin here or ended in one of `LIMITS`, which says nothing about the world."""
    memory: Path | None = None
    """The file that remembers jobs under way from one call to the next, so that a failing one is not restarted for ever;
    None: nothing is remembered."""
    jobs: dict[str, str] = field(default_factory=dict)
    """The jobs under way, by label."""
    at_once: int = AT_ONCE
    still_s: float | None = None
    """A repetition ends when nothing advances for so long, s; None: as any pass does."""
    before_start: Callable[[], object] | None = None
    """Is called before each repetition is started; what it raises ends the collecting."""

    def __post_init__(self) -> None:
        if self.memory is not None and self.memory.is_file():
            try:
                self.jobs = {str(k): str(v) for k, v in json.loads(self.memory.read_text(encoding="utf-8")).items()}
            except (OSError, ValueError, AttributeError):
                self.jobs = {}

    def ask(self, *words: str) -> str:
        """Ask for one repetition; returns its label, e.g. `without foot`."""
        label = label_of(words)
        self.words[label] = words
        return label

    @property
    def pending(self) -> tuple[str, ...]:
        """Labels that are neither made nor failed."""
        return tuple(label for label in self.words if label not in self.made and label not in self.failed)

    def collect(self, timeout_s: float, progress: Progress = silent) -> bool:
        """Start what is missing and wait for it; returns whether everything is done. Another call goes on."""
        from ...stage.tools import variant_folder

        deadline = time.monotonic() + timeout_s
        while True:
            running = 0
            for label in self.pending:
                if running >= self.at_once:
                    break
                try:
                    status = self._status(label)
                except JobError as refused:
                    self.limited.add(label)
                    self.failed[label] = _told(refused.code, refused.cause, refused.next_move)
                    continue
                if not status.ended:
                    running += 1
                    continue
                folder = variant_folder(self.run, variant_name(label)) if status.state == "succeeded" else None
                if folder is not None:
                    self._forget(label)
                    self.made[label] = read_trajectory(folder / "trajectory")
                    continue
                if status.code in LIMITS:
                    self.limited.add(label)
                self.failed[label] = _told(status.code, status.message, status.next_move)
            done = len(self.words) - len(self.pending)
            progress(done, len(self.words), f"{done} of {len(self.words)} repetitions")
            if not self.pending:
                for label in self.failed:  # they are reported now, and tried again when somebody asks again
                    self._forget(label)
                return True
            if time.monotonic() >= deadline:
                return False
            time.sleep(POLL_S)

    def _status(self, label: str) -> Any:
        """The state of a repetition, which is started if it was not."""
        from ...stage.tools import run_variant, wait

        if label in self.jobs:
            try:
                return wait(str(self.run.folder), job=self.jobs[label], timeout_s=0)
            except NotFoundError:  # its folder was cleared away
                self._forget(label)
        if self.before_start is not None:
            self.before_start()
        status = run_variant(self.run, variant_name(label), self.words[label], still_s=self.still_s, timeout_s=0)
        if not status.ended:
            self.jobs[label] = status.job
            self._remember()
        return status

    def _forget(self, label: str) -> None:
        if self.jobs.pop(label, None) is not None:
            self._remember()

    def _remember(self) -> None:
        if self.memory is not None:
            write_json(self.memory, self.jobs)

    def told(self) -> tuple[Trial, ...]:
        """All repetitions, as the report lists them."""
        facts: dict[str, dict[str, Any]] = {label: {"trajectory_sha256": t.sha256} for label, t in self.made.items()}
        facts |= {label: {"failed": why} for label, why in self.failed.items()}
        return tuple(Trial(label=label, **facts.get(label, {})) for label in self.words)


def _told(code: str, cause: str, next_move: str) -> str:
    return f"{code}: {cause}" + (f"; {next_move}" if next_move else "")


def label_of(words: tuple[str, ...]) -> str:
    """The label of a repetition, from the program's options: `without foot`."""
    return " ".join(word.removeprefix("--") for word in words)


def variant_name(label: str) -> str:
    """The variant's folder name: readable, and different for different options."""
    readable = re.sub(r"[^a-z0-9_.-]+", "-", label.lower()).strip("-.")[:60]
    return f"{readable}-{hashlib.sha256(label.encode()).hexdigest()[:6]}"

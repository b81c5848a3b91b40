"""Repeating the physics pass with something changed, as often as an audit asks, a few at a time, within one call's time."""

import hashlib
import re
import time
from dataclasses import dataclass, field
from typing import Any

from ...model.audits import Trial
from ...model.errors import JobError
from ...model.progress import Progress, silent
from ...model.run import Run
from ...model.trajectory import Trajectory

AT_ONCE = 2
POLL_S = 0.2


@dataclass
class Trials:
    """The repetitions of one run's physics pass; ask for them, then `collect`."""

    run: Run
    words: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """The program's options, by label."""
    made: dict[str, Trajectory] = field(default_factory=dict)
    failed: dict[str, str] = field(default_factory=dict)

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
        """Start what is missing and wait for it; tells whether everything is there. Call again to go on."""
        from ...stage.tools import run_variant, variant_folder

        deadline = time.monotonic() + timeout_s
        while True:
            running = 0
            for label in self.pending:
                if running >= AT_ONCE:
                    break
                name = variant_name(label)
                try:
                    status = run_variant(self.run, name, self.words[label], timeout_s=0)
                except JobError as refused:
                    self.failed[label] = str(refused)
                    continue
                if not status.ended:
                    running += 1
                    continue
                folder = variant_folder(self.run, name) if status.state == "succeeded" else None
                if folder is None:
                    self.failed[label] = f"{status.message}" + (f"; {status.next_move}" if status.next_move else "")
                else:
                    self.made[label] = Trajectory.read(folder / "trajectory")
            done = len(self.words) - len(self.pending)
            progress(done, len(self.words), f"{done} of {len(self.words)} repetitions")
            if not self.pending or time.monotonic() >= deadline:
                return not self.pending
            time.sleep(POLL_S)

    def told(self) -> tuple[Trial, ...]:
        """All repetitions, as the report lists them."""
        facts: dict[str, dict[str, Any]] = {label: {"trajectory_sha256": t.sha256} for label, t in self.made.items()}
        facts |= {label: {"failed": why} for label, why in self.failed.items()}
        return tuple(Trial(label=label, **facts.get(label, {})) for label in self.words)


def label_of(words: tuple[str, ...]) -> str:
    """What a repetition is called, from the program's options: `without foot`."""
    return " ".join(word.removeprefix("--") for word in words)


def variant_name(label: str) -> str:
    """The variant's folder name: readable, and different for different options."""
    readable = re.sub(r"[^a-z0-9_.-]+", "-", label.lower()).strip("-.")[:60]
    return f"{readable}-{hashlib.sha256(label.encode()).hexdigest()[:6]}"

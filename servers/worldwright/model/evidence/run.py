"""The run folder: where a run's files live. State is derived from these files, never stored beside them."""

import hashlib
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from worldkit.files import json_text, write_atomic, write_json

from .. import companions
from ..errors import NotFoundError
from ..storage import own, writing
from . import assets_used, seals
from .journal import Journal
from .reports import EvidenceKey

EARLIER, DAMAGED = "earlier", "damaged"
"""Folder of what was accepted before, and how the folders in it begin that were not as they were stamped any more."""
SOURCE = "source"
"""Folder beside the evidence of a key that holds the program and the plan it is about."""


class Run:
    """Paths, evidence keys and the journal of one run folder."""

    def __init__(self, folder: Path | str) -> None:
        self.folder = Path(folder).resolve()
        self._reports: dict[str, str] = {}

    @classmethod
    def find(cls, name: Path | str) -> "Run":
        """The run at a path (the folder, or its plan.md), or named under ./runs or ./examples."""
        path = Path(name)
        if path.name == "plan.md":
            path = path.parent
        for candidate in (path, Path("runs") / path, Path("examples") / path):
            if (candidate / "plan.md").is_file() or (candidate / "model.json").is_file():
                return cls(candidate)
        known = sorted(str(p.parent) for root in ("runs", "examples") for p in Path(root).glob("*/plan.md"))
        raise NotFoundError(
            f"there is no run '{name}' (a run is a folder with a plan.md)",
            place=str(path),
            next_move=f"name one of: {', '.join(known) or '(none yet)'}, or write {path}/plan.md",
        )

    def __repr__(self) -> str:
        return f"Run({str(self.folder)!r})"

    @property
    def name(self) -> str:
        """The run's slug."""
        return self.folder.name

    @property
    def prompt(self) -> Path:
        """The file with the user's request."""
        return self.folder / "prompt.md"

    @property
    def plan(self) -> Path:
        """The file of the plan with its thirteen sections."""
        return self.folder / "plan.md"

    @property
    def model(self) -> Path:
        """In a folder that records somebody's MJCF file, in place of a plan: which file, and what it is made of."""
        return self.folder / "model.json"

    @property
    def source(self) -> Path:
        """What the program is measured against: the plan, or the model that is recorded."""
        return self.model if self.model.is_file() and not self.plan.is_file() else self.plan

    @property
    def program(self) -> Path:
        """The file of the one program."""
        return self.folder / "simulation.py"

    @property
    def journal(self) -> Path:
        """The append-only file that says who did what, on which hashes."""
        return self.folder / "journal.jsonl"

    @property
    def jobs(self) -> Path:
        """The folder of running and failed jobs, one folder each."""
        return self.folder / "jobs"

    @property
    def accepted(self) -> Path:
        """The folder of the accepted world."""
        return self.folder / "accepted"

    def earlier(self) -> list[Path]:
        """The folders of the versions that were accepted before, and of what one that was brought back has replaced."""
        return [path for path in (self.folder / EARLIER).glob("*") if not path.name.startswith(f"{DAMAGED}-")]

    @property
    def stamped(self) -> Path:
        """The folder that the stamp is in: `accepted/`, or the run folder itself where only the small form is kept."""
        small = not self.accepted.exists() and (self.folder / "stamp.json").is_file()
        return self.folder if small else self.accepted

    @property
    def blocked(self) -> Path:
        """The file that says why the run is blocked."""
        return self.folder / "blocked.json"

    @property
    def report(self) -> Path:
        """The page that shows the run."""
        return self.folder / "report.html"

    def evidence(self, key: EvidenceKey | str) -> Path:
        """The folder of evidence for one key."""
        return self.folder / "evidence" / (key if isinstance(key, str) else key.key)

    def evidence_key(self, environment_sha256: str) -> EvidenceKey:
        """The key of the program and plan as they stand now (missing files are a `NotFoundError`)."""
        for path, remedy in (
            (self.source, "write the plan first"),
            (self.program, f"worldwright go {self.folder}"),
        ):
            if not path.is_file():
                raise NotFoundError(f"there is no {path.name} in this run", place=str(path), next_move=remedy)
        return EvidenceKey(
            program_sha256=sha256_file(self.program),
            plan_sha256=sha256_file(self.source),
            environment_sha256=environment_sha256,
            companions_sha256=companions.sha256(self.program),
            assets_sha256=assets_used.sha256(self.source, self.program),
        )

    def keep(self, key: EvidenceKey, name: str, report: Any) -> Path:
        """Atomically store a report model as `evidence/<key>/<name>.json`, with what it is about beside it.

        Beside it: `key.json`, and `source/` with the program and the plan themselves, so that every iteration can be
        gone back to. The next line of the journal vouches for the report's bytes. A `GateError` where a link leads out of
        the run.
        """
        folder = own(self.folder, self.evidence(key) / SOURCE).parent
        path = folder / f"{name}.json"
        with writing(f"the report {path.name}", folder):
            write_json(folder / "key.json", key.model_dump(mode="json"))
            self._snapshot(key)
            write_json(path, report.model_dump(mode="json"))
        self._reports[name] = sha256_file(path)
        return path

    def keep_vouched(self, key: EvidenceKey, name: str, report: Any, actor: str, **facts: Any) -> None:
        """`keep`, and the line of the journal (its action is `name`) that vouches for it, written first.

        For a report that is made beside other work: whoever reads the evidence meanwhile never finds one that nobody
        vouches for. A kill in between leaves a line about nothing, which proves nothing.
        """
        own(self.folder, self.evidence(key) / SOURCE)  # before a line of the journal is written
        self._reports[name] = hashlib.sha256(json_text(report.model_dump(mode="json")).encode()).hexdigest()
        self.log(actor, name, key=key.key, **facts)
        self.keep(key, name, report)
        self._reports.pop(name)

    def _snapshot(self, key: EvidenceKey) -> None:
        """The program and the plan of this key, once; nothing when they were changed meanwhile."""
        if key.companions_sha256 and key.companions_sha256 == companions.sha256(self.program):
            for name, content in companions.of(self.program).items():
                write_atomic(self.evidence(key) / SOURCE / name, content)
        for path, wanted in ((self.program, key.program_sha256), (self.source, key.plan_sha256)):
            kept = self.evidence(key) / SOURCE / path.name
            if kept.is_file() or not path.is_file():
                continue
            content = path.read_bytes()
            if hashlib.sha256(content).hexdigest() == wanted:
                write_atomic(kept, content)

    def log(self, actor: str, action: str, **facts: Any) -> str:
        """Append one line to the journal; returns the head of its chain.

        Every line says how the program and the plan stood when it was written (`program_sha256`, `plan_sha256`), and
        the SHA-256 of the reports kept since the line before (`reports`), so that later changes can be told. It is sealed
        where this process may use this machine's key.
        """
        entry = {
            "time": datetime.now(UTC).isoformat(timespec="milliseconds"),
            "actor": actor,
            "action": action,
            **facts,
        }
        for name, path in (("program_sha256", self.program), ("plan_sha256", self.plan)):
            if name not in entry and path.is_file():
                entry[name] = sha256_file(path)
        if self._reports:
            entry["reports"] = dict(self._reports)
        with writing("the journal", self.journal):
            self.folder.mkdir(parents=True, exist_ok=True)
            head = Journal(self.journal).append(entry, seals.made)
        self._reports.clear()
        return head

    def entries(self) -> Iterator[dict[str, Any]]:
        """The journal, oldest first; a line torn by a crash is skipped."""
        yield from Journal(self.journal).entries()


def sha256_file(path: Path | str) -> str:
    """SHA-256 of a file's bytes, hexadecimal."""
    with Path(path).open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()

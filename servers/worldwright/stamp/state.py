"""What the files of a run folder say, read once and never raising: the ground that steps and gates stand on."""

import hashlib
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel

from ..model import companions, syntax
from ..model.errors import NotFoundError, PlanError, WorldwrightError
from ..model.evidence import approval, assets_used, came, pictures_of
from ..model.evidence.audits import CausesReport, InterventionReport, RefineReport
from ..model.evidence.reports import (
    Environment,
    EvidenceKey,
    ExpectReport,
    Film,
    LintReport,
    PassName,
    PassResult,
    ScanReport,
    VisualDescription,
)
from ..model.evidence.run import Run
from ..model.evidence.verdict import Verdict
from ..model.frozen import Frozen
from ..model.plan.committed import Plan
from .kept import Kept
from .statement import Statement

T = TypeVar("T", bound=BaseModel)


class Blocked(Frozen):
    """Why a run ended without a world (`blocked.json`)."""

    cause: str
    time: str
    program_sha256: str = ""
    plan_sha256: str = ""
    key: str = ""


class State:
    """One run folder as it stands; each part is read when it is first needed."""

    def __init__(self, run: Run) -> None:
        self.run = run
        self.unsteady: list[Path] = []
        """Files of the evidence that were read with two contents: somebody writes there meanwhile."""
        self._seen: dict[Path, str] = {}

    @classmethod
    def find(cls, name: str) -> "State":
        """The run at a path or of that name; a damaged folder that has lost its plan is still found."""
        try:
            return cls(Run.find(name))
        except NotFoundError:
            run = Run(name)
            remains = (run.journal, run.program, run.accepted, run.blocked, run.folder / "evidence", run.prompt)
            if run.folder.is_dir() and any(path.exists() for path in remains):
                return cls(run)
            raise

    @cached_property
    def place(self) -> str:
        """The folder as a person would type it."""
        try:
            return str(self.run.folder.relative_to(Path.cwd()))
        except (ValueError, OSError):
            return str(self.run.folder)

    @cached_property
    def plan_bytes(self) -> bytes | None:
        """The plan's bytes as they were when first read; None when it cannot be read."""
        return _bytes(self.run.plan)

    @cached_property
    def program_bytes(self) -> bytes | None:
        """The program's bytes as they were when first read; None when it cannot be read."""
        return _bytes(self.run.program)

    @cached_property
    def plan_sha256(self) -> str:
        """Hash of the plan's bytes; empty when it cannot be read."""
        return "" if self.plan_bytes is None else hashlib.sha256(self.plan_bytes).hexdigest()

    @cached_property
    def program_sha256(self) -> str:
        """Hash of the program's bytes; empty when it cannot be read."""
        return "" if self.program_bytes is None else hashlib.sha256(self.program_bytes).hexdigest()

    @cached_property
    def _plan(self) -> tuple[Plan | None, str]:
        from ..model.plan.plan_text import read_plan

        try:
            return read_plan(self.run.plan).plan, ""
        except PlanError as error:
            count = len(error.findings)
            first = f": {error.findings[0]}" if count else ""
            return None, f"plan.md has {count} problem(s){first}" if count else error.cause
        except (WorldwrightError, OSError, ValueError, RecursionError) as cause:
            return None, f"plan.md cannot be read: {getattr(cause, 'cause', None) or cause}"

    @property
    def plan(self) -> Plan | None:
        """The plan, when it can be read as one."""
        return self._plan[0]

    @property
    def plan_problem(self) -> str:
        """Why the plan cannot be read; empty when it can."""
        return self._plan[1]

    @cached_property
    def validation(self) -> LintReport | None:
        """The lint report of the plan; None when there is no plan."""
        from ..lint import tools as lint

        try:
            report = lint.check_plan(self.run.plan)
        except (WorldwrightError, OSError, ValueError):
            return None
        return LintReport(findings=tuple(report.findings), rules=getattr(report, "rules", 0))

    @cached_property
    def program_problem(self) -> str:
        """Why the program cannot run at all; empty when it parses."""

        if self.program_bytes is None:
            return "there is no readable simulation.py"
        try:
            syntax.module(self.program_bytes)
        except (SyntaxError, ValueError, RecursionError, MemoryError) as cause:
            return f"simulation.py is not valid Python: {cause}"
        return ""

    @cached_property
    def environment(self) -> Environment | None:
        """The environment in which this machine would run it now."""
        from ..model.evidence import environment

        try:
            used = assets_used.sha256(self.run.source, self.run.program)
            return environment.current().model_copy(update={"catalog_sha256": used})
        except (WorldwrightError, OSError, ValueError):
            return None

    @cached_property
    def film(self) -> Film | None:
        """The film that pictures would be made with now; None where the chosen renderer is not there."""
        from ..model.evidence import environment

        try:
            return environment.film()
        except (WorldwrightError, OSError, ValueError):
            return None

    @cached_property
    def key(self) -> EvidenceKey | None:
        """The key of the current program, plan and environment; None while one of them is missing."""
        if not (self.plan_sha256 and self.program_sha256 and self.environment):
            return None
        return EvidenceKey(
            program_sha256=self.program_sha256,
            plan_sha256=self.plan_sha256,
            environment_sha256=self.environment.sha256(),
            companions_sha256=companions.sha256(self.run.program),
            assets_sha256=self.environment.catalog_sha256,
        )

    @property
    def folder(self) -> Path:
        """The evidence folder of the current key (it need not exist)."""
        return self.run.evidence(self.key or "none")

    def sees(self, path: Path, sha256: str) -> None:
        """Remember with which hash a file of the evidence was read."""
        if self._seen.setdefault(path, sha256) != sha256:
            self.unsteady.append(path)

    def _read(self, name: str, model: type[T]) -> Kept[T]:
        path = self.folder / name
        kept = Kept.read(path, model) if self.key else Kept(path)
        if kept.sha256:
            self.sees(path, kept.sha256)
        return kept

    @cached_property
    def lint(self) -> Kept[LintReport]:
        """The program's lint of this key."""
        return self._read("lint.json", LintReport)

    @cached_property
    def passes(self) -> dict[PassName, Kept[PassResult]]:
        """The results of the three passes of this key."""
        names: tuple[PassName, ...] = ("physics", "stills", "video")
        return {name: self._read(f"{name}/result.json", PassResult) for name in names}

    def filmed_otherwise(self, stage: PassName) -> str:
        """Why the pictures of a pass differ from those that would be made now; empty when they do not, or when there are none."""
        kept = self.passes[stage].value
        if stage == "physics" or kept is None or not kept.ok:
            return ""
        if self.film is None:
            return "the chosen renderer is not there"
        if kept.film_sha256 == self.pictures(stage):
            return ""
        if (kept.summary.get("drawn_by") or kept.film_sha256) == self.film.sha256:
            return "film.py is not the one that was filmed"
        return f"its pictures are not by {self.film.renderer} ({self.film.version}) as it is now"

    def _of_these_pictures(self, action: str, kept: Kept[T]) -> Kept[T]:
        """A description or review of this key, unless it is about the pictures of another film."""
        key = self.key.key if self.key else ""
        line: dict[str, Any] = next(
            (e for e in reversed(self.journal) if (e.get("action"), e.get("key")) == (action, key)), {}
        )
        about = line.get("film_sha256")
        return kept if not about or about == self.pictures("video") else Kept(kept.path)

    def pictures(self, stage: PassName) -> str:
        """Identity of the pictures that a pass would make now; empty where the renderer is not there."""
        return pictures_of.identity(self.run, stage, self.film.sha256) if self.film else ""

    @cached_property
    def scan(self) -> Kept[ScanReport]:
        """The anomaly scan of this key."""
        return self._read("scan.json", ScanReport)

    @cached_property
    def expect(self) -> Kept[ExpectReport]:
        """The measured objectives of this key."""
        return self._read("expect.json", ExpectReport)

    @cached_property
    def interventions(self) -> Kept[InterventionReport]:
        """The ledger of what acts in this key's recording, with what carries the loads."""
        return self._read("interventions.json", InterventionReport)

    @cached_property
    def causes(self) -> Kept[CausesReport]:
        """The causal audit of this key, where it was made."""
        return self._read("causes.json", CausesReport)

    @cached_property
    def refine(self) -> Kept[RefineReport]:
        """The audit at half the time step of this key, where it was made."""
        return self._read("refine.json", RefineReport)

    @cached_property
    def visual(self) -> Kept[VisualDescription]:
        """The visual description of this key's pictures."""
        return self._of_these_pictures("describe", self._read("visual.json", VisualDescription))

    @cached_property
    def review(self) -> Kept[Verdict]:
        """The review of this key and its pictures."""
        return self._of_these_pictures("review", self._read("review.json", Verdict))

    @cached_property
    def stamp(self) -> Kept[Statement]:
        """The stamp of the accepted world, whichever program it belongs to."""
        return Kept.read(self.run.stamped / "stamp.json", Statement)

    @cached_property
    def blocked(self) -> Kept[Blocked]:
        """Why the run is blocked, whichever program that was about; None when it is not."""
        return Kept.read(self.run.blocked, Blocked)

    @cached_property
    def journal(self) -> tuple[dict[str, Any], ...]:
        """The journal, oldest first; what cannot be read is skipped."""
        try:
            return tuple(self.run.entries())
        except (OSError, ValueError, RecursionError):
            return ()

    @property
    def approval(self) -> dict[str, Any] | None:
        """The latest approval of exactly this plan and of the model files that it names."""
        found = approval.standing(self.journal, self.plan_sha256, self.model_hashes)
        return None if found is None else dict(found)

    def came(self, action: str) -> str:
        """How the latest entry of this kind for this key was sent, in words; empty without one, or for a line of an
        older version.
        """
        key = self.key.key if self.key else ""
        return came.of(
            next((e for e in reversed(self.journal) if (e.get("action"), e.get("key")) == (action, key)), None)
        )

    @cached_property
    def model_hashes(self) -> dict[str, str]:
        """SHA-256 of the model files beside the plan that it names, by path relative to it."""
        try:
            return approval.model_hashes(self.run)
        except (WorldwrightError, OSError, ValueError, RecursionError):
            return {}

    @property
    def trajectory_sha256(self) -> str:
        """What the physics pass of this key reported; empty without one."""
        physics = self.passes["physics"].value
        return str(physics.summary.get("trajectory_sha256", "")) if physics and physics.ok else ""

    @cached_property
    def other_keys(self) -> tuple[str, ...]:
        """Evidence folders of earlier programs, plans or environments."""
        try:
            folders = [p.name for p in (self.run.folder / "evidence").iterdir() if p.is_dir()]
        except OSError:
            return ()
        return tuple(sorted(name for name in folders if not self.key or name != self.key.key))

    def earlier(self, name: str) -> bool:
        """Whether evidence of this name exists for another key."""
        return any((self.run.evidence(key) / name).exists() for key in self.other_keys)

    def failure(self, stage: PassName) -> str:
        """The message of the newest failed job of this pass and key; empty when none failed."""
        from .failures import newest_failure

        return newest_failure(self.run.jobs, stage, self.key.key) if self.key else ""


def _bytes(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except OSError:
        return None

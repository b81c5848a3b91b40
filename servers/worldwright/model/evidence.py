"""Evidence: what a pass, a scan or a reader produced, addressed by the content it vouches for.

The key is a hash of (program, plan, environment), so evidence for an older program cannot vouch for a newer one.
"""

import hashlib
from typing import Any, Literal

from .finding import Anomaly, Finding
from .frozen import Frozen

PassName = Literal["physics", "stills", "video"]
PASSES: tuple[PassName, ...] = ("physics", "stills", "video")


class Environment(Frozen):
    """What a run depends on besides its program and plan."""

    python: str
    machine: str
    """Operating system and processor architecture, e.g. `Linux-x86_64`."""
    packages: dict[str, str]
    """Version by distribution name, for everything that can change a trajectory or a picture."""
    simulator_sha256: str
    """Of the engine's shared library."""
    worldkit_sha256: str
    """Of the runtime's sources."""
    catalog_sha256: str
    """Of the asset catalog."""

    def sha256(self) -> str:
        """Identity of the environment."""
        return hashlib.sha256(self.model_dump_json().encode()).hexdigest()


class EvidenceKey(Frozen):
    """The three hashes that evidence is addressed by."""

    program_sha256: str
    plan_sha256: str
    environment_sha256: str

    @property
    def key(self) -> str:
        """Sixteen hexadecimal digits: the folder name under `evidence/`."""
        text = "\n".join((self.program_sha256, self.plan_sha256, self.environment_sha256))
        return hashlib.sha256(text.encode()).hexdigest()[:16]


class PassResult(Frozen):
    """What one staged pass did (`evidence/<key>/<pass>/result.json`)."""

    stage: PassName
    variant: str = ""
    """Name of a re-run with a difference (`physics@<variant>/`); empty for the pass itself."""
    arguments: tuple[str, ...] = ()
    """What a variant had on its command line besides the pass."""
    ok: bool
    code: str = "ok"
    """`ok`, or how it failed: crashed, no_result, timed_out, out_of_memory, out_of_cpu_time, too_much_output,
    file_too_large, disk_full, too_many_processes, environment, killed, cancelled, not_repeatable, internal."""
    message: str = ""
    place: str = ""
    """File and line, when the program raised."""
    next_move: str = ""
    started: str = ""
    """ISO 8601, UTC."""
    wall_s: float = 0.0
    sandbox: str = ""
    """Level of the ladder it ran at: bubblewrap, landlock or rlimits."""
    confinement: dict[str, str] = {}
    """What enforced it: versions, and how the number of processes was limited."""
    job: str = ""
    files: dict[str, str] = {}
    """SHA-256 by path relative to the pass folder."""
    summary: dict[str, Any] = {}
    """What the program reported: steps, trajectory hash, cameras, frames …"""


class LintReport(Frozen):
    """Findings on one exact program against one exact plan (`lint.json`)."""

    findings: tuple[Finding, ...] = ()
    rules: int = 0
    """How many rules looked."""

    @property
    def ok(self) -> bool:
        """No finding is an error."""
        return not any(f.severity == "error" for f in self.findings)


class CheckRun(Frozen):
    """One anomaly check's outcome: it ran, or why it could not."""

    code: str
    name: str
    status: Literal["clean", "found", "skipped"]
    reason: str = ""
    """For `skipped`: the missing channel."""


class ScanReport(Frozen):
    """What the anomaly scan found in one recording (`scan.json`)."""

    trajectory_sha256: str
    checks: tuple[CheckRun, ...] = ()
    anomalies: tuple[Anomaly, ...] = ()

    @property
    def ok(self) -> bool:
        """No anomaly is blocking."""
        return not any(a.severity == "blocking" for a in self.anomalies)


class ExpectationResult(Frozen):
    """One measured expectation: positive margin means it holds, by that much."""

    name: str
    arguments: dict[str, Any]
    status: Literal["holds", "fails", "unknown"]
    """`unknown`: the vocabulary has no such expectation yet, or a channel is missing."""
    measured: float | None = None
    expected: str = ""
    margin: float | None = None
    unit: str = ""
    message: str = ""


class ObjectiveResult(Frozen):
    """An objective with its measurements."""

    index: int
    claim: str
    status: Literal["proved", "refuted", "visual_only", "unproved"]
    reason: str = ""
    expectations: tuple[ExpectationResult, ...] = ()


class ExpectReport(Frozen):
    """The plan's objectives against one recording (`expect.json`)."""

    trajectory_sha256: str
    objectives: tuple[ObjectiveResult, ...] = ()

    @property
    def ok(self) -> bool:
        """Nothing is refuted and nothing is left unproved."""
        return all(o.status in ("proved", "visual_only") for o in self.objectives)


class VisualDescription(Frozen):
    """What is seen in the stills and videos of one key; describes, never judges (`visual.json`)."""

    author: str
    """`visual-analysis` for an agent, `measured` when derived from segmentation renders alone."""
    summary: str
    objects: dict[str, str] = {}
    """What is seen of each object, by name."""
    cameras: dict[str, str] = {}
    """What each camera shows."""
    objectives: dict[int, str] = {}
    """What is seen that bears on each objective, by its index."""
    concerns: tuple[str, ...] = ()

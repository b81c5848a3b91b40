"""Evidence: what a pass, a scan or a reader produced, addressed by the content it vouches for.

The key is a hash of (program, plan, environment, and what belongs to the program), so evidence for an older program cannot
vouch for a newer one. Pictures under a key are of one film, which their result names.
"""

import hashlib
from typing import Any, Literal, get_args

from pydantic import Field

from ..finding import Anomaly, Finding
from ..frozen import Frozen

PassName = Literal["bundle", "physics", "storyboard", "stills", "video", "final"]
PASSES: tuple[PassName, ...] = get_args(PassName)


class Film(Frozen):
    """What pictures depend on besides the recording that they show."""

    renderer: str
    """Name of the chosen renderer."""
    version: str
    """Its packages' versions, and the beginning of the SHA-256 of its code."""
    packages: dict[str, str]
    """Version by distribution name, for everything that can change a picture."""
    sha256: str
    """Hash of all this and of the code that draws and encodes: the film's identity."""


class Environment(Frozen):
    """What a run depends on besides its program, its plan and the assets that it uses."""

    python: str
    machine: str
    """Operating system and processor architecture, e.g. `Linux-x86_64`."""
    packages: dict[str, str]
    """Version by distribution name, for everything that can change a trajectory."""
    simulator_sha256: str
    """Hash of the engine's shared library."""
    worldkit_sha256: str
    """Hash of the code that builds, steps and records."""
    catalog_sha256: str = ""
    """Hash of the assets that one world uses (in older stamps, of the whole catalog); empty when it uses none."""
    film: Film | None = None
    """In a stamp: the film that its pictures were made with."""

    def sha256(self) -> str:
        """Hash of what every recording depends on: not how it is filmed, nor the assets of other worlds."""
        return hashlib.sha256(self.model_dump_json(exclude={"catalog_sha256", "film"}).encode()).hexdigest()


class EvidenceKey(Frozen):
    """The hashes that evidence is addressed by."""

    program_sha256: str
    plan_sha256: str
    environment_sha256: str
    companions_sha256: str = ""
    """Hash of the files beside the program that belong to it; empty when there are none."""
    assets_sha256: str = ""
    """Hash of what it uses of the catalog; empty when it uses nothing."""

    @property
    def key(self) -> str:
        """Sixteen hexadecimal digits: the folder name under `evidence/`."""
        parts = [self.program_sha256, self.plan_sha256, self.environment_sha256]
        parts += [f"{name} {sha256}" for name, sha256 in self._more() if sha256]
        text = "\n".join(parts)
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def _more(self) -> tuple[tuple[str, str], ...]:
        return (("companions", self.companions_sha256), ("assets", self.assets_sha256))


class PassResult(Frozen):
    """What one staged pass did (`evidence/<key>/<pass>/result.json`)."""

    stage: PassName
    variant: str = ""
    """Name of a re-run with a difference (`physics@<variant>/`); empty for the pass itself."""
    arguments: tuple[str, ...] = ()
    """The arguments on a variant's command line besides the pass."""
    ok: bool
    code: str = "ok"
    """`ok`, or how it failed: crashed, no_result, unnamed_asset, timed_out, out_of_memory, out_of_cpu_time, too_much_output,
    file_too_large, disk_full, too_many_processes, environment, killed, cancelled, not_repeatable, internal."""
    message: str = ""
    place: str = ""
    """File and line, when the program raised."""
    next_move: str = ""
    started: str = ""
    """ISO 8601, UTC."""
    wall_s: float = 0.0
    sandbox: str = ""
    """Level of confinement at which it ran: bubblewrap, landlock or rlimits."""
    confinement: dict[str, str] = {}
    """What enforced the confinement: versions, and how the number of processes was limited."""
    job: str = ""
    film_sha256: str = ""
    """The identity of the film (`Film`), for a pass that draws pictures."""
    files: dict[str, str] = {}
    """SHA-256 by path relative to the pass folder."""
    summary: dict[str, Any] = {}
    """What the program reported: steps, trajectory hash, cameras, frames …"""


class LintReport(Frozen):
    """Findings on one exact program against one exact plan (`lint.json`)."""

    findings: tuple[Finding, ...] = ()
    rules: int = 0
    """How many rules were applied."""

    @property
    def ok(self) -> bool:
        """Whether no finding is an error."""
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
    code_sha256: str = ""
    """The code of the checks that made it (`environment.checks`); empty in reports of before the field."""
    checks: tuple[CheckRun, ...] = ()
    anomalies: tuple[Anomaly, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether no anomaly is blocking."""
        return not any(a.severity == "blocking" for a in self.anomalies)


NEEDS_STILLS = "needs stills"
"""How the message of an expectation begins that is measured in pictures which are not drawn yet."""


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

    @property
    def needs_stills(self) -> bool:
        """Whether it is unknown for want of the stills that it is measured in."""
        return self.status == "unknown" and self.message.startswith(NEEDS_STILLS)


class ObjectiveResult(Frozen):
    """An objective with its measurements."""

    index: int
    claim: str
    status: Literal["proved", "refuted", "visual_only", "unproved"]
    reason: str = ""
    expectations: tuple[ExpectationResult, ...] = ()

    @property
    def waits(self) -> bool:
        """Whether it is unproved for want of stills alone."""
        open_ones = [e for e in self.expectations if e.status != "holds"]
        return self.status == "unproved" and bool(open_ones) and all(e.needs_stills for e in open_ones)


class ExpectReport(Frozen):
    """The plan's objectives against one recording (`expect.json`)."""

    trajectory_sha256: str
    code_sha256: str = ""
    """The code of the checks that made it (`environment.checks`); empty in reports of before the field."""
    objectives: tuple[ObjectiveResult, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether no objective is refuted or unproved."""
        return all(o.status in ("proved", "visual_only") for o in self.objectives)

    @property
    def waits(self) -> bool:
        """Whether some expectation is unknown for want of stills."""
        return any(e.needs_stills for o in self.objectives for e in o.expectations)


MEASURED = "measured"
"""Author of a description that was counted from segmentation renders, without anybody looking."""


class Sighting(Frozen):
    """Something in the pictures, named by somebody who was not told what it should be."""

    seen: str = Field(min_length=1)
    """What it is taken for, in one's own words: `a wooden crate`."""
    camera: str
    """The camera that shows it best."""


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
    named: tuple[Sighting, ...] = ()
    """What is there, named blindly."""
    event: str = ""
    """What happens, in one's own words."""
    belief: int | None = Field(None, ge=0, le=10)
    """Would one take this for a film of real things? 10: yes; None: not said."""
    betrays: tuple[str, ...] = ()
    """Details that give it away as made, the worst first."""

    @property
    def looked(self) -> bool:
        """Whether somebody described the pictures by looking at them, rather than by counting pixels."""
        return self.author != MEASURED

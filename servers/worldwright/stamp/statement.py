"""The stamp: an in-toto shaped statement about an accepted world (`accepted/stamp.json`).

Subjects are the files of the accepted folder with their SHA-256; the predicate says what they were made from, what
proved them and where. Shape: in-toto Attestation Framework, Statement v1.
"""

from typing import Literal

from pydantic import Field

from ..model.evidence import Environment
from ..model.frozen import Frozen


class Digest(Frozen):
    """A content hash."""

    sha256: str = Field(pattern=r"^[0-9a-f]{64}$")


class Subject(Frozen):
    """One file that the stamp vouches for."""

    name: str
    """Path relative to the accepted folder."""
    digest: Digest


class Source(Frozen):
    """What was accepted, before its instrumentation was taken out."""

    key: str
    """Evidence key of the run."""
    program_sha256: str
    plan_sha256: str
    prompt_sha256: str = ""
    stripped_lines: tuple[int, ...] = ()
    """Lines of instrumentation that were taken out of the program."""
    materials: dict[str, Digest] = {}
    """SHA-256 of all it was made from, by name: the run's files, `simulator`, `worldkit` and `catalog`."""


class Proof(Frozen):
    """The fresh physics pass of the accepted program."""

    trajectory_sha256: str
    rows: int | None = None
    simulated_s: float | None = None
    wall_s: float = 0.0
    sandbox: str = ""
    """Level of the ladder it ran at."""
    confinement: dict[str, str] = {}
    """What enforced it."""
    no_world: str = ""
    """Why there is no `world.mjz`; empty when there is one."""


class ExpectationVerdict(Frozen):
    """What one expectation said, with its number."""

    objective: int
    name: str
    status: str
    measured: float | None = None
    margin: float | None = None
    unit: str = ""


class ObjectiveOutcome(Frozen):
    """How one objective was decided."""

    index: int
    claim: str
    status: str
    evidence: tuple[str, ...] = ()


class Approval(Frozen):
    """Who approved the plan, and when."""

    by: str
    time: str
    auto: bool = False


class Acceptance(Frozen):
    """The predicate: everything the acceptance rests on."""

    run: str
    accepted_at: str
    """ISO 8601, UTC."""
    worldwright: str
    """Version of the suite."""
    source: Source
    proof: Proof
    environment: Environment
    cpu: str = ""
    """Processor family, which decides whether bitwise repetition can be expected."""
    evidence: dict[str, Digest] = {}
    """SHA-256 of each evidence file of the key, by path relative to the evidence folder."""
    checks: int = 0
    """Anomaly checks that looked."""
    anomalies: dict[str, int] = {}
    """Anomalies by severity."""
    objectives: tuple[ObjectiveOutcome, ...] = ()
    expectations: tuple[ExpectationVerdict, ...] = ()
    declared_interventions: tuple[str, ...] = ()
    journal_head: str = ""
    """Chain of the journal's last line when the run was accepted: binds every line before it."""
    reviewer: str = ""
    described_by: str = ""
    approval: Approval


class Statement(Frozen):
    """The whole stamp."""

    type: Literal["https://in-toto.io/Statement/v1"] = Field("https://in-toto.io/Statement/v1", alias="_type")
    subject: tuple[Subject, ...]
    predicate_type: Literal["urn:worldwright:acceptance:v1"] = Field(
        "urn:worldwright:acceptance:v1", alias="predicateType"
    )
    predicate: Acceptance

    def digest_of(self, name: str) -> str:
        """SHA-256 of a subject, or an empty text."""
        return next((s.digest.sha256 for s in self.subject if s.name == name), "")

    def to_json(self) -> str:
        """The statement as indented JSON text with a final newline."""
        return self.model_dump_json(by_alias=True, indent=2) + "\n"

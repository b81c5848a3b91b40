"""The stamp: an in-toto shaped statement about an accepted world (`accepted/stamp.json`).

Subjects are the files of the accepted folder with their SHA-256; the predicate says what they were made from, what
proved them, of which kind each proof is, and where. Shape: in-toto Attestation Framework, Statement v1.
"""

from typing import Any, Literal

from pydantic import Field

from ..model.evidence import approval
from ..model.evidence.handed_in import HandedIn
from ..model.evidence.reports import Environment
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
    """What was accepted, before its instrumentation was removed."""

    key: str
    """Evidence key of the run."""
    program_sha256: str
    plan_sha256: str
    prompt_sha256: str = ""
    stripped_lines: tuple[int, ...] = ()
    """Lines of instrumentation that were taken out of the program."""
    materials: dict[str, Digest] = {}
    """SHA-256 of everything it was made from, by name: the run's files, `simulator`, `worldkit`, `catalog` and `film`."""


class Proof(Frozen):
    """The fresh physics pass of the accepted program."""

    trajectory_sha256: str
    rows: int | None = None
    simulated_s: float | None = None
    wall_s: float = 0.0
    began: str = ""
    """When it was simulated, ISO 8601, UTC; empty in older stamps."""
    key: str = ""
    """The evidence key that it was simulated under; empty in older stamps."""
    earlier: bool = False
    """The call that stamped it found it as an earlier call's result, and simulated nothing itself."""
    sandbox: str = ""
    """Level of confinement at which it ran."""
    confinement: dict[str, str] = {}
    """What enforced the confinement, by name."""
    world_sha256: str = ""
    """SHA-256 of `world.mjz`, the world that was simulated."""
    content_sha256: str = ""
    """SHA-256 of what `world.mjz` holds, however it is packed (`worldkit.closed_archive`); empty in older stamps."""
    inputs_sha256: str = ""
    """SHA-256 of the inputs that were sent to the world while it ran; empty when there were none."""
    channels: dict[str, Literal["exact", "law re-run", "tolerance"]] = {}
    """The kind of proof by channel (`motion`, `inputs`, a solver's, `pictures`), from version 2 on; see `exactness`."""
    marks: tuple[str, ...] = ()
    """What limits that exactness, from version 2 on: names of `exactness.LIMITS` (sentences in older stamps)."""
    simulated_again: tuple[str, ...] = ()
    """Parts of the audits of causes and of a finer step, drawn by chance, that were simulated again before it was signed."""
    no_world: str = ""
    """Why there is no `world.mjz`, in stamps of worlds that were simulated by their own program."""


class Filmed(Frozen):
    """The author's film, where there is one: it draws the recording, and adds to its pictures what is told here."""

    sha256: str
    """The SHA-256 of `film.py` and the files that belong to it."""
    drawn_only: tuple[str, ...] = ()
    """What is drawn and was not simulated."""
    looks: dict[str, str] = {}
    """Looks that are not the world's own, by body or geom."""
    hidden: dict[str, float] = {}
    """Seconds of film in which something drawn only stands before the middle of a moving body, by which before which."""
    shots: tuple[dict[str, Any], ...] = ()
    """Each shot's film time and length (`film_s`, `seconds`), recorded times (`from_s`, `to_s`) and mean `speed`; where it has
    any, what the cut before it leaps over (`leap_s`, below 0: back) and how far its camera is rolled over (`rolled_deg`)."""
    time_map: tuple[dict[str, float], ...] = ()
    """Recorded seconds in a second of film (`pace`, below 0: backwards), cuts and all, from `film_s` on for `seconds`; where cuts go
    back, by how much (`back_s`)."""
    captions: tuple[str, ...] = ()
    """The words in its picture, word for word: its author's, and no evidence of anything."""


class ExpectationVerdict(Frozen):
    """The result of one expectation, with the measured number."""

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
    looked_at: bool | None = None
    """Whether somebody described the pictures by looking at them; None when the objective needs no picture."""


class Approval(Frozen):
    """In whose name the plan was approved, if it was in anybody's, and the time."""

    by: str
    """The name that the approval gives, which its sender chose; see `told`."""
    time: str
    auto: bool = False
    """Whether nobody read the plan."""
    came: str = ""
    """How the approval was sent: at a terminal, by a harness, a command line or automation."""

    @property
    def told(self) -> str:
        """In whose name, or that it was nobody's, as a clause."""
        return approval.told(self.by, auto=self.auto)


class Acceptance(Frozen):
    """The predicate: everything the acceptance rests on."""

    run: str
    accepted_at: str
    """ISO 8601, UTC."""
    worldwright: str
    """Version of the suite."""
    source: Source
    proof: Proof
    film: Filmed | None = None
    drawn_only: tuple[str, ...] = ()
    """What the program draws, nothing can touch and the plan does not have; `drawn_by_program`."""
    handed_in: HandedIn | None = Field(None, exclude_if=lambda value: value is None)
    """A film that the author drew with a renderer of their own: listed, and no evidence of anything."""
    environment: Environment
    cpu: str = ""
    """Processor family, which decides whether bitwise repetition can be expected."""
    evidence: dict[str, Digest] = {}
    """SHA-256 of each evidence file of the key, by path relative to the evidence folder."""
    checks: int = 0
    """How many anomaly checks ran."""
    anomalies: dict[str, int] = {}
    """Anomalies by severity."""
    objectives: tuple[ObjectiveOutcome, ...] = ()
    expectations: tuple[ExpectationVerdict, ...] = ()
    declared_interventions: tuple[str, ...] = ()
    journal_head: str = ""
    """Chain of the journal's last line when the run was accepted; it binds every line before it."""
    journal_seal: str = ""
    """How many of its lines which key had sealed then, and which it had not (`seals`); empty in older stamps."""
    reviewer: str = ""
    """The name that the review gives."""
    review_came: str = ""
    """How the review was sent."""
    described_by: str = ""
    """The name that the description gives; `measured` when it was made without looking."""
    description_came: str = ""
    """How the description was sent."""
    approval: Approval


class Statement(Frozen):
    """The whole stamp."""

    type: Literal["https://in-toto.io/Statement/v1"] = Field("https://in-toto.io/Statement/v1", alias="_type")
    subject: tuple[Subject, ...]
    predicate_type: Literal["urn:worldwright:acceptance:v1", "urn:worldwright:acceptance:v2"] = Field(
        "urn:worldwright:acceptance:v2", alias="predicateType"
    )
    """Version 1 does not say how each channel was proved. Other versions are refused."""
    predicate: Acceptance

    @property
    def first(self) -> bool:
        """Whether it is of version 1."""
        return self.predicate_type.endswith(":v1")

    @property
    def not_looked_at(self) -> tuple[int, ...]:
        """Indices of objectives that only a picture can show, in a world whose pictures nobody looked at."""
        return tuple(o.index for o in self.predicate.objectives if o.looked_at is False)

    def digest_of(self, name: str) -> str:
        """SHA-256 of a subject, or an empty text."""
        return next((s.digest.sha256 for s in self.subject if s.name == name), "")

    def to_json(self) -> str:
        """The statement as indented JSON text with a final newline."""
        return self.model_dump_json(by_alias=True, indent=2) + "\n"

"""One world's row: what is handed back of it. Everything large stays on disk, and the row says where."""

from typing import Literal, get_args

from ..model.evidence.build_steps import StepName
from ..model.frozen import Frozen

Outcome = Literal["accepted", "held", "refuted", "failed", "waiting", "gave_up"]
"""`held`: everything up to the campaign's last step holds; `refuted`: measured, and not as claimed; `failed`: a step says no;
`waiting`: for a person's or an author's work; `gave_up`: its time or its beginnings were used up, or its worker died."""
OUTCOMES: tuple[Outcome, ...] = get_args(Outcome)


class Cause(Frozen):
    """Why a world is not what was asked for."""

    kind: str
    """The code of what said no (`WL101`, `WS110`, `crashed`, `over_time`, `worker_died`, …): failures are grouped by it."""
    step: StepName | Literal["seed", "author", "worker"]
    """Where; `seed`: before the first step, `author`: while its world was written, `worker`: outside of any."""
    said: str
    next_move: str = ""


class Margin(Frozen):
    """One measured expectation."""

    objective: int
    name: str
    status: Literal["holds", "fails", "unknown"]
    measured: float | None = None
    margin: float | None = None
    """Above 0: it holds, by so much, in `unit`."""
    unit: str = ""


class Written(Frozen):
    """What an author's sessions for one world came to, all of them together."""

    author: str = ""
    """The harness."""
    tokens_read: int = 0
    """Of the main thread alone where the harness is Codex or OpenCode, whose events tell nothing of their agents: a lower bound.
    Those of `tokens_written` and `usd` likewise."""
    tokens_written: int = 0
    usd: float | None = None
    """US dollars, by the harness's own reckoning or the campaign's prices; None where neither tells it."""
    author_seconds: float = 0.0
    transcript: str = ""
    """Of the last session, relative to the campaign's folder: each event a line of JSON."""


class Row(Written, cache_strings="keys"):
    """What came of one world; no text of it is kept for the next one, since hardly any comes again."""

    world: str
    """Sixteen hexadecimal digits: the hash of what it is made of and of how far it is taken."""
    number: int
    """Its place in the campaign."""
    category: str = ""
    prompt: str = ""
    values: dict[str, float] = {}
    """What a sweep set, by field."""
    outcome: Outcome
    cause: Cause | None = None
    also: tuple[Cause, ...] = ()
    """What else was wrong in the same group of steps."""
    iterations: int = 0
    """Programs that were tried: keys of evidence."""
    runs: int = 0
    """Physics passes that simulated, variants among them."""
    begun: int = 1
    """How often it was begun."""
    seconds: float = 0.0
    """By the clock of its worker, the last time that it was begun."""
    minutes: dict[str, float] = {}
    """By step; `report` among them."""
    interventions: tuple[str, ...] = ()
    """What acted besides the engine's step, as `kind on target`; undeclared ones end with `(undeclared)`."""
    margins: tuple[Margin, ...] = ()
    plan_sha256: str = ""
    program_sha256: str = ""
    world_sha256: str = ""
    """Of the compiled world's file."""
    trajectory_sha256: str = ""
    environment_sha256: str = ""
    key: str = ""
    """The folder under `evidence/`."""
    folder: str = ""
    """Its run folder, relative to the campaign's."""
    recording: str = ""
    """Relative to the campaign's folder, too."""
    report: str = ""
    poster: str = ""
    film: str = ""
    """The accepted film, else the one of its evidence; the author's before a camera's."""
    memory_mb: float = 0.0
    """Largest resident memory of its worker so far."""
    worker: str = ""
    """Host and process that did it."""

    @property
    def ok(self) -> bool:
        """Whether it is what was asked for."""
        return self.outcome in ("accepted", "held")

    @property
    def margin(self) -> float | None:
        """The smallest margin of all its expectations; None where nothing was measured."""
        return min((m.margin for m in self.margins if m.margin is not None), default=None)

    def text(self) -> str:
        """One line."""
        values = ", ".join(f"{name.rsplit('.', 1)[-1]} {value:g}" for name, value in self.values.items())
        why = f": {self.cause.kind} in {self.cause.step}, {self.cause.said.splitlines()[0]}" if self.cause else ""
        return f"{self.number} {self.world} {self.outcome}{f' ({values})' if values else ''}{why}"

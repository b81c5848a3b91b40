"""What the audits of truth found: what acted on the state, what a finer time step changes, what causes what, what is robust.

All are evidence of one key: `interventions.json` (`InterventionReport`, made by every scan), `refine.json`
(`RefineReport`, made by `scan --refine`), `causes.json` (`CausesReport`, made by `scan --causes`) and `robust.json`
(`RobustReport`, made by `scan --robust`).
"""

from typing import Any, Literal

from pydantic import Field, model_validator

from ..finding import Anomaly
from ..frozen import Frozen

Trigger = Literal["always", "time", "state"]
"""When a declared intervention acts: all the time, at a given time, or once a measured condition holds."""


class Acting(Frozen):
    """One kind of intervention on one target, over the whole recording."""

    kind: str
    target: str
    body: str
    """The body, actuator or constraint that owns the target."""
    count: int
    """Recorded steps in which it acted."""
    stretches: int
    """Separate stretches of time in which it acted."""
    first_s: float
    last_s: float
    peak: float
    """Largest magnitude of its value, in `unit`."""
    unit: str
    work_j: float
    """Net work done on the system; 0 where the ledger cannot attribute any."""
    impulse_n_s: float = 0.0
    """Norm of the summed impulse of its forces."""
    angular_impulse_n_m_s: float = 0.0
    """Sum of the magnitudes of its torques times time: what a balancing torque cannot hide by changing sign."""
    airborne_s: float = 0.0
    """For how long it acted while the body touched nothing."""
    declared: bool = False
    law: str = ""
    trigger: str = ""
    when: Trigger | None = None
    source: str = ""

    @property
    def text(self) -> str:
        """One line for a person."""
        said = (
            f"declared: {self.law} (trigger: {self.trigger}; source: {self.source})" if self.declared else "UNDECLARED"
        )
        parts = [f"peak {self.peak:.3g} {self.unit}".rstrip(), f"work {self.work_j:.3g} J"]
        if self.impulse_n_s:
            parts.append(f"impulse {self.impulse_n_s:.3g} N·s")
        if self.angular_impulse_n_m_s:
            parts.append(f"angular impulse {self.angular_impulse_n_m_s:.3g} N·m·s")
        if self.airborne_s:
            parts.append(f"{self.airborne_s:.3g} s of it in the air")
        head = f"{self.kind} on {self.target}, {self.count} steps, {self.first_s:.3f}-{self.last_s:.3f} s"
        return f"{head}: {', '.join(parts)}; {said}"


class LoadPath(Frozen):
    """The load that two geoms pass to each other."""

    geoms: tuple[str, str]
    bodies: tuple[str, str]
    impulse_n_s: float
    """Sum of the magnitudes of their contact forces, times time."""
    share: tuple[float, float]
    """Its share of all the contact impulse on each of the two bodies."""
    peak_n: float
    first_s: float
    last_s: float


class Carrier(Frozen):
    """A tendon, an equality or a joint that could carry a load, and what it did carry."""

    kind: Literal["tendon", "equality", "joint"]
    name: str
    bodies: tuple[str, ...]
    peak: float
    unit: str
    impulse: float
    """Load integrated over time, `unit`·s."""
    loaded_share: float
    """Share of the time in which it carries more than a thousandth of its bodies' weight."""


class Seen(Frozen):
    """Two visible geoms that overlap although the engine never lets them touch."""

    geoms: tuple[str, str]
    bodies: tuple[str, str]
    depth_m: float
    time_s: float
    why: str
    """The reason why they do not collide."""
    window_s: tuple[float, float] | None = None
    """When they were first and last seen inside each other."""


class Standing(Frozen):
    """What acts all the time from inside the engine's step: a number of the model, which nobody sends."""

    kind: str
    """`wind`, `running surface` or `adhesion`."""
    target: str
    peak: float
    """In `unit`."""
    unit: str
    declared: bool = False
    law: str = ""
    source: str = ""

    @property
    def text(self) -> str:
        """One line for a person."""
        said = f"declared: {self.law} (source: {self.source})" if self.declared else "UNDECLARED"
        return f"{self.kind} of {self.target}, throughout, {self.peak:.3g} {self.unit}; {said}"


class InterventionReport(Frozen):
    """Everything that acts besides the engine's step, who carries the load, and what is only drawn."""

    trajectory_sha256: str
    acting: tuple[Acting, ...] = ()
    standing: tuple[Standing, ...] = ()
    load_paths: tuple[LoadPath, ...] = ()
    """The largest impulse first; at most forty."""
    carriers: tuple[Carrier, ...] = ()
    overlaps: tuple[Seen, ...] = ()
    anomalies: tuple[Anomaly, ...] = ()
    """Also part of the scan's anomalies."""

    @property
    def undeclared(self) -> tuple[Acting, ...]:
        """Interventions that the plan does not declare."""
        return tuple(row for row in self.acting if not row.declared)

    @property
    def ok(self) -> bool:
        """Whether everything that acts is declared and no finding blocks."""
        return not self.undeclared and not any(a.severity == "blocking" for a in self.anomalies)


class Claim(Frozen):
    """One expectation at both time steps."""

    objective: int
    name: str
    at_step: Literal["holds", "fails", "unknown"]
    at_finer: Literal["holds", "fails", "unknown"]
    measured: float | None = None
    measured_finer: float | None = None
    unit: str = ""
    message: str = ""

    @property
    def artefact(self) -> bool:
        """It holds at one time step and not at the other."""
        return self.at_step != self.at_finer


class Drift(Frozen):
    """How far one quantity at the finer time step is from the same at the coarser."""

    quantity: str
    body: str
    value: float
    """The largest difference over the common time."""
    at_s: float
    unit: str
    relative: float
    """The difference relative to the quantity's own change over the recording."""


class RefineReport(Frozen):
    """The physics pass at half the time step (`refine.json`)."""

    trajectory_sha256: str
    refined_sha256: str
    time_step: float
    refined_time_step: float
    claims: tuple[Claim, ...] = ()
    drift: tuple[Drift, ...] = ()
    anomalies: tuple[Anomaly, ...] = ()
    """`WS311`: claims that hold at one step only (blocking); blocking findings that appear at one step only."""

    @property
    def ok(self) -> bool:
        """Whether the pass was repeated and nothing depends on the time step."""
        return bool(self.refined_sha256) and not any(a.severity == "blocking" for a in self.anomalies)


class Trial(Frozen):
    """One repetition of the physics pass with one thing changed."""

    label: str
    """The change as the program's options say it, e.g. `without foot`, `weaken foot=0.5`."""
    trajectory_sha256: str = ""
    failed: str = ""
    """Why it could not be run, when it could not."""


class Held(Frozen):
    """One expectation that holds as planned, in worlds a little otherwise."""

    objective: int
    name: str
    holds: int
    """In so many worlds it holds, too."""
    of: int
    """So many could be simulated, or diverged, in which no claim holds."""
    not_in: tuple[str, ...] = ()
    """Labels of those in which it does not hold."""
    message: str = ""
    """The first of these, and what was measured there."""

    def text(self) -> str:
        """One line."""
        where = f", not with {', '.join(self.not_in)} ({self.message})" if self.not_in else ""
        return f"objective {self.objective}, {self.name}: holds in {self.holds} of {self.of} worlds{where}"


class RobustReport(Frozen):
    """How robust the claims are (`robust.json`): a remark, which blocks nothing."""

    trajectory_sha256: str
    worlds: tuple[Trial, ...] = ()
    claims: tuple[Held, ...] = ()

    @property
    def everywhere(self) -> int:
        """The number of claims that hold in every world; of one that could not be simulated nobody knows."""
        return sum(claim.holds == len(self.worlds) > 0 for claim in self.claims)

    def text(self) -> str:
        """The claims that do not hold everywhere, one line each, and the count of the others."""
        lines = [f"robust: {claim.text()}" for claim in self.claims if claim.not_in]
        lines += [
            f"robust: {world.label} could not be simulated: {world.failed}" for world in self.worlds if world.failed
        ]
        claims = f"{self.everywhere} of {len(self.claims)} measured claims hold"
        return "\n".join([*lines, f"robust: {claims} in all of {len(self.worlds)} worlds a little otherwise"])


class Response(Frozen):
    """What one expectation of the effect did in one trial."""

    trial: str
    status: Literal["holds", "fails", "unknown"]
    event_s: float | None = None
    """When the effect happened, when it is an event."""
    measured: float | None = None
    unit: str = ""
    message: str = ""


class CauseResult(Frozen):
    """One objective with a cause: what its effect did without the cause, and with a weaker one."""

    objective: int
    claim: str
    cause: str
    effect: str
    outcome: Literal["caused", "survives", "timed", "unclear"]
    """`survives`: the effect holds without its cause. `timed`: it does not move when the cause is weakened."""
    message: str
    as_planned: tuple[Response, ...] = ()
    without: tuple[Response, ...] = ()
    weakened: tuple[Response, ...] = ()


class TriggerResult(Frozen):
    """One discrete intervention: does its moment depend on anything that happens in the world?"""

    kind: str
    target: str
    declared: bool
    declared_when: Trigger | None
    onset_s: float
    onsets_s: dict[str, float | None]
    """When it first acted in each trial; None: it did not."""
    values_move: bool
    """Whether the values that it wrote differ between trials."""
    outcome: Literal["consequence", "timed", "fixed_size", "declared_time", "unclear"]
    message: str


NOT_OFF = "it could not be"
"""So begins what is said of an intervention whose trial could not be made."""


class HelperResult(Frozen):
    """One declared intervention switched off: which claims need it."""

    kind: str
    target: str
    law: str
    needed_by: tuple[int, ...]
    """Objectives whose expectations fail without it."""
    failed: bool = Field(False, exclude_if=lambda value: not value)
    """The trial without it could not be made, so that nothing is known of it."""
    message: str

    @model_validator(mode="before")
    @classmethod
    def _told_in_words(cls, told: Any) -> Any:
        """Reports of before the field said it in their message alone."""
        words = isinstance(told, dict) and "failed" not in told and str(told.get("message", "")).startswith(NOT_OFF)
        return {**told, "failed": True} if words else told


class CausesReport(Frozen):
    """The causal audit (`causes.json`)."""

    trajectory_sha256: str
    trials: tuple[Trial, ...] = ()
    causes: tuple[CauseResult, ...] = ()
    triggers: tuple[TriggerResult, ...] = ()
    helpers: tuple[HelperResult, ...] = ()
    anomalies: tuple[Anomaly, ...] = ()
    """`WS321` effect survives without its cause, `WS322` timed effect, `WS323` timed trigger, `WS324` unclear."""

    @property
    def ok(self) -> bool:
        """Whether every declared cause was shown to be one, and nothing is timed that should be a consequence."""
        return not any(a.severity == "blocking" for a in self.anomalies)

"""The review: three evidence channels triangulated into a typed verdict."""

from typing import Literal

from pydantic import Field, model_validator

from ..frozen import Frozen

RepairTarget = Literal[
    "physical_parameters",
    "initial_motion",
    "object_settlement",
    "object_placement",
    "scale",
    "camera_placement",
    "visual_mismatch",
    "missing_object",
    "not_recognised",
    "look",
    "simulator_symbol",
    "solver_or_time_step",
    "undeclared_intervention",
    "plan",
]


class ObjectiveVerdict(Frozen):
    """One objective, bound to the evidence that decided it."""

    index: int
    """Position in the plan's objectives, from 0."""
    met: bool
    evidence: tuple[str, ...] = Field(min_length=1)
    """What it rests on, e.g. `expect:bounces`, `scan:clean`, `visual:overview`."""
    note: str = ""


class CrossCheck(Frozen):
    """A claim of one channel tested in another."""

    claim: str
    channel: Literal["numeric", "visual", "plan"]
    tested_in: Literal["numeric", "visual", "plan"]
    confirmed: bool
    note: str = ""


class Recognition(Frozen):
    """Whether somebody who was told nothing saw what was wanted."""

    wanted: str
    """An object of the plan, or `event`: what the prompt says happens."""
    seen_as: str = ""
    """What the description calls it, word for word; empty when it names nothing of the kind."""
    same: bool
    """Whether that is the thing, a synonym or a kind of it."""

    @model_validator(mode="after")
    def _named(self) -> "Recognition":
        if self.same and not self.seen_as:
            raise ValueError("`same` needs `seen_as`: what the description calls it")
        return self


class Verdict(Frozen):
    """The reviewer's typed verdict (`review.json`)."""

    reviewer: str
    outcome: Literal["pass", "repair", "blocked"]
    numeric: str
    """The evidence of the scan, the expectations and the program's own report."""
    visual: str
    """What the pictures show."""
    plan: str
    """Whether the objectives are met, and by what."""
    objectives: tuple[ObjectiveVerdict, ...] = ()
    recognised: tuple[Recognition, ...] = ()
    """Every thing that the pictures are about, and the `event`, against what was named blindly."""
    cross_checks: tuple[CrossCheck, ...] = ()
    repair_target: RepairTarget | None = None
    repair: str = ""
    """The one targeted patch to make, when the outcome is `repair`."""

    @model_validator(mode="after")
    def _consistent(self) -> "Verdict":
        if self.outcome == "pass" and not all(o.met for o in self.objectives):
            raise ValueError("outcome `pass` needs every objective met; use `repair` and name the target")
        if self.outcome == "repair" and (self.repair_target is None or not self.repair):
            raise ValueError("outcome `repair` needs `repair_target` and `repair`: one target, one patch")
        return self

"""What a check reports, and what it may ask: the vocabulary between the engine and the shelf of checks."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from ...model.finding import AnomalySeverity
from ...model.plan.committed import Intervention, Plan
from ...model.plan.declaration import covering, declaration
from ...model.recording.trajectory import Trajectory
from ..objectives.claims import EXPECTATIONS

Array = np.ndarray


class Sign(NamedTuple):
    """One implausible stretch of motion; the engine adds the check's code and name."""

    body: str
    window_s: tuple[float, float]
    measured: float
    threshold: float
    unit: str
    severity: AnomalySeverity
    message: str
    extent_m: float | None = None
    """The size of the fault in the world, m, where `measured` has another unit."""


class SkipError(Exception):
    """The recording cannot answer this check; the message says why."""


@dataclass(frozen=True)
class Case:
    """A motion for a check's tests: what it is, the recording, and the plan facts to judge it by."""

    title: str
    trajectory: Trajectory
    context: "Context" = field(default_factory=lambda: Context())
    severity: AnomalySeverity | None = None
    """The severity that a BAD case must get; None: any."""


CaseMaker = Callable[[], Case]


@dataclass(frozen=True)
class Context:
    """What the plan says, as far as checks need it; an empty context when there is no plan."""

    planned: bool = False
    movers: tuple[str, ...] = ()
    """Bodies that some step expects to move."""
    fixed: tuple[str, ...] = ()
    """Bodies that must not move."""
    interventions: tuple[Intervention, ...] = ()
    duration_s: float | None = None
    rests: tuple[str, ...] = ()
    """Bodies that an objective claims to come to rest or to stay, up to the end."""
    rest_claims: tuple[tuple[str, dict[str, Any]], ...] = ()
    """The expectations that claim such rest, by name, with their arguments."""
    plan: Plan | None = None
    """The whole plan, for rare questions."""

    @classmethod
    def of(cls, plan: Plan | None) -> "Context":
        """The facts of a plan."""
        if plan is None:
            return cls()
        rests: list[str] = []
        claims: list[tuple[str, dict[str, Any]]] = []
        still = {entry.name for entry in EXPECTATIONS.values() if entry.RESTS}
        duration = plan.simulation_parameters.simulation_duration
        for objective in plan.objectives:
            for expectation in objective.expect:
                for name, arguments in expectation.items():
                    if name not in still:
                        continue
                    if isinstance(arguments, dict) and not _ends_early(arguments.get("window_s"), duration):
                        rests += [arguments.get("body") or "", *_strings(arguments.get("bodies"))]
                        claims.append((name, arguments))
        return cls(
            planned=True,
            movers=plan.movers(),
            fixed=tuple(o.name for o in plan.scene_objects if o.fixed)
            + tuple(n for a in plan.assets if a.fixed for n in a.instances),
            interventions=plan.declared(),
            duration_s=None if isinstance(duration, str) else duration,
            rests=tuple(dict.fromkeys(name for name in rests if name)),
            rest_claims=tuple(claims),
            plan=plan,
        )

    def of_recording(self, trajectory: Trajectory) -> "Context":
        """The same facts, said of the points too where a row of interventions names a flex."""
        if not trajectory.flex_points:
            return self
        return replace(self, interventions=covering(self.interventions, trajectory.flex_points))

    def declares(self, kind: str, target: str) -> bool:
        """Whether the plan means this kind of intervention on this target; see `model.declared`."""
        return declaration(kind, target, self.interventions) is not None

    def acts_on(self, body: str, kinds: Iterable[str]) -> bool:
        """Whether the plan declares any of these kinds on the body."""
        return any(self.declares(kind, body) for kind in kinds)


def _ends_early(window_s: object, duration: object) -> bool:
    """Whether an expectation speaks of a stretch that ends before the simulation does: afterwards all may move again."""
    end = window_s[1] if isinstance(window_s, (list, tuple)) and len(window_s) == 2 else None
    return isinstance(end, (int, float)) and isinstance(duration, (int, float)) and end < duration


def _strings(value: object) -> list[str]:
    return [str(v) for v in value] if isinstance(value, (list, tuple)) else []


def spans(mask: Array, bridge: int = 0) -> Array:
    """(K, 2) first and last+1 rows of the runs where `mask` (N,) is true, merged over gaps of up to `bridge` rows."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], np.asarray(mask, dtype=np.int8), [0]))))
    found = edges.reshape(-1, 2)
    if bridge and len(found) > 1:
        split = np.flatnonzero(found[1:, 0] - found[:-1, 1] > bridge)
        found = np.stack([found[np.concatenate(([0], split + 1)), 0], found[np.concatenate((split, [-1])), 1]], axis=1)
    return found


def sliding_sum(values: Array, rows: int) -> Array:
    """Sums over windows of `rows` along the first axis, (N - rows + 1, …)."""
    total = np.concatenate((np.zeros((1, *values.shape[1:])), np.cumsum(values, axis=0)))
    return total[rows:] - total[:-rows]

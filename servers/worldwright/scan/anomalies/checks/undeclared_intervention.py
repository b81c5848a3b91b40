"""Something other than the engine acted on the state, and the plan does not say so.

What it means: a pose or velocity was written, a force or torque applied, a constraint switched, a parameter edited, a
control given. Each can be legitimate (a winch, a release) or stage the outcome; which one, only a reader can tell, so
it must be declared in `simulation_parameters.interventions`, with its law and the source of its constants.

Formula: the recording's ledger grouped by kind and target, minus the plan's (kind, body) pairs.
Threshold: none; one record is enough. Blocking with a plan; without one a warning (a plain control: a remark).
Source: the facts on staging; the architecture's "Interventions are recorded".
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.finding import AnomalySeverity
from ....model.plan.committed import Intervention
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign

CODE = "WS108"
STAGING = True
REPAIR = "undeclared_intervention"
NEEDS = ("interventions",)
UNITS = {"force": "N", "torque": "N·m", "control": "control", "pose": "m", "velocity": "m/s", "mocap": "m"}


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each undeclared kind and target once."""
    ledger = trajectory.interventions
    if ledger is None or not len(ledger.time):
        return
    for (kind, target), rows in ledger.groups.items():
        if context.declares(kind, target):
            continue
        size = float(np.sqrt((ledger.value[rows] ** 2).sum(axis=1)).max())
        work = float(np.nansum(ledger.work_j[rows]))
        severity: AnomalySeverity = "blocking" if context.planned else "info" if kind == "control" else "warn"
        message = (
            f"{kind} on {target}, {len(rows)} times"
            + (f", doing {work:.3g} J" if work else "")
            + ("; the plan declares no such intervention" if context.planned else "; no plan declares it")
        )
        window = (ledger.time[rows[0]], ledger.time[rows[-1]])
        yield Sign(target, window, size, 0.0, UNITS.get(kind, ""), severity, message)


DECLARED = Intervention(kind="force", bodies=("body",), law="5 N along +x", trigger="t in 0.1..0.11 s", source="plan")


def _secret_push() -> Case:
    push = replace(analytic.resting(), interventions=analytic.pushed())
    return Case("a force nobody declared", push, Context(planned=True), severity="blocking")


def _other_kind() -> Case:
    push = replace(analytic.resting(), interventions=analytic.pushed("pose"))
    context = Context(planned=True, interventions=(DECLARED,))
    return Case("a pose written where a force was declared", push, context, severity="blocking")


def _declared() -> Case:
    push = replace(analytic.resting(), interventions=analytic.pushed())
    return Case("a declared force", push, Context(planned=True, interventions=(DECLARED,)))


GOOD = (
    _declared,
    lambda: Case(
        "nothing but the engine",
        replace(analytic.resting(), interventions=analytic.pushed(count=0)),
        Context(planned=True),
    ),
)
BAD = (_secret_push, _other_kind)

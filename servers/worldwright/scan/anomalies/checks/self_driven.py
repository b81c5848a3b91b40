"""An actuator pushes although the program never asks it to, and the plan does not say so.

What it means: a servo left at its rest, or a force with a constant bias, holds or balances a body from inside the model,
where no control is written and nothing shows in the ledger.

Formula: an actuator without any `control` in the ledger whose largest force over the recording is not 0.
Threshold: a millionth of the weight of the bodies it acts on, or 1 uN. Blocking with a plan; without one a remark.
Source: the facts on staging (an invisible torque keeping a figure upright).
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign
from .seen_through import carrying
from .unloaded_tendon import weights

CODE = "WS308"
STAGING = True
NEEDS = ("loads", "interventions")


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each actuator that acts by itself."""
    for name, bodies, force in self_driven(trajectory):
        if any(context.declares("control", target) for target in (name, *bodies)):
            continue
        peak = float(np.abs(force).max(initial=0.0))
        work = "blocking" if context.planned else "info"
        message = f"actuator {name} exerts up to {peak:.3g} on {', '.join(bodies) or 'the world'} without being asked"
        yield Sign(name, (trajectory.t[0], trajectory.t[-1]), peak, 0.0, "N, N·m", work, message)


def self_driven(trajectory: Trajectory) -> Iterator[tuple[str, tuple[str, ...], np.ndarray]]:
    """Name, bodies and force (T,) of each actuator that exerts a force while the ledger holds no control of it."""
    assert trajectory.loads is not None and trajectory.interventions is not None
    ledger, weight = trajectory.interventions, weights(trajectory)
    asked = {str(t).rpartition("/")[2] for t, k in zip(ledger.target, ledger.kind, strict=True) if k == "control"}
    actuators = trajectory.meta.get("actuators") or ()
    if len(actuators) != trajectory.loads.actuator_force.shape[1]:
        return
    for column, actuator in enumerate(actuators):
        name, bodies = str(actuator["name"]), tuple(actuator.get("bodies") or ())
        force = trajectory.loads.actuator_force[:, column]
        limit = max(1e-6, 1e-6 * sum(weight.get(b, 0.0) for b in bodies))
        if name not in asked and float(np.abs(force).max(initial=0.0)) > limit:
            yield name, bodies, force


def _servo(force: float) -> Trajectory:
    still = replace(analytic.resting(), interventions=analytic.pushed(count=0))
    loads = carrying(actuator_force=np.full((len(still.t), 1), force))
    return replace(still, loads=loads, meta={"actuators": [{"name": "balance", "bodies": ["body"]}]})


GOOD = (lambda: Case("an idle motor", _servo(0.0), Context(planned=True)),)
BAD = (lambda: Case("a servo that balances unasked", _servo(12.0), Context(planned=True), severity="blocking"),)

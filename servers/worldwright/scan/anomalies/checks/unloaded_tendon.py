"""A tendon that is drawn never carries anything.

What it means: guy lines, chains or strings look as if they held something, while a pin, a weld or a pose does. A slack
line may be meant; which of the two it is, a reader must judge.

Formula: the largest tension over the recording, by spring, damper, limit and motors, against a thousandth of the weight
of the bodies it acts on (or 1 mN).
Threshold: as said. A warning; blocking when an expectation or a cause of the plan names the tendon.
Source: the facts on staging (guy lines that carry nothing while the cloth is pinned).
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..declared import cast, weighs
from ..sign import Case, Context, Sign
from .seen_through import carrying

CODE = "WS305"
STAGING = True
NEEDS = ("loads",)
SHARE = 1e-3


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each tendon that carries nothing."""
    assert trajectory.loads is not None
    names = cast(context)
    weight = weights(trajectory)
    driven = {b for a in trajectory.meta.get("actuators") or () for b in a.get("bodies") or ()}
    for column, tendon in enumerate(trajectory.meta.get("tendons") or ()):
        bodies = tuple(tendon.get("bodies") or ())
        if column >= trajectory.loads.tendon_force.shape[1] or (bodies and set(bodies) <= driven):
            continue
        peak = float(np.abs(trajectory.loads.tendon_force[:, column]).max(initial=0.0))
        threshold = max(1e-3, SHARE * sum(weight.get(b, 0.0) for b in bodies))
        if peak <= threshold:
            name = str(tendon["name"])
            message = f"tendon {name} never carries more than {peak:.3g} N"
            window = (trajectory.t[0], trajectory.t[-1])
            severity = weighs(context, False, claimed=name in names)
            yield Sign(name, window, peak, threshold, "N", severity, message)


def weights(trajectory: Trajectory) -> dict[str, float]:
    """The weight, N, of each body with all that is welded on below it, by name."""
    g = float(np.sqrt((trajectory.gravity**2).sum()))
    own = {str(b["name"]): float(b.get("mass") or 0.0) * g for b in trajectory.meta.get("bodies") or ()}
    members = {name: [trajectory.names[m] for m in trajectory.members(b)] for b, name in enumerate(trajectory.names)}
    return {name: sum(own.get(part, 0.0) for part in members.get(name, [name])) for name in own}


def _line(tension: float) -> Trajectory:
    still = analytic.resting()
    loads = carrying(tendon_force=np.full((len(still.t), 1), tension))
    return replace(still, loads=loads, meta={"tendons": [{"name": "guy", "bodies": ["body"]}]})


GOOD = (lambda: Case("a line under load", _line(5.0), Context(planned=True)),)
BAD = (lambda: Case("a line that carries nothing", _line(0.0), Context(planned=True), severity="warn"),)

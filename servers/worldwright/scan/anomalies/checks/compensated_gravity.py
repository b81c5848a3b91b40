"""A body's weight is cancelled, and the plan does not say so.

What it means: `gravcomp` holds up a boom, a figure or a vessel that nothing else carries. It is a force like any other.

Formula: the body's `gravcomp` is not 0; a share of 1 cancels its weight. Declared by an intervention of kind `force` or
`parameter` on the body, or on the one that it is welded to.
Threshold: none. Blocking with a plan; without one a warning.
Source: MuJoCo manual, body/gravcomp; the facts on staging (boom gravity cancelled).
"""

from collections.abc import Iterator
from dataclasses import replace

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..declared import weighs
from ..sign import Case, Context, Sign
from ..wholes import head_names

CODE = "WS301"
STAGING = True
NEEDS = ("meta",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each compensated body."""
    window, head = (trajectory.t[0], trajectory.t[-1]), head_names(trajectory)
    for body in trajectory.meta.get("bodies") or ():
        share = float(body.get("gravcomp") or 0.0)
        if share and body.get("mass", 1.0) > 0:
            name = str(body["name"])
            declared = any(context.acts_on(said, ("force", "parameter")) for said in (name, head.get(name, name)))
            message = f"{share:.0%} of the weight of {name} is cancelled by gravcomp"
            yield Sign(name, window, share, 0.0, "of its weight", weighs(context, declared), message)


def _boom(gravcomp: float) -> Trajectory:
    return replace(analytic.resting(), meta={"bodies": [{"name": "body", "mass": 1.0, "gravcomp": gravcomp}]})


GOOD = (lambda: Case("a body with its weight", _boom(0.0), Context(planned=True)),)
BAD = (lambda: Case("a boom without weight", _boom(1.0), Context(planned=True), severity="blocking"),)

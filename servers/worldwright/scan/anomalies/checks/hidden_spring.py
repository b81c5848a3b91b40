"""A loose body is held by springs or dampers of its own free or ball joint, or a joint is not as planned.

What it means: stiffness on a free joint pulls a body back to where it was, upright and in place, and damping brakes it in
empty air; nothing in the picture does that. A planned joint with other constants than the plan's is a number changed where
it does not belong.

Formula: `stiffness` or `damping` of a free or ball joint is not 0 and the joint is not among `topology.joints`; or a planned
hinge or slide differs from its row in stiffness, damping or frictionloss by more than 1 %. Declared by an intervention of kind
`force`, `torque` or `parameter` on the body.
Threshold: as said. Blocking for free and ball joints of a plan; else a warning.
Source: MuJoCo manual, joint/stiffness; the facts on staging (an invisible torque keeping a figure upright).
"""

from collections.abc import Iterator
from dataclasses import replace

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..declared import weighs
from ..sign import Case, Context, Sign

CODE = "WS316"
STAGING = True
NEEDS = ("meta",)
KINDS = ("force", "torque", "parameter")
UNITS = {"stiffness": "N/m, N·m/rad", "damping": "N·s/m, N·m·s/rad", "frictionloss": "N, N·m"}


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each hidden constant of a joint."""
    planned = {row.name: row for row in context.plan.topology.joints} if context.plan else {}
    window = (trajectory.t[0], trajectory.t[-1])
    for joint in trajectory.meta.get("joints") or ():
        name, body = str(joint["name"]), str(joint["body"])
        row = planned.get(name)
        if any(key not in joint for key in UNITS) or context.acts_on(body, KINDS):
            continue
        if row is None and joint["type"] in ("free", "ball"):
            for key in ("stiffness", "damping"):
                if joint[key]:
                    message = f"the {joint['type']} joint of {body} has a {key} of {joint[key]:.4g} that nothing shows"
                    yield Sign(body, window, joint[key], 0.0, UNITS[key], weighs(context, False), message)
        elif row is not None and row.type in ("hinge", "slide"):
            for key, unit in UNITS.items():
                wanted = float(getattr(row, key))
                if abs(joint[key] - wanted) > 0.01 * max(abs(wanted), 1e-9):
                    message = f"joint {name} has a {key} of {joint[key]:.4g}; the plan says {wanted:.4g}"
                    yield Sign(body, window, joint[key], wanted, unit, "warn", message)


def _loose(stiffness: float, damping: float = 0.0) -> Trajectory:
    joint = {"name": "body", "body": "body", "type": "free", "stiffness": stiffness, "damping": damping}
    return replace(analytic.resting(), meta={"joints": [{**joint, "frictionloss": 0.0}]})


GOOD = (lambda: Case("a loose body", _loose(0.0), Context(planned=True)),)
BAD = (
    lambda: Case("held upright by its own joint", _loose(300.0), Context(planned=True), severity="blocking"),
    lambda: Case("braked by nothing", _loose(0.0, 2.0), Context(planned=True), severity="blocking"),
)

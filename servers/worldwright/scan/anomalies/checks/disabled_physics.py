"""A part of the physics is switched off, and the plan does not say so.

What it means: with contacts, constraints, limits, gravity or actuation disabled in the model's options, what the picture
shows (a support, a stop, a weight) is not what the engine computes.

Formula: the recorded `disableflags`, of those that remove forces. Gravity may be disabled when the plan's gravity is 0.
Declared by an intervention of kind `parameter` whose bodies name `world` or the flag.
Threshold: none. Blocking with a plan; without one a warning.
Source: MuJoCo manual, option/flag; the facts on staging (contact disabled and replaced by a hand-written spring).
"""

from collections.abc import Iterator
from dataclasses import replace

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..declared import weighs
from ..sign import Case, Context, Sign

CODE = "WS302"
STAGING = True
NEEDS = ("meta",)
FORCES = (
    "constraint", "equality", "frictionloss", "limit", "contact", "spring", "damper", "gravity", "actuation",
)  # fmt: skip


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each disabled part."""
    disabled = (trajectory.meta.get("flags") or {}).get("disabled") or ()
    window = (trajectory.t[0], trajectory.t[-1])
    for flag in FORCES:
        if flag not in disabled:
            continue
        plan = context.plan
        if flag == "gravity" and plan is not None and not any(plan.simulation_parameters.gravity_vector):
            continue
        declared = context.declares("parameter", "world") or context.declares("parameter", flag)
        message = f"{flag} is switched off in the model's options"
        yield Sign("world", window, 1.0, 0.0, "flags", weighs(context, declared), message)


def _with(*flags: str) -> Trajectory:
    return replace(analytic.resting(), meta={"flags": {"disabled": list(flags)}})


GOOD = (lambda: Case("nothing that matters is off", _with("warmstart", "autoreset"), Context(planned=True)),)
BAD = (lambda: Case("no contacts", _with("contact"), Context(planned=True), severity="blocking"),)

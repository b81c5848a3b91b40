"""The time step cannot resolve the motion, or does not fit the duration.

What it does: compares `time_step` with the duration, the frame interval and what contacts need.

Why is this bad: MuJoCo's contacts have a time constant of 0.02 s by default, and need several steps of it: above 0.01 s
they explode or turn soft. A duration that is no multiple of the step has no last state; a step longer than a frame
shows still pictures.

Use instead: 0.001 to 0.005 s; fast small objects need less. Choose a duration that the step divides.
"""

from collections.abc import Iterator
from typing import Any

from ...case import Changes
from ...harm import Measured
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP102"
SEVERITY = "error"
GOOD: Changes = ({}, {"simulation_parameters": {"time_step": 0.001, "simulation_duration": 0.7}})
BAD: Changes = (
    {"simulation_parameters": {"time_step": 0.05}},
    {"simulation_parameters": {"time_step": 0.004, "simulation_duration": 3.001}},
    {"simulation_parameters": {"time_step": 0.008}, "recording_mode": {"fps": 240}},
    {"simulation_parameters": {"time_step": 0.002, "simulation_duration": 0.001}},
    {"simulation_parameters": {"time_step": 1e-6, "simulation_duration": 60.0}},
)
SHORT: dict[str, object] = {"simulation_parameters": {"time_step": 0.002}}


def _deepest_m(change: dict[str, Any]) -> float:
    """How deep a dropped box sinks into the floor at the case's time step, m."""
    import mujoco

    step = change["simulation_parameters"]["time_step"]
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco><option timestep='{step}'/><worldbody><geom type='plane' size='5 5 .1'/><body pos='0 0 .5'>"
        "<freejoint/><geom type='box' size='.05 .05 .05'/></body></worldbody></mujoco>"
    )
    data, deepest = mujoco.MjData(model), 0.0
    for _ in range(int(2 / step)):
        mujoco.mj_step(model, data)
        deepest = max([deepest, *(-data.contact.dist)]) if data.ncon else deepest
    return float(deepest)


EVIDENCE = Measured("a dropped box sinks deep into the floor", _deepest_m, 0.003, "m", good=SHORT)
CONTACT_LIMIT_S = 0.01
"""Half of the default contact time constant (manual: `o_solref`, 0.02 s)."""
MAX_STEPS = 2_000_000


def check(view: PlanView) -> Iterator[Problem]:
    """Check the step against contacts, frames and duration; only numbers are judged."""
    parameters = view.plan.simulation_parameters
    step, duration = parameters.time_step, parameters.simulation_duration
    place = ("simulation_parameters", "time_step")
    if isinstance(step, str):
        return
    if step > CONTACT_LIMIT_S:
        yield view.at(
            place, f"{step:g} s is too long for contacts (limit {CONTACT_LIMIT_S:g} s)", "use 0.001 to 0.005 s"
        )
    frame = 1 / view.plan.recording_mode.fps
    if view.plan.recording_mode.mode != "none" and step > frame:
        yield view.at(
            place, f"a step of {step:g} s is longer than a frame ({frame:.4g} s)", "shorten the step or lower the fps"
        )
    if isinstance(duration, str):
        return
    if duration < step:
        yield view.at(
            ("simulation_parameters", "simulation_duration"), "the duration is shorter than one step", "lengthen it"
        )
        return
    steps = duration / step
    if abs(steps - round(steps)) > 1e-6 * max(1.0, steps):
        whole = round(steps) * step
        message = f"the duration of {duration:g} s is no multiple of the step of {step:g} s"
        yield view.at(("simulation_parameters", "simulation_duration"), message, f"use {whole:.6g} s")
    if steps > MAX_STEPS:
        message = f"{steps:.3g} steps would take very long and record gigabytes"
        yield view.at(place, message, "lengthen the step or shorten the duration", severity="warning")

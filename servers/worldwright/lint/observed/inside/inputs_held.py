"""Watch the inputs that a program gives the engine, and how long they stay: clipped or frozen controls, forces left on."""

import re
from typing import Any

import mujoco
import numpy as np
from owners import READ, DataState, raw
from said import SAID
from tracked import note_of, plain

STATE = {"qpos", "qvel", "sensordata", "xpos", "site_xpos", "geom_xpos", "xquat", "cvel", "actuator_velocity"}
SPEED = {"qvel", "actuator_velocity", "cvel", "mj_objectVelocity", "subtree_linvel"}
FORCES = ("xfrc_applied", "qfrc_applied")
HELD = 150
"""Nobody holds a feedback on purpose over so many steps."""


class Inputs:
    """The inputs of one state."""

    def __init__(self) -> None:
        self.controls: dict[int, int] = {}
        """The line that last wrote each control."""
        self.steps: dict[int, list[int]] = {}
        """For each line: the number of steps in which its controls acted, and in which all of them were clipped."""
        self.feedback: dict[int, dict[str, Any]] = {}
        self.forces: dict[tuple[str, int], dict[str, Any]] = {}


def _inputs(owner: DataState) -> Inputs:
    if owner.inputs is None:
        owner.inputs = Inputs()
    return owner.inputs  # type: ignore[no-any-return]


def beyond(owner: DataState) -> Any:
    """(nu,) bool: whether each control lies beyond the range to which the engine clips it; None where it clips nothing."""
    model = owner.model.of
    if model.nu != raw(model, "actuator_ctrlrange").shape[0]:
        return None
    if int(model.opt.disableflags) & int(mujoco.mjtDisableBit.mjDSBL_CLAMPCTRL):
        return None
    low, high = np.asarray(raw(model, "actuator_ctrlrange")).T
    control, limited = raw(owner.of, "ctrl"), np.asarray(raw(model, "actuator_ctrllimited")).astype(bool)
    slack = 1e-6 + 1e-3 * (high - low)
    return limited & ((control < low - slack) | (control > high + slack))


def wrote(
    owner: DataState, field: str, places: Any, value: Any, labels: frozenset[str], line: int, added: bool
) -> None:
    """Look at a write to an input."""
    if field == "ctrl":
        _control(owner, places, value, labels, line)
    elif field in FORCES:
        _force(owner, field, places, value, line, added)


def _control(owner: DataState, places: Any, value: Any, labels: frozenset[str], line: int) -> None:
    inputs = _inputs(owner)
    flat = [int(p) for p in np.ravel(places)]
    inputs.controls.update(dict.fromkeys(flat, line))
    note = note_of(value)
    if note is None or note.field is not None:
        inputs.feedback.pop(line, None)
        return
    model = owner.model.of
    if model.nu == raw(model, "actuator_ctrlrange").shape[0]:
        low, high = np.asarray(raw(model, "actuator_ctrlrange"))[flat].T
        limited = np.asarray(raw(model, "actuator_ctrllimited"))[flat].astype(bool)
        given = np.ravel(np.asarray(plain(value), float))
        if given.size in (1, len(flat)) and (limited & ((given < low - 1e-6) | (given > high + 1e-6))).any():
            note.clipped = True
    motors = (np.asarray(raw(model, "actuator_biastype")) == 0) & (np.asarray(raw(model, "actuator_dyntype")) == 0)
    if (
        labels & {"qvel", "sensordata", "qpos"}
        and labels <= STATE | _CONSTANT
        and len(motors) == model.nu
        and motors[flat].all()
    ):
        kept = inputs.feedback.setdefault(line, {"ages": {}, "places": flat})
        kept["now"] = note.epoch
        if note.epoch not in kept["ages"]:
            kept["q"], kept["ages"][note.epoch] = raw(owner.of, "qpos").copy(), 0


_CONSTANT = {"body_mass", "body_subtreemass", "qpos0", "actuator_gear", "timestep", "key_qpos", "body_inertia"}


def _force(owner: DataState, field: str, places: Any, value: Any, line: int, added: bool) -> None:
    inputs = _inputs(owner)
    flat = np.ravel(places)
    old = inputs.forces.get((field, line))
    mine = raw(owner.of, field).ravel()[flat]
    piled = added and field not in owner.since_step | owner.blind and bool(mine.any()) and owner.epoch > 0
    again = old is not None and owner.epoch - old["at"] <= 1
    here: dict[str, Any] = old if old is not None else {"piled": 0, "times": 0}
    here.update(at=owner.epoch, places=flat, times=here["times"] + 1 if again else 1, value=None)
    here["piled"] += piled
    inputs.forces[(field, line)] = here
    if here["piled"] >= 3:
        SAID.event("force_piles_up", line, name=field)


def before_step(state: DataState, steps: int) -> None:
    """Count the step for every input that acts in it."""
    inputs = state.inputs
    if inputs is None:
        return
    if inputs.controls:
        out = beyond(state)
        if (out is not None and out.any()) or inputs.steps:
            for place, line in inputs.controls.items():
                seen = inputs.steps.setdefault(line, [0, 0])
                seen[0] += steps
                seen[1] += steps * bool(out is not None and out[place])
        elif out is not None:
            for line in set(inputs.controls.values()):
                inputs.steps.setdefault(line, [0, 0])[0] += steps
        for line, kept in inputs.feedback.items():
            age = state.epoch + steps - kept["now"]
            if (
                "ctrl" not in state.blind
                and kept["ages"].get(kept["now"], HELD) < age
                and all(inputs.controls[p] == line for p in kept["places"])
            ) and (age < HELD or np.abs(raw(state.of, "qpos") - kept["q"]).max(initial=0.0) > 0.05):
                kept["ages"][kept["now"]] = age
    for (field, line), kept in inputs.forces.items():
        now = raw(state.of, field).ravel()[kept["places"]]
        if kept["at"] == state.epoch:
            kept["value"] = now.copy()
        elif field in state.blind:
            kept["times"] = 0
        elif kept["times"] == 1 and kept["at"] > 0 and state.epoch - kept["at"] >= 100 and now.any():
            if kept["value"] is not None and np.array_equal(now, kept["value"]) and _brief(line):
                SAID.event("force_stays", line, name=field)
        elif kept["times"] >= 2 and state.epoch - kept["at"] >= 20 and now.any():
            same = kept["value"] is not None and np.array_equal(now, kept["value"])
            if same:
                SAID.event("force_stays", line, name=field)


BRIEF = re.compile(r"kick|impuls|push|shove|gust|poke|bump|perturb|disturb|jolt|knock|nudge|punch", re.IGNORECASE)


def _brief(line: int) -> bool:
    """Whether a line writes at one moment only what the program calls a push."""
    import ast

    import called_names

    test = called_names.innermost(line, ast.If)
    once = test is not None and any(isinstance(n, ast.Eq) for n in ast.walk(test.test))
    return once and bool(BRIEF.search(called_names.around(line)))


def noise() -> None:
    """Report a model that gives a sensor noise, which the engine never adds."""
    import made_worlds
    from owners import OWNERS, ModelState

    if "sensordata" not in READ or "sensor_noise" in READ or made_worlds.says(r"normal\(|randn|noise\w*\s*\("):
        return
    for state in OWNERS.values():
        if isinstance(state, ModelState) and np.asarray(raw(state.of, "sensor_noise")).any():
            SAID.event("noise_not_added", made_worlds.line_with(r"noise\s*=", state.made_line))


def left_over(state: DataState, field: str) -> None:
    """Report a start with a force still on, on the line that switched it on."""
    for (name, line), kept in (state.inputs.forces if state.inputs is not None else {}).items():
        if name == field and raw(state.of, field).ravel()[kept["places"]].any():
            SAID.event("force_stays", line, name=field)


def reckoned(notes: list[Any]) -> None:
    """Report a clipped control that is multiplied with a velocity, as if all of it had acted."""
    believed = any(n.clipped for n in notes) and not READ & {"actuator_force", "qfrc_actuator"}
    if believed and any(n.labels & SPEED and not n.clipped for n in notes):
        SAID.event("clipped_reckoned")


def at_end(states: list[Any]) -> None:
    """Report what is only known at the end of the run."""
    clipped: dict[int, bool] = {}
    for state in states:
        if not isinstance(state, DataState) or state.inputs is None:
            continue
        for line, (steps, out) in state.inputs.steps.items():
            if steps >= 20:
                clipped[line] = clipped.get(line, False) or out >= 0.95 * steps
        for line, kept in state.inputs.feedback.items():
            if kept["ages"] and min(kept["ages"].values()) >= HELD:
                SAID.event("feedback_frozen", line, steps=max(kept["ages"].values()))
    if READ & {"actuator_force", "qfrc_actuator", "actuator_ctrlrange", "ctrlrange"}:
        return
    for line, always in clipped.items():
        if always:
            SAID.event("always_clipped", line)

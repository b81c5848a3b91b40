"""An actuator acts otherwise than the plan's, or is not the plan's at all.

What it does: compares every actuator with the one of that name in the world of the plan's draft: what it moves, its gain and
bias, gear, limits, dynamics, delay and damping. Finds actuators that neither `topology.actuators` nor an intervention names.

Why is this bad: with a gear of ten the same control pulls ten times as hard; an actuator with a bias acts without any control.

Use instead: `worldkit.actuators` with the numbers of the plan.
"""

from collections.abc import Iterator

import numpy as np

from ....compiled.view import ModelView
from ....harm import Measured, after
from ....problem import Problem
from ._twins import SOUND, changed, compared, missing, names, twins, unplanned

CODE = "WM165"
SEVERITY = "error"
SCOPE = "acts"
BIAS = "spec.actuator('push').biastype, spec.actuator('push').biasprm[0] = mujoco.mjtBias.mjBIAS_AFFINE, 20"
GOOD = SOUND
BAD = (
    changed(BIAS),
    changed("spec.actuator('push').gear[0] = 10"),
    changed("spec.actuator('push').forcelimited = True", "spec.actuator('push').forcerange = (-1, 1)"),
    changed("spec.add_actuator(name='hidden', target='pivot', trntype=mujoco.mjtTrn.mjTRN_JOINT)"),
    changed("spec.add_actuator(name='suction', target='crate', trntype=mujoco.mjtTrn.mjTRN_BODY, ctrlrange=(0, 1))"),
)
EVIDENCE = Measured(
    "the arm turns with no control at all",
    lambda s: float(after(s, 0.2)[1].joint("pivot").qpos[0]),
    0.1,
    "rad",
    bad=changed(BIAS)[0],
    good=changed()[0],
)
KINDS = (
    ("actuator_trntype", "kind of transmission"),
    ("actuator_dyntype", "kind of dynamics"),
    ("actuator_gaintype", "kind of gain"),
    ("actuator_biastype", "kind of bias"),
)
NUMBERS = (
    ("actuator_gainprm", "gain"),
    ("actuator_biasprm", "bias"),
    ("actuator_dynprm", "dynamics"),
    ("actuator_gear", "gear"),
    ("actuator_cranklength", "crank"),
    ("actuator_delay", "delay"),
    ("actuator_damping", "damping"),
    ("actuator_dampingpoly", "further damping"),
    ("actuator_armature", "armature"),
)
LIMITS = (
    ("actuator_forcelimited", "actuator_forcerange", "range of forces"),
    ("actuator_ctrllimited", "actuator_ctrlrange", "range of controls"),
    ("actuator_actlimited", "actuator_actrange", "range of activations"),
)
TARGETS = ("joint", "joint", None, "tendon", "site", "body")


def check(view: ModelView) -> Iterator[Problem]:
    """Check actuators of both worlds, then those of one."""
    assert view.planned is not None
    for index, twin in twins(view, "actuator"):
        yield from compared(view, "actuator", KINDS, index, twin)
        if _target(view, index) != _target(view.planned, twin):
            message = f"actuator {names(view, 'actuator')[index]} moves {_target(view, index)}, by the plan {_target(view.planned, twin)}"
            yield view.at("actuator", index, message, "give it the plan's target")
        yield from compared(view, "actuator", NUMBERS, index, twin)
        for on, field, word in LIMITS:
            yield from compared(view, "actuator", ((on, word),), index, twin)
            if getattr(view, on)[index]:
                yield from compared(view, "actuator", ((field, word),), index, twin)
    for index in unplanned(view, "actuator", "control"):
        message = f"{view.name('actuator', index)} is an actuator that the plan does not have"
        yield view.at(
            "actuator", index, message, "add it to topology.actuators, name it in an intervention, or leave it out"
        )
    for name in missing(view, "actuator"):
        yield view.of_world(f"the plan's actuator {name} is not there", "build it under that name", name)


def _target(view: ModelView, index: int) -> str:
    """Name of what it moves."""
    kind = int(view.actuator_trntype[index])
    word = TARGETS[kind] if kind < len(TARGETS) else None
    target = int(np.ravel(view.actuator_trnid[index])[0])
    return names(view, word)[target] if word and 0 <= target < len(names(view, word)) else f"number {target}"

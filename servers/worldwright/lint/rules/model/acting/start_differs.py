"""The world starts in another state than the plan's.

What it does: compares the state at the start (keyframe "start", else the built pose) with that of the plan's draft, joint by
joint: positions, turns and speeds; and activations and controls that a keyframe sets.

Why is this bad: what is turned by a few degrees, or spins already, comes out as wished without any cause.

Use instead: `worldkit.motion.launch` with the plan's `initial_motion`; poses from the plan's rows.
"""

from collections.abc import Iterator

import numpy as np

from worldkit.turning import angles_between

from ....compiled.view import ModelView
from ....harm import Measured, after
from ....problem import Problem
from ._twins import SOUND, changed, names, shown, twins

CODE = "WM168"
SEVERITY = "error"
SCOPE = "acts"
LAUNCHED = "motion.Launch(linear=(0.5, 0, 0))"


def started(more: str) -> tuple[str, dict[str, object]]:
    """A case with another start."""
    text, plan = changed()
    return text.replace(LAUNCHED, f"{LAUNCHED}, 'pivot': motion.Launch({more})"), plan


SPIN = started("velocity=3.0")
GOOD = SOUND
BAD = (
    SPIN,
    changed("spec.key('start').qpos[3], spec.key('start').qpos[5] = 0.99, 0.14"),
    changed("spec.key('start').ctrl = [4.0]"),
    changed("spec.key('start').time = 0.6"),
    started("position=0.3"),
)
EVIDENCE = Measured(
    "the arm turns from the start",
    lambda s: float(after(s, 0.1)[1].joint("pivot").qpos[0]),
    0.1,
    "rad",
    bad=SPIN[0],
    good=changed()[0],
)
NEAR_M, NEAR_RAD, SPEED, SHARE = 2e-3, 0.01, 2e-3, 0.005
POSITIONS = {"free": 7, "ball": 4, "slide": 1, "hinge": 1}
SPEEDS = {"free": 6, "ball": 3, "slide": 1, "hinge": 1}
FIX = "start it as the plan says: poses in its rows, speeds in initial_motion"


def check(view: ModelView) -> Iterator[Problem]:
    """Check joints of both worlds, then what the keyframe sets besides."""
    planned = view.planned
    assert planned is not None
    for index, twin in twins(view, "joint"):
        kind = view.joint_kind[index]
        if kind != planned.joint_kind[twin]:
            continue
        here, there = (_state(world, joint, kind) for world, joint in ((view, index), (planned, twin)))
        name = names(view, "joint")[index]
        if said := _describe_distance(kind, here[0], there[0]):
            yield view.at("joint", index, f"{name} starts {said}", FIX)
        # A keyframe of the plan's own is in the same frames, so the numbers compare as they are.
        if np.linalg.norm(here[1] - there[1]) > max(SPEED, SHARE * float(np.linalg.norm(there[1]))):
            yield view.at(
                "joint", index, f"{name} starts at a speed of {shown(here[1])}, by the plan {shown(there[1])}", FIX
            )
    if (late := _keyframe_row(view, "key_time")).any():
        yield view.of_world(f"the clock starts at {shown(late)} s", "leave the time of the keyframe at 0", "start")
    for field, word in (("key_ctrl", "control"), ("key_act", "activation")):
        values, wanted = _keyframe_row(view, field), _keyframe_row(planned, field)
        if values.any() and (values.shape != wanted.shape or not np.allclose(values, wanted)):
            yield view.of_world(
                f"the start sets a {word} of {shown(values)}", "let control() set it", "start", "launch"
            )


def _state(view: ModelView, joint: int, kind: str) -> tuple[np.ndarray, np.ndarray]:
    first, dof = int(view.jnt_qposadr[joint]), int(view.jnt_dofadr[joint])
    return view.qpos[first : first + POSITIONS[kind]], view.qvel[dof : dof + SPEEDS[kind]]


def _describe_distance(kind: str, here: np.ndarray, there: np.ndarray) -> str:
    """Say how far two positions of a joint are apart; empty when they are not."""
    if kind in ("free", "ball"):
        turn = float(angles_between(here[-4:], there[-4:]))
        if turn > NEAR_RAD:
            return f"turned by {np.degrees(turn):.3g} degrees from how the plan places it"
        away = float(np.linalg.norm(here[:3] - there[:3])) if kind == "free" else 0.0
        return f"{away * 1e3:.3g} mm from where the plan places it" if away > NEAR_M else ""
    most = NEAR_RAD if kind == "hinge" else NEAR_M
    return f"at {shown(here)}, by the plan at {shown(there)}" if abs(float(here[0] - there[0])) > most else ""


def _keyframe_row(view: ModelView, field: str) -> np.ndarray:
    keys = view.texts["names"]["key"]
    return np.ravel(getattr(view, field)[keys.index("start")]) if "start" in keys else np.zeros(0)

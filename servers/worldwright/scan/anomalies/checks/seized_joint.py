"""A joint that nothing drives does not move, though its load would turn it: it has seized.

What it means: a damping, a dry friction or an armature left in from a test, or with a wrong unit, holds the joint as if it
were welded.

Formula: for a hinge or slide without actuator, equality, spring or limit in reach: the rate that its load alone would
give it in a tenth of a second, |bias force| / inertia x 0.1 s, against the largest rate that is recorded. The bias force
(gravity, centrifugal) and the inertia are the model's at 24 rows.
Threshold: a hundredth, where the load would give more than 0.2 rad/s (or 0.2 m/s), and its damping or dry friction is the
cause: more than the load itself at a thousandth of that rate. A warning.
Source: Featherstone, Rigid Body Dynamics Algorithms (recursive Newton-Euler, composite rigid body).
"""

from collections.abc import Iterator
from functools import cache

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import modelled
from ...predicting.joint_coordinates import HINGE, SLIDE, fitted
from ...predicting.shown import Shown
from ..sign import Case, Context, Sign

CODE = "WS141"
NEEDS = ("model",)
ROWS, SHORT_S, RATE, SHARE = 24, 0.1, 0.2, 0.01


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies on seized joints."""
    model = trajectory.model
    candidates = [j for j in range(model.njnt) if model.jnt_type[j] in (HINGE, SLIDE) and _passive(model, j)]
    if not candidates:
        return
    found = fitted(trajectory)
    rates = np.abs(found.qvel).max(axis=0)
    still = [j for j in candidates if rates[model.jnt_dofadr[j]] < RATE * SHARE * 10]
    if not still:
        return
    wished = _wished(trajectory, still)
    for j, rate in zip(still, wished, strict=True):
        dof, body = model.jnt_dofadr[j], int(found.columns[model.jnt_bodyid[j]])
        if body < 0 or rate < RATE or rates[dof] > SHARE * rate:
            continue
        name = trajectory.names[body]
        damping, friction = float(np.ravel(model.dof_damping[dof])[0]), float(model.dof_frictionloss[dof])
        message = (
            f"the joint of {name} never moves, though its load would turn it by {rate:.3g} a second within a tenth; "
            f"its damping is {damping:g}, its dry friction {friction:g}"
        )
        yield Sign(name, (trajectory.t[0], trajectory.t[-1]), float(rates[dof]), SHARE * rate, "1/s", "warn", message)


def _passive(model: "modelled.Any", j: int) -> bool:
    import mujoco

    dof = model.jnt_dofadr[j]
    if np.ravel(model.dof_damping[dof])[0] <= 0 and model.dof_frictionloss[dof] <= 0 and model.dof_armature[dof] <= 0:
        return False
    if np.ravel(model.jnt_stiffness[j])[0] > 0 or model.ntendon:
        return False
    if any(int(model.actuator_trnid[a, 0]) == j for a in range(model.nu)):
        return False
    tied = {int(b) for e in range(model.neq) for b in (model.eq_obj1id[e], model.eq_obj2id[e])}
    return not ({j, int(model.jnt_bodyid[j])} & tied) and mujoco.mjtJoint(model.jnt_type[j]).value in (SLIDE, HINGE)


def _wished(trajectory: Trajectory, joints: list[int]) -> np.ndarray:
    """(J,) rad/s or m/s: the largest rate that its load alone would give each joint in a tenth of a second."""
    import mujoco

    shown = Shown(trajectory)
    model, data = shown.model, shown.data
    most = np.zeros(len(joints))
    mass = np.zeros((model.nv, model.nv))
    for row in np.unique(np.linspace(0, len(trajectory.t) - 1, ROWS).astype(int)):
        shown.show(int(row))
        if data.ncon:
            continue
        data.qvel[:] = 0
        mujoco.mj_forward(model, data)
        mujoco.mj_fullM(model, data, mass)
        for k, j in enumerate(joints):
            dof = model.jnt_dofadr[j]
            at = model.jnt_qposadr[j]
            if model.jnt_limited[j]:
                low, high = model.jnt_range[j]
                if min(data.qpos[at] - low, high - data.qpos[at]) < 0.05 * (high - low):
                    continue
            inertia = mass[dof, dof] - float(model.dof_armature[dof])
            load = abs(float(data.qfrc_bias[dof]))
            # Dry friction about as large as the load is a brake that somebody chose; many times as large, it is a mistake.
            if load > 0 and 0.3 * load < model.dof_frictionloss[dof] < 10 * load:
                continue
            most[k] = max(most[k], load / max(inertia, 1e-12) * SHORT_S)
    return most


@cache
def _arm(damping: float) -> Trajectory:
    arm = (
        '<body name="boom" pos="0 0 3"><joint axis="0 1 0" damping="0.1"/>'
        '<geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.03" mass="1"/>'
        f'<body name="dipper" pos="0.5 0 0"><joint axis="0 1 0" damping="{damping}"/>'
        '<geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.03" mass="1"/></body></body>'
    )
    return modelled.run(modelled.scene(arm), 1.0)


GOOD = (lambda: Case("an arm that swings", _arm(0.1)),)
BAD = (lambda: Case("an elbow that has seized", _arm(50000.0), severity="warn"),)

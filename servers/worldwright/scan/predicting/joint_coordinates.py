"""Joint coordinates and velocities of a model from the recorded poses and velocities of its bodies.

Each body is seen from its recorded parent, so a mistake in one body does not spread: what its joints cannot explain is a
gap of that body alone. Source: Featherstone, Rigid Body Dynamics Algorithms, chapter 4 (joint models, relative motion).
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from worldkit.turning import about, angles_between, conjugate, matrices, product, rotation_vectors

from ...model.recording.trajectory import Trajectory

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray
FREE, BALL, SLIDE, HINGE = range(4)
_KEY = "_fitted"
ROUNDS = 8
"""Gauss-Newton rounds for a body with several joints that turn."""


@dataclass(frozen=True)
class Fit:
    """A recording in the coordinates of its model."""

    qpos: Array
    """(T, nq) positions, m and rad."""
    qvel: Array
    """(T, nv) velocities, m/s and rad/s."""
    gap_m: Array
    """(T, B) m: how far each body is from where its joints can put it on its parent."""
    gap_rad: Array
    """(T, B) rad: how far each body is turned against that."""
    slip: Array
    """(T, B) m/s: the part of a body's velocity against its parent that its joints do not allow."""
    known: Array
    """(nbody,) bool: the body and all above it are recorded, so that its state is known."""
    columns: Array
    """(nbody,) column of each body of the model in the recording; -1 where it has none."""


def fitted(trajectory: Trajectory) -> Fit:
    """The coordinates of every row in the model beside the recording; computed once."""
    known: Fit | None = trajectory.__dict__.get(_KEY)
    if known is None:
        known = trajectory.__dict__[_KEY] = fit(trajectory, trajectory.model)
    return known


def fit(trajectory: Trajectory, model: "mujoco.MjModel") -> Fit:
    """The coordinates of every row; a body that was not recorded keeps its reference pose and is not `known`."""
    import mujoco

    rows = len(trajectory.t)
    names = {name: k for k, name in enumerate(trajectory.names)}
    called = [mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_BODY, b) or f"body_{b}" for b in range(model.nbody)]
    columns = np.array([-1] + [names.get(name, -1) for name in called[1:]])
    qpos = np.tile(model.qpos0, (rows, 1))
    qvel = np.zeros((rows, model.nv))
    count = len(trajectory.names)
    gap_m, gap_rad, slip = np.zeros((rows, count)), np.zeros((rows, count)), np.zeros((rows, count))
    pos = np.zeros((rows, model.nbody, 3))
    quat = np.tile((1.0, 0.0, 0.0, 0.0), (rows, model.nbody, 1))
    lin, ang = np.zeros_like(pos), np.zeros_like(pos)
    known = np.ones(model.nbody, dtype=bool)
    for b in range(1, model.nbody):
        column, parent = int(columns[b]), int(model.body_parentid[b])
        known[b] = known[parent] and (column >= 0 or model.body_jntnum[b] == 0)
        if column < 0:
            pos[:, b] = pos[:, parent] + np.einsum("tij,j->ti", matrices(quat[:, parent]), model.body_pos[b])
            quat[:, b] = product(quat[:, parent], model.body_quat[b])
            lin[:, b], ang[:, b] = lin[:, parent], ang[:, parent]
            continue
        own = trajectory.quat[:, column]
        pos[:, b] = trajectory.pos[:, column]
        quat[:, b] = own / np.maximum(np.sqrt((own**2).sum(axis=1)), 1e-9)[:, None]
        lin[:, b], ang[:, b] = trajectory.linvel[:, column], trajectory.angvel[:, column]
        if model.body_mocapid[b] >= 0:
            continue
        joints = (
            range(model.body_jntadr[b], model.body_jntadr[b] + model.body_jntnum[b]) if model.body_jntnum[b] else ()
        )
        if any(model.jnt_type[j] == FREE for j in joints):
            j = model.body_jntadr[b]
            at, dof = model.jnt_qposadr[j], model.jnt_dofadr[j]
            qpos[:, at : at + 3], qpos[:, at + 3 : at + 7] = pos[:, b], quat[:, b]
            qvel[:, dof : dof + 3] = lin[:, b]
            qvel[:, dof + 3 : dof + 6] = np.einsum("tji,tj->ti", matrices(quat[:, b]), ang[:, b])
            continue
        above = matrices(quat[:, parent])
        arm = pos[:, b] - pos[:, parent]
        place = np.einsum("tji,tj->ti", above, arm)
        turn = product(conjugate(quat[:, parent]), quat[:, b])
        _solve(model, b, list(joints), place, turn, qpos)
        made_pos, made_quat, columns6 = _chain(model, b, list(joints), qpos)
        gap_m[:, column] = np.sqrt(((place - made_pos) ** 2).sum(axis=1))
        gap_rad[:, column] = angles_between(made_quat, turn)
        relative = np.concatenate(
            (
                np.einsum("tji,tj->ti", above, ang[:, b] - ang[:, parent]),
                np.einsum("tji,tj->ti", above, lin[:, b] - lin[:, parent] - np.cross(ang[:, parent], arm)),
            ),
            axis=1,
        )
        if columns6 is not None:
            rates = np.einsum("tij,tj->ti", np.linalg.pinv(columns6), relative)
            dof = model.body_dofadr[b]
            qvel[:, dof : dof + rates.shape[1]] = rates
            relative = relative - np.einsum("tij,tj->ti", columns6, rates)
        if model.body_mocapid[parent] < 0:  # a mocap body's velocity is recorded as zero, wherever it goes
            slip[:, column] = np.sqrt((relative[:, 3:] ** 2).sum(axis=1))
    return Fit(qpos, qvel, gap_m, gap_rad, slip, known, columns)


def _chain(model: "mujoco.MjModel", b: int, joints: list[int], qpos: Array) -> tuple[Array, Array, Array | None]:
    """Pose of a body in its parent's frame, and (T, 6, k) what each rate gives: angular, then linear velocity there."""
    rows = len(qpos)
    pos = np.tile(model.body_pos[b], (rows, 1))
    quat = np.tile(model.body_quat[b], (rows, 1))
    axes: list[tuple[int, Array, Array]] = []
    for j in joints:
        frame = matrices(quat)
        anchor = pos + np.einsum("tij,j->ti", frame, model.jnt_pos[j])
        axis = np.einsum("tij,j->ti", frame, model.jnt_axis[j])
        at, kind = model.jnt_qposadr[j], model.jnt_type[j]
        if kind == SLIDE:
            pos = pos + axis * (qpos[:, at] - model.qpos0[at])[:, None]
            axes.append((SLIDE, axis, anchor))
            continue
        own = qpos[:, at : at + 4] if kind == BALL else about(model.jnt_axis[j], qpos[:, at] - model.qpos0[at])
        quat = product(quat, own)
        turned = matrices(quat)
        pos = anchor - np.einsum("tij,j->ti", turned, model.jnt_pos[j])
        if kind == BALL:
            axes += [(HINGE, turned[:, :, k], anchor) for k in range(3)]
        else:
            axes.append((HINGE, axis, anchor))
    if not axes:
        return pos, quat, None
    columns = np.zeros((rows, 6, len(axes)))
    for k, (kind, axis, anchor) in enumerate(axes):
        if kind == SLIDE:
            columns[:, 3:, k] = axis
        else:
            columns[:, :3, k], columns[:, 3:, k] = axis, np.cross(axis, pos - anchor)
    return pos, quat, columns


def _solve(model: "mujoco.MjModel", b: int, joints: list[int], place: Array, turn: Array, qpos: Array) -> None:
    """Fill in the coordinates of one body's joints from its pose in its parent's frame."""
    turning = [j for j in joints if model.jnt_type[j] in (HINGE, BALL)]
    if len(turning) == 1:
        j = turning[0]
        at = model.jnt_qposadr[j]
        own = product(conjugate(model.body_quat[b])[None], turn)
        if model.jnt_type[j] == BALL:
            qpos[:, at : at + 4] = own
        else:
            angle = 2 * np.arctan2(own[:, 1:] @ model.jnt_axis[j], own[:, 0])
            qpos[:, at] = _unwound(model, j, angle + model.qpos0[at])
    elif turning:
        _newton(model, b, joints, turn, qpos)
        for j in turning:
            if model.jnt_type[j] == HINGE:
                at = model.jnt_qposadr[j]
                qpos[:, at] = _unwound(model, j, qpos[:, at])
    slides = [j for j in joints if model.jnt_type[j] == SLIDE]
    if slides:
        made, _, columns = _chain(model, b, joints, qpos)
        assert columns is not None
        kinds = [
            k
            for j in joints
            for k in ([SLIDE] if model.jnt_type[j] == SLIDE else [HINGE] * (3 if model.jnt_type[j] == BALL else 1))
        ]
        own = columns[:, 3:, [k for k, kind in enumerate(kinds) if kind == SLIDE]]
        way = np.einsum("tij,tj->ti", np.linalg.pinv(own), place - made)
        for k, j in enumerate(slides):
            qpos[:, model.jnt_qposadr[j]] += way[:, k]


def _newton(model: "mujoco.MjModel", b: int, joints: list[int], turn: Array, qpos: Array) -> None:
    """Solve several turning joints by Gauss-Newton on the orientation; an unsettled row starts from its neighbours."""
    hinges = [j for j in joints if model.jnt_type[j] == HINGE]
    if len(hinges) != len([j for j in joints if model.jnt_type[j] != SLIDE]):
        return  # a ball beside a hinge is redundant, which its gap shows
    columns_of = [k for k, j in enumerate(joints) if model.jnt_type[j] == HINGE]
    at = [model.jnt_qposadr[j] for j in hinges]
    for attempt in range(3):
        for _ in range(ROUNDS):
            _, made, columns = _chain(model, b, joints, qpos)
            assert columns is not None
            off = np.einsum("tij,tj->ti", matrices(made), rotation_vectors(product(conjugate(made), turn)))
            lean = columns[:, :3][:, :, columns_of]
            inner = np.einsum("tij,tik->tjk", lean, lean) + 1e-9 * np.eye(len(at))
            step = np.linalg.solve(inner, np.einsum("tij,ti->tj", lean, off)[..., None])[..., 0]
            qpos[:, at] += np.clip(step, -0.7, 0.7)
        _, made, _ = _chain(model, b, joints, qpos)
        bad = angles_between(made, turn) > 1e-3
        if not bad.any() or bad.all() or attempt == 2:
            return
        good = np.flatnonzero(~bad)
        near = good[np.clip(np.searchsorted(good, np.flatnonzero(bad)), 0, len(good) - 1)]
        qpos[np.ix_(bad, at)] = qpos[np.ix_(near, at)]


def _unwound(model: "mujoco.MjModel", j: int, angle: Array) -> Array:
    """Angles (rad) without jumps of a whole turn, beginning within the joint's range if it has one."""
    found = np.unwrap(angle)
    if model.jnt_limited[j]:
        middle = model.jnt_range[j].mean()
        found = found + 2 * np.pi * np.round((middle - np.median(found)) / (2 * np.pi))
    return np.asarray(found)

"""Predict from each recorded row, by the model alone, the next one, and compare it with what was recorded there.

Between two rows lie a few steps of the engine. Set the row's state, take these steps, and compare: whatever acted besides
the model, and whatever was done to the recording, is left over. One row is too short for chaos, so the comparison holds
in contacts too. What an actuator moves is not judged, nor what it touches: its control was not recorded. An equality may
have been switched: whichever state of it explains the row better counts.
"""

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from worldkit.turning import angles_between

from ...model.recording.trajectory import Trajectory
from .joint_coordinates import Fit, fitted

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray
STEPS = 8000
"""A scan may spend so many engine steps; of a longer recording it takes rows spread over it and those that jump most."""
LEAST_ROWS = 200
_KEY = "_left_over"
LOOSE_ENOUGH = 1.0
"""A step that leaves less over, m/s^2, is explained: no other state of the equalities is tried for it."""


@dataclass(frozen=True)
class Left:
    """What is left over in N steps from row to row."""

    row: Array
    """(N,) the row that each step starts from, in order."""
    speed: Array
    """(N, B, 3) m/s: velocity of the body origins, recorded less predicted."""
    spin: Array
    """(N, B, 3) rad/s: angular velocity, recorded less predicted."""
    way: Array
    """(N, B) m: distance of the recorded place from the predicted one."""
    turn: Array
    """(N, B) rad: angle between the recorded and the predicted turn."""
    touching: Array
    """(N, B) bool: whether the model sees a contact on the way."""
    judged: Array
    """(N, B) bool: whether the body can be judged: no actuator, flex or unknown body took part."""


def left_over(trajectory: Trajectory) -> tuple[Fit, Left]:
    """The recording in its model's coordinates, and what the model leaves over; computed once."""
    known: tuple[Fit, Left] | None = trajectory.__dict__.get(_KEY)
    if known is None:
        found = fitted(trajectory)
        known = trajectory.__dict__[_KEY] = (found, predict(trajectory, found, chosen_rows(trajectory)))
    return known


def chosen_rows(trajectory: Trajectory) -> Array:
    """The rows to predict from: all if the budget allows, else evenly spread ones and those with the largest changes."""
    model, count = trajectory.model, len(trajectory.t) - 1
    if count < 1:
        return np.zeros(0, dtype=int)
    each = max(1, round(trajectory.interval_s / model.opt.timestep)) * (1 + model.nv / 30)
    most = max(LEAST_ROWS, int(STEPS / each))
    if count <= most:
        return np.arange(count)
    change = np.zeros(count)
    for b in range(len(trajectory.names)):
        step = np.diff(trajectory.linvel[:, b], axis=0)
        np.maximum(change, np.abs(step).max(axis=1) / trajectory.speed_scale[b], out=change)
    largest = np.argpartition(change, -most // 3)[-most // 3 :]
    return np.unique(np.concatenate((np.linspace(0, count - 1, most - most // 3).astype(int), largest)))


def predict(trajectory: Trajectory, found: Fit, rows: Array) -> Left:
    """Predict one row ahead of each of `rows`."""
    import mujoco

    model = trajectory.model
    awake = int(model.opt.enableflags)
    model.opt.enableflags = awake & ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)  # the recording does not tell what slept
    try:
        return _predict(trajectory, model, found, rows)
    finally:
        model.opt.enableflags = awake


def _predict(trajectory: Trajectory, model: "mujoco.MjModel", found: Fit, rows: Array) -> Left:
    bodies = np.flatnonzero(found.columns >= 0)
    columns = found.columns[bodies]
    ahead = _Ahead(trajectory, model, found, bodies, columns)
    left, touched = ahead.of(rows, None)
    judged, touching = _taking_part(model, found, bodies, touched)
    size = best = _size(left, trajectory.size_m[columns])
    state = np.zeros(size.shape, dtype=int)
    enough = LOOSE_ENOUGH * np.diff(trajectory.t)[rows, None]
    again = np.arange(len(rows))
    for which, active in enumerate(_switches(model), start=1):
        again = again[(judged[again] & (size > enough[again])).any(axis=1)]
        if not len(again):
            break
        other, _ = ahead.of(rows[again], active)
        size = _size(other, trajectory.size_m[columns])
        better = size < best[again]
        for kept, one in zip(left, other, strict=True):
            kept[again] = np.where(better.reshape(better.shape + (1,) * (one.ndim - 2)), one, kept[again])
        best[again] = np.minimum(size, best[again])
        state[again] = np.where(better, which, state[again])
    # Within the step that switches an equality, neither state of it holds.
    changed = np.diff(state, axis=0) != 0
    judged[1:] &= ~changed
    judged[:-1] &= ~changed
    return Left(rows, *(_by_name(part, columns, len(trajectory.names)) for part in (*left, touching, judged)))


def _by_name(part: Array, columns: Array, count: int) -> Array:
    """What was found of the model's bodies (N, b, …), in the columns of the recording (N, B, …)."""
    whole = np.zeros((len(part), count, *part.shape[2:]), dtype=part.dtype)
    whole[:, columns] = part
    return whole


def _size(left: tuple[Array, Array, Array, Array], size_m: Array) -> Array:
    """(N, b) m/s: how much is left over in velocity and spin together."""
    return np.asarray(np.sqrt((left[0] ** 2).sum(axis=2)) + np.sqrt((left[1] ** 2).sum(axis=2)) * size_m)


class _Ahead:
    """Takes a model from rows of its recording to the next ones."""

    def __init__(
        self, trajectory: Trajectory, model: "mujoco.MjModel", found: Fit, bodies: Array, columns: Array
    ) -> None:
        import mujoco

        self.trajectory, self.model, self.found, self.bodies, self.columns = trajectory, model, found, bodies, columns
        self._data = mujoco.MjData(model)
        posed = [int(b) for b in np.flatnonzero(model.body_mocapid >= 0) if found.columns[b] >= 0]
        self._mocaps = [(int(model.body_mocapid[b]), int(found.columns[b])) for b in posed]

    def of(
        self, rows: Array, active: Any
    ) -> tuple[tuple[Array, Array, Array, Array], list[frozenset[tuple[int, int]]]]:
        """What is left over of speed, spin (N, b, 3), way and turn (N, b), and by row the pairs of bodies that touched."""
        data, bodies, shape = self._data, self.bodies, (len(rows), len(self.bodies))
        roots = self.model.body_rootid[bodies]
        whirl, place = np.empty((*shape, 6)), np.empty((*shape, 3))
        facing, middle = np.empty((*shape, 4)), np.empty((*shape, 3))
        touched = []
        for k, n in enumerate(rows):
            touched.append(self._advance(int(n), active))
            whirl[k], place[k], facing[k], middle[k] = (
                data.cvel[bodies], data.xpos[bodies], data.xquat[bodies], data.subtree_com[roots]
            )  # fmt: skip
        then = np.ix_(rows + 1, self.columns)
        trajectory, spin = self.trajectory, whirl[..., :3]
        way = trajectory.pos[then] - place
        return (
            trajectory.linvel[then] - (whirl[..., 3:] + np.cross(spin, place - middle)),
            trajectory.angvel[then] - spin,
            np.sqrt((way**2).sum(axis=2)),
            angles_between(facing, trajectory.quat[then]),
        ), touched

    def _advance(self, n: int, active: Any) -> frozenset[tuple[int, int]]:
        """Take the steps from row n to the next; returns the pairs of bodies that touched on the way."""
        import mujoco

        trajectory, model, data = self.trajectory, self.model, self._data
        mujoco.mj_resetData(model, data)
        data.time = trajectory.t[n]
        data.qpos[:], data.qvel[:] = self.found.qpos[n], self.found.qvel[n]
        if active is not None:
            data.eq_active[:] = active
        span = float(trajectory.t[n + 1] - trajectory.t[n])
        steps = min(200, max(1, round(span / model.opt.timestep)))
        geoms = set()
        for s in range(steps):
            for m, c in self._mocaps:
                share = s / steps
                data.mocap_pos[m] = (1 - share) * trajectory.pos[n, c] + share * trajectory.pos[n + 1, c]
                data.mocap_quat[m] = trajectory.quat[n, c]
            mujoco.mj_step(model, data)
            if data.ncon:
                geoms.update(map(tuple, data.contact.geom.tolist()))
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        owner = model.geom_bodyid
        return frozenset((int(owner[max(a, 0)]), int(owner[max(b, 0)])) for a, b in geoms)


def _taking_part(
    model: "mujoco.MjModel", found: Fit, bodies: Array, touched: list[frozenset[tuple[int, int]]]
) -> tuple[Array, Array]:
    """(N, b) bool each: which bodies can be judged, and which touch something on the way."""
    unknown, tied, tree = _unknown_trees(model, found), _tied_trees(model), model.body_treeid
    known: dict[frozenset[tuple[int, int]], tuple[Array, Array]] = {}
    for pairs in touched:
        if pairs not in known:
            group = _spread(unknown, [*pairs, *tied], tree)
            near = np.isin(bodies, [b for pair in pairs for b in pair])
            known[pairs] = (tree[bodies] >= 0) & ~group[np.maximum(tree[bodies], 0)], near
    rows = [known[pairs] for pairs in touched]
    empty = np.zeros((0, len(bodies)), dtype=bool)
    return (np.array([r[0] for r in rows]), np.array([r[1] for r in rows])) if rows else (empty, empty.copy())


def _unknown_trees(model: "mujoco.MjModel", found: Fit) -> Array:
    """(ntree,) bool: kinematic trees that an actuator or a flex moves, or of which a body was not recorded."""
    from worldengine.recording.describing import names, pulled_bodies

    marked = np.zeros(max(1, model.ntree), dtype=bool)
    called = {name: b for b, name in enumerate(names(model, "body", model.nbody))}
    for pulled in pulled_bodies(model)["actuator"]:
        for name in pulled:
            marked[model.body_treeid[called[name]]] = True
    if model.nu and any(not pulled for pulled in pulled_bodies(model)["actuator"]):
        marked[:] = True  # adhesion, or a transmission that the reference pose does not show
    for b in range(1, model.nbody):
        if model.body_treeid[b] >= 0 and not found.known[b]:
            marked[model.body_treeid[b]] = True
    owners = [int(b) for b in (*np.ravel(model.flex_vertbodyid), *np.ravel(model.flex_nodebodyid)) if b > 0]
    for b in owners:
        if model.body_treeid[b] >= 0:
            marked[model.body_treeid[b]] = True
    return marked


def _tied_trees(model: "mujoco.MjModel") -> list[tuple[int, int]]:
    """Pairs of bodies that an equality or a tendon ties together: what moves one moves the other."""
    from worldengine.recording.describing import names, pulled_bodies, tied_bodies

    called = names(model, "body", model.nbody)
    at = {name: b for b, name in enumerate(called)}
    groups = [tied_bodies(model, e, called) for e in range(model.neq)]
    groups += pulled_bodies(model)["tendon"] if model.ntendon else []
    return [(at[one], at[other]) for group in groups for one, other in itertools.pairwise(group)]


def _switches(model: "mujoco.MjModel") -> list[Array]:
    """Other states that the equalities may have: all off, all on, and each one alone switched."""
    if not model.neq:
        return []
    declared = model.eq_active0.astype(bool)
    found = [np.zeros(model.neq, dtype=bool), np.ones(model.neq, dtype=bool)]
    if 1 < model.neq <= 6:
        for e in range(model.neq):
            other = declared.copy()
            other[e] = not other[e]
            found.append(other)
    return [state for state in found if not np.array_equal(state, declared)]


def _spread(marked: Array, pairs: list[tuple[int, int]], tree: Array) -> Array:
    """The marked trees, and those that touch or are tied to one, at first or second hand."""
    found = marked.copy()
    if not found.any():
        return found
    grew = True
    while grew:
        grew = False
        for a, b in pairs:
            one, other = int(tree[a]), int(tree[b])
            if one >= 0 and other >= 0 and found[one] != found[other]:
                found[one] = found[other] = grew = True
    return found

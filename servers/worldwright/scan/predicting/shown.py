"""Show rows of a foreign recording in the model beside it: what overlaps there, and which bodies touch."""

from typing import TYPE_CHECKING, Any

import numpy as np

from ...model.recording.trajectory import Trajectory
from .joint_coordinates import fitted

if TYPE_CHECKING:
    import mujoco

ROWS = 96


class Shown:
    """Puts a model into the state of any row."""

    def __init__(self, trajectory: Trajectory) -> None:
        import mujoco

        self.model, self.trajectory, self.found = trajectory.model, trajectory, fitted(trajectory)
        self.data = mujoco.MjData(self.model)

    def show(self, row: int) -> "mujoco.MjData":
        """The data with kinematics and contacts of that row."""
        import mujoco

        model, data, trajectory = self.model, self.data, self.trajectory
        data.qpos[:] = self.found.qpos[row]
        for b in np.flatnonzero(model.body_mocapid >= 0):
            if (c := self.found.columns[b]) >= 0:
                data.mocap_pos[model.body_mocapid[b]] = trajectory.pos[row, c]
                data.mocap_quat[model.body_mocapid[b]] = trajectory.quat[row, c]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_collision(model, data)
        return data

    def pairs(self, row: int) -> list[tuple[float, int, int]]:
        """(depth in m, columns of the two bodies) of each contact of that row, the deepest first; -1 is the world."""
        data = self.show(row)
        column = self.found.columns
        found = []
        for contact in data.contact:
            if min(contact.geom) >= 0:
                one, other = (int(column[self.model.geom_bodyid[g]]) for g in contact.geom)
                found.append((-float(contact.dist), one, other))
        return sorted(found, reverse=True)


def overlaps(trajectory: Trajectory) -> list[dict[str, Any]]:
    """Visible bodies that pass through each other because they cannot collide; see
    `worldengine.recording.drawn_overlaps`.
    """
    from worldengine.recording import drawn_overlaps

    if not len(trajectory.t):
        return []
    shown = Shown(trajectory)

    def touching(_row: int) -> set[frozenset[int]]:
        contacts = shown.data.contact
        bodies = shown.model.geom_bodyid
        return {frozenset(int(bodies[g]) for g in pair) for pair in contacts.geom if pair.min() >= 0}

    rows = np.unique(np.linspace(0, len(trajectory.t) - 1, ROWS).round().astype(int))
    return drawn_overlaps.search(shown.model, trajectory.t, rows, shown.show, touching, constant=False)

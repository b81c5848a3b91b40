"""Cross-check questions about one body and a stretch of time: numbers for a reviewer who doubts a picture."""

import numpy as np

from ..model.trajectory import Trajectory
from .answers import Answer, Touch


def answer(trajectory: Trajectory, body: str, window_s: tuple[float, float] | None) -> Answer:
    """Everything asked about one body in one window."""
    index = trajectory.index(body)
    rows = trajectory.rows(*window_s) if window_s else trajectory.rows()
    t = trajectory.t[rows]
    path = trajectory.pos[rows, index] if index >= 0 else np.zeros((len(t), 3))
    speed = trajectory.speed[rows, index] if index >= 0 else np.zeros(len(t))
    quat = trajectory.quat[rows, index] if index >= 0 else np.tile((1.0, 0, 0, 0), (len(t), 1))
    slow = speed < 0.02
    restless = np.flatnonzero(~slow)
    rest = float(t[0]) if not len(restless) else float(t[restless[-1] + 1]) if restless[-1] + 1 < len(t) else None
    turned = 2 * np.degrees(np.arccos(np.clip(abs(float(quat[0] @ quat[-1])), 0.0, 1.0)))
    return Answer(
        body=body,
        window_s=(float(t[0]), float(t[-1])),
        moved_m=float(np.linalg.norm(path - path[0], axis=1).max()),
        travelled_m=float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum()),
        from_m=tuple(float(v) for v in path[0]),
        to_m=tuple(float(v) for v in path[-1]),
        max_speed_m_s=float(speed.max()),
        mean_speed_m_s=float(speed.mean()),
        turned_deg=float(turned),
        at_rest_from_s=rest,
        touches=_touches(trajectory, index, rows),
    )


def _touches(trajectory: Trajectory, index: int, rows: slice) -> tuple[Touch, ...]:
    contacts = trajectory.contacts
    if contacts is None:
        return ()
    own = contacts.live & ((contacts.body1 == index) | (contacts.body2 == index))
    here = contacts.take(own & (contacts.row >= rows.start) & (contacts.row < rows.stop))
    others = np.where(here.body1 == index, here.body2, here.body1)
    found = []
    for other in np.unique(others):
        mine = others == other
        at = np.unique(here.row[mine])
        force = np.zeros(len(trajectory.t))
        np.add.at(force, here.row[mine], here.normal_force[mine])
        found.append(
            Touch(
                other=trajectory.names[other] if other >= 0 else "ground",
                first_s=float(trajectory.t[at[0]]),
                share=len(at) / max(rows.stop - rows.start, 1),
                max_force_n=float(force.max()),
            )
        )
    return tuple(found)

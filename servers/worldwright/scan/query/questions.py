"""Cross-check questions about one body and a stretch of time: numbers for a reviewer who doubts a picture."""

from typing import Any

import numpy as np

from worldkit.turning import angles_between

from ...model.errors import NotFoundError
from ...model.recording.trajectory import Trajectory
from ..anomalies.sign import spans
from ..anomalies.wholes import assembled
from ..measuring.measured import bridged
from .answered import Answer, Touch

STILL = 1e-3
"""A body that moves by less than this share of its size, or turns by less (rad), has not moved."""
REST = 0.02
"""Below this share of sqrt(g size), the speed of falling by half its own size, a body rests, whatever the scale."""
SHORTEST_REST_S = 0.05
MOST_RESTS = 6


def answer(trajectory: Trajectory, body: str, window_s: tuple[float, float] | None) -> Answer:
    """Answer for one body, with what is welded on below it, in one window.

    Raises:
        NotFoundError: no such body, or the window lies outside the recording.
    """
    index = trajectory.index(body)
    if len(members := trajectory.members(index)) > 1:
        # Its own parts count as the body; the others it touches are named as they were recorded.
        trajectory = assembled(trajectory, {index, *range(len(trajectory.names))} - ({*members} - {index}))
        index = trajectory.index(body)
    rows = _rows(trajectory, window_s)
    t = trajectory.t[rows]
    notes: list[str] = []
    found: dict[str, Any] = {"body": body, "window_s": (float(t[0]), float(t[-1]))}
    found |= _motion(trajectory, index, rows, notes)
    found |= _contact(trajectory, index, rows, notes)
    return Answer(**found, touches=_touches(trajectory, index, rows), notes=tuple(notes))


def _rows(trajectory: Trajectory, window_s: tuple[float, float] | None) -> slice:
    if window_s is None:
        return trajectory.rows()
    start, end = float(trajectory.t[0]), float(trajectory.t[-1])
    if window_s[1] < window_s[0] or window_s[0] > end + 1e-9 or window_s[1] < start - 1e-9:
        raise NotFoundError(
            f"nothing was recorded from {window_s[0]:g} to {window_s[1]:g} s",
            next_move=f"the recording goes from {start:.3f} to {end:.3f} s: name a window inside it, as START:END",
        )
    return trajectory.rows(*window_s)


def _motion(trajectory: Trajectory, index: int, rows: slice, notes: list[str]) -> dict[str, Any]:
    """Measure where it went, how fast, and when it rested."""
    t = trajectory.t[rows]
    if index < 0:
        zero = (0.0, 0.0, 0.0)
        return {
            "moved": False, "moved_m": 0.0, "travelled_m": 0.0, "from_m": zero, "to_m": zero, "max_speed_m_s": 0.0,
            "mean_speed_m_s": 0.0, "turned_deg": 0.0, "at_rest_from_s": float(t[0]), "max_speed_at_s": float(t[0]),
        }  # fmt: skip
    path, speed, spin = trajectory.pos[rows, index], trajectory.speed[rows, index], trajectory.spin[rows, index]
    quat, size = trajectory.quat[rows, index], float(trajectory.size_m[index])
    finite = np.isfinite(path).all(axis=1) & np.isfinite(speed) & np.isfinite(quat).all(axis=1)
    if not finite.all():
        notes.append(f"{int((~finite).sum())} of {len(t)} rows are not finite (first at {t[(~finite).argmax()]:.3f} s)")
        if not finite.any():
            raise NotFoundError("no row of this window is finite", next_move="look at an earlier window")
    # Where nothing finite is known, the last known value stands in: distances stay true for the rows that count.
    kept = np.flatnonzero(finite)
    path, speed, spin, quat, when = path[kept], speed[kept], np.nan_to_num(spin[kept]), quat[kept], t[kept]
    moved = float(np.linalg.norm(path - path[0], axis=1).max())
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    turned = angles_between(quat, quat[0])
    # A body that is posed moves without a velocity: its poses count, too.
    carried = np.concatenate((steps / np.maximum(np.diff(when), 1e-12), [0.0]))
    fast = np.maximum(speed + spin * size, np.maximum(carried, np.concatenate(([0.0], carried[:-1]))))
    limit = REST * float(trajectory.speed_scale[index])
    quiet = spans(fast <= limit)
    rests = [(float(when[a]), float(when[b - 1])) for a, b in quiet]
    last = rests[-1][0] if len(quiet) and quiet[-1][1] == len(when) else None
    long = sorted(sorted((r for r in rests if r[1] - r[0] >= SHORTEST_REST_S), key=lambda r: r[0] - r[1])[:MOST_RESTS])
    top = int(speed.argmax())
    if float(carried.max()) > 2 * float(speed.max()) + limit:
        notes.append(
            f"its poses move at up to {carried.max():.3g} m/s, its recorded velocity says {speed.max():.3g} m/s"
        )
    return {
        "moved": bool(moved > STILL * size or turned.max() > STILL),
        "moved_m": moved,
        "travelled_m": float(steps.sum()),
        "from_m": tuple(float(v) for v in path[0]),
        "to_m": tuple(float(v) for v in path[-1]),
        "max_speed_m_s": float(speed[top]),
        "max_speed_at_s": float(when[top]),
        "mean_speed_m_s": float(speed.mean()),
        "max_spin_rad_s": float(spin.max()),
        "turned_deg": float(np.degrees(turned[-1])),
        "at_rest_from_s": last,
        "rests_s": tuple(long),
        "rest_speed_m_s": limit,
    }


def _contact(trajectory: Trajectory, index: int, rows: slice, notes: list[str]) -> dict[str, Any]:
    """Measure whether it touches anything, and with which total force."""
    t = trajectory.t[rows]
    if trajectory.contacts is not None:
        contacts = trajectory.contacts
        own = contacts.live & ((contacts.body1 == index) | (contacts.body2 == index))
        force, touched = np.zeros(len(trajectory.t)), np.zeros(len(trajectory.t), dtype=bool)
        np.add.at(force, contacts.row[own], contacts.normal_force[own])
        touched[contacts.row[own]] = True
        touching, pushed = touched[rows], force[rows]
    elif trajectory.contact_force_sum is not None and index >= 0:
        pushed = np.nan_to_num(trajectory.contact_force_sum[rows, index])
        touching = pushed > 0
        notes.append("the recording holds sums of contact forces, not which bodies touch")
    elif trajectory.ncon is not None and not np.any(trajectory.ncon[rows]):
        return {"touching": "no"}
    else:
        if trajectory.ncon is not None:
            most = int(np.max(trajectory.ncon[rows]))
            notes.append(f"there are up to {most} contacts in the scene, the recording does not tell whose")
        return {"touching": "unknown"}
    hard = int(pushed.argmax())
    return {
        "touching": "yes" if touching.any() else "no",
        "touching_share": float(bridged(trajectory, touching).mean()),
        "max_force_n": float(pushed[hard]),
        "max_force_at_s": float(t[hard]),
    }


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
                last_s=float(trajectory.t[at[-1]]),
                share=float(bridged(trajectory, np.isin(np.arange(rows.start, rows.stop), at)).mean()),
                max_force_n=float(force.max()),
                mean_force_n=float(force[at].mean()),
                max_depth_m=float(here.depth_m[mine].max()),
            )
        )
    return tuple(sorted(found, key=lambda touch: touch.first_s))

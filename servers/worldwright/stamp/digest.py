"""A recording's motion in a few kilobytes, so that another machine's run can be held against it.

Sampled at evenly spaced rows (first and last included), with the distance and the turn accumulated at the full rate:
chaotic motion amplifies the last bit of a float, so the tolerance between two machines grows with the way of a body, the
shorter of both.
"""

from pathlib import Path

from pydantic import model_validator

from ..model.frozen import Frozen
from .kept import Kept
from .statement import Statement

NAME = "motion.json"
SAMPLES = 61
NUMBERS = 60_000  # upper bound on stored numbers
POSITION_M = 1e-3
TURN_DEG = 1.0
SHARE = 0.01
TOLERANCE = "1 mm + 1 % of the distance travelled, 1 degree + 1 % of the accumulated turn, by the shorter way"


class Motion(Frozen):
    """Sampled motion of the bodies that have degrees of freedom."""

    bodies: tuple[str, ...]
    time_s: tuple[float, ...]
    position: tuple[tuple[tuple[float, float, float], ...], ...]
    """Per sample and body: body origin in the world frame, metres."""
    quaternion: tuple[tuple[tuple[float, float, float, float], ...], ...]
    """Per sample and body: w, x, y, z."""
    travelled_m: tuple[tuple[float, ...], ...]
    """Per sample and body: path length so far."""
    turned_deg: tuple[tuple[float, ...], ...]
    """Per sample and body: accumulated rotation so far."""

    @model_validator(mode="after")
    def _whole(self) -> "Motion":
        for name in ("position", "quaternion", "travelled_m", "turned_deg"):
            rows = getattr(self, name)
            if len(rows) != len(self.time_s) or any(len(row) != len(self.bodies) for row in rows):
                raise ValueError(f"{name} has no number for each sample and body")
        return self


class Difference(Frozen):
    """How far two motions are apart, at their worst moment against the tolerance."""

    within: bool
    message: str
    body: str = ""
    time_s: float = 0.0
    position_m: float = 0.0
    turn_deg: float = 0.0
    allowed_m: float = 0.0
    allowed_deg: float = 0.0


def motion(recording: Path) -> Motion:
    """The sampled motion of a recording folder."""
    import numpy as np

    from worldkit.turning import angles_between

    from ..model.recording.trajectory_files import read_trajectory

    recorded = read_trajectory(recording)
    driven = recorded.mechanics.mocap
    moving = np.ones(len(recorded.names), dtype=bool)
    if recorded.mechanics.dynamic is not None:
        moving = recorded.mechanics.dynamic if driven is None else recorded.mechanics.dynamic | driven
    names = [name for name, moves in zip(recorded.names, moving, strict=True) if moves]
    position, quaternion = recorded.pos[:, moving], recorded.quat[:, moving]
    travelled = np.zeros(position.shape[:2])
    turned = np.zeros(position.shape[:2])
    travelled[1:] = np.cumsum(np.linalg.norm(np.diff(position, axis=0), axis=2), axis=0)
    turned[1:] = np.cumsum(np.degrees(angles_between(quaternion[1:], quaternion[:-1])), axis=0)
    count = max(2, min(SAMPLES, NUMBERS // max(1, 9 * len(names)), len(position)))
    rows = np.unique(np.linspace(0, len(position) - 1, count).round().astype(int))
    return Motion.model_validate(
        {
            "bodies": names,
            "time_s": np.round(recorded.t[rows], 9).tolist(),
            "position": np.round(position[rows], 7).tolist(),
            "quaternion": np.round(quaternion[rows], 7).tolist(),
            "travelled_m": np.round(travelled[rows], 6).tolist(),
            "turned_deg": np.round(turned[rows], 4).tolist(),
        }
    )


def compare(stamped: Motion, now: Motion) -> Difference:
    """Hold a new motion against a stamped one, sample by sample, by the shorter way: a stamped one is a stranger's word."""
    import numpy as np

    from worldkit.turning import angles_between

    if stamped.bodies != now.bodies:
        return Difference(within=False, message=f"other bodies move: {', '.join(now.bodies)}")
    if len(stamped.time_s) != len(now.time_s) or not np.allclose(stamped.time_s, now.time_s, rtol=0, atol=1e-6):
        return Difference(
            within=False, message=f"it ends at {now.time_s[-1]} s, stamped {stamped.time_s[-1]} s, or steps otherwise"
        )
    if not stamped.bodies:
        return Difference(within=True, message="nothing moves")
    apart = np.linalg.norm(np.subtract(stamped.position, now.position), axis=2)
    turned = np.degrees(angles_between(np.asarray(stamped.quaternion), np.asarray(now.quaternion)))
    allowed_m = POSITION_M + SHARE * np.minimum(stamped.travelled_m, now.travelled_m)
    allowed_deg = TURN_DEG + SHARE * np.minimum(stamped.turned_deg, now.turned_deg)
    excess = np.maximum(apart / allowed_m, turned / allowed_deg)
    excess = np.where(np.isfinite(excess), excess, np.inf)
    sample, body = np.unravel_index(int(np.argmax(excess)), excess.shape)
    within = bool(excess[sample, body] <= 1.0)
    found = {
        "body": stamped.bodies[body],
        "time_s": stamped.time_s[sample],
        "position_m": float(apart[sample, body]),
        "turn_deg": float(turned[sample, body]),
        "allowed_m": float(allowed_m[sample, body]),
        "allowed_deg": float(allowed_deg[sample, body]),
    }
    return Difference(
        within=within,
        message=f"worst: {found['body']} at {found['time_s']:.3f} s is {found['position_m']:.2e} m and "
        f"{found['turn_deg']:.2e} degrees off (allowed {found['allowed_m']:.2e} m, {found['allowed_deg']:.2e} degrees)",
        **found,
    )


def stamped_motion(accepted: Path, statement: Statement) -> Motion | None:
    """The motion kept in an accepted folder, when there is one that can be read."""
    return Kept.read(accepted / NAME, Motion).value if statement.digest_of(NAME) else None

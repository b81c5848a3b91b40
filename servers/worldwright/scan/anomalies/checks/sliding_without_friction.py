"""A body slides over rough ground and does not slow down.

What it means: it is moved by a script, or pushed by something the recording does not name.

Formula: a body that is not round, without drives, in contact and on a level way for 0.4 s at |w| r < 0.1 v, whose
deceleration is less than a fifth of mu g; mu is its own friction (a contact takes the larger of the two).
Threshold: a fifth. Skipped where friction is under 0.05, or where surfaces move.
Source: Coulomb's law of sliding friction, a = mu g.
"""

from collections.abc import Iterator

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, SkipError, spans
from ..survey import survey
from .sliding_as_rolling import FRICTION, HELD_S, shaped, steady_slide

CODE = "WS126"
NEEDS = ("touching", "mechanics.geom_type", "mechanics.geom_friction", "mechanics.unforced")
WHOLE = True
ROUND = frozenset({"sphere", "capsule", "cylinder", "ellipsoid"})


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that slide for ever."""
    facts, touching = trajectory.mechanics, trajectory.touching
    g = float(np.sqrt((trajectory.gravity**2).sum()))
    if facts.geom_friction is None or facts.unforced is None or touching is None or g == 0:
        return
    if "surface velocity" in facts.drives:
        raise SkipError("a surface moves, and carries what lies on it")
    assert facts.geom_body is not None and facts.geom_collides is not None
    rows = max(4, round(HELD_S / trajectory.interval_s))
    long = survey(trajectory).touches.sum(axis=0) >= rows - 1
    for b in np.flatnonzero(trajectory.moves_freely & facts.unforced & long):
        own = np.flatnonzero((facts.geom_body == b) & facts.geom_collides)
        friction = float(facts.geom_friction[own].min(initial=np.inf))
        if not len(own) or friction < FRICTION or any(facts.geom_type[g_] in ROUND for g_ in own):
            continue
        slides = steady_slide(trajectory, int(b), friction * g)
        slides &= trajectory.spin[:, b] * trajectory.size_m[b] < 0.1 * trajectory.speed[:, b]
        if not slides.any() or _carried(trajectory, int(b), slides):
            continue
        for start, stop in spans(slides, bridge=1):
            if stop - start < rows:
                continue
            name, speed = trajectory.names[b], float(np.median(trajectory.speed[start:stop, b]))
            window = (trajectory.t[start], trajectory.t[stop - 1])
            message = (
                f"{name} slides on at {speed:.3g} m/s where friction should take {friction * g:.2g} m/s each second"
            )
            severity = "info" if context.acts_on(name, ("pose", "velocity", "force")) else "blocking"
            lost = float(trajectory.speed[start, b] - trajectory.speed[stop - 1, b]) / (window[1] - window[0])
            yield Sign(name, window, lost, 0.2 * friction * g, "m/s^2", severity, message)
            break


def _carried(trajectory: Trajectory, b: int, rows: np.ndarray) -> bool:
    """Whether another moving body is near enough to carry or push it."""
    for other in range(len(trajectory.names)):
        if other == b:
            continue
        gap = np.sqrt(((trajectory.pos[rows, b] - trajectory.pos[rows, other]) ** 2).sum(axis=1))
        near = gap < 1.2 * (trajectory.size_m[b] + trajectory.size_m[other])
        if np.mean(near & (trajectory.speed[rows, other] > 0.2 * trajectory.speed[rows, b])) > 0.2:
            return True
    return False


GOOD = (
    lambda: Case("a box braked by friction", shaped(analytic.sliding(3.0, 4.9), "box", 0.5)),
    lambda: Case("a box on ice", shaped(analytic.sliding(3.0), "box", 0.01)),
)
BAD = (lambda: Case("a box drawn along", shaped(analytic.sliding(1.0), "box", 0.5), severity="blocking"),)

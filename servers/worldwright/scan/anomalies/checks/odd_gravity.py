"""A world whose gravity is not the earth's, and nothing in it says so.

What it means: the unit is wrong (9810 in a scene in metres), the axis is (a scene with y up), a sign is, or gravity was
switched off or left at a test's value.

Formula: with a model beside the recording, its gravity against 9.81 m/s^2 downwards; words that say what is meant (moon,
mars, orbit, space, weightless, micro- or zero gravity, a planet) in the names and texts of the model silence it. From
poses alone: a body apart from everything whose acceleration is the same, within a tenth of g, for 0.3 s and 12 rows, and
is not the earth's: sideways, upwards, none, stronger or weaker.
Threshold: a twentieth of g. A warning: which world is meant, only a reader can tell.
Source: CGPM 1901, standard gravity 9.80665 m/s^2.
"""

import re
from collections.abc import Iterator
from dataclasses import replace
from functools import cache

import numpy as np

from ....model.recording.mechanics import Mechanics
from ....model.recording.trajectory import STANDARD_GRAVITY, Trajectory
from ...known import analytic, modelled
from ..sign import Case, Context, Sign, spans
from ..survey import survey

CODE = "WS136"
NEEDS = ("linvel",)
HELD_S, ROWS, SHARE = 0.3, 12, 0.05
EARTH = np.array([0.0, 0.0, -STANDARD_GRAVITY])
WORDS = re.compile(
    r"moon|lunar|mars|martian|jupiter|venus|mercury|saturn|titan|planet|orbit|\biss\b|iss_|space|satellite|asteroid|comet"
    r"|weightless|micro.?g|zero.?g|zero gravity|low.?g|no.?gravity|gravity|free.?fall|air.?table|top.?view|planar",
    re.IGNORECASE,
)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that show it most."""
    if context.planned or trajectory.interventions is not None:
        return  # a plan states its gravity, and the checks of flight judge the recording by it
    known = trajectory.mechanics.gravity
    if known is not None:
        if np.abs(known - EARTH).max() > SHARE * STANDARD_GRAVITY and not _is_explained(trajectory):
            yield from _judge_model(trajectory, known)
        return
    yield from _judge_poses(trajectory)


def _is_explained(trajectory: Trajectory) -> bool:
    if trajectory.model is None:
        return False
    words = [bytes(trajectory.model.names).replace(b"\0", b" ").decode(errors="replace")]
    words.append(bytes(trajectory.model.text_data).decode(errors="replace") if trajectory.model.ntext else "")
    return bool(WORDS.search(" ".join(words)))


def _judge_model(trajectory: Trajectory, gravity: np.ndarray) -> Iterator[Sign]:
    moved = np.ptp(trajectory.pos, axis=0).max(axis=1) * trajectory.moves_freely
    size = float(np.sqrt((gravity**2).sum()))
    told = ", ".join(f"{g:.3g}" for g in gravity)
    for b in np.argsort(-moved)[:3]:
        if trajectory.moves_freely[b]:
            message = f"{trajectory.names[b]} is in a world whose gravity is ({told}) m/s^2, and nothing in it says why"
            window = (trajectory.t[0], trajectory.t[-1])
            yield Sign(trajectory.names[b], window, size, STANDARD_GRAVITY, "m/s^2", "warn", message)


def _judge_poses(trajectory: Trajectory) -> Iterator[Sign]:
    touching = trajectory.touching
    if touching is None or len(trajectory.t) <= ROWS:
        return
    dt = np.diff(trajectory.t)[:, None]
    apart = ~(touching[1:] | touching[:-1])
    found = []
    otherwise = survey(trajectory).off_gravity.any(axis=0)
    for b in np.flatnonzero(otherwise & (apart.sum(axis=0) >= ROWS)):
        velocity = np.ascontiguousarray(trajectory.linvel[:, b])
        rate = np.diff(velocity, axis=0) / dt
        even = apart[:, b].copy()
        size = np.sqrt((np.diff(rate, axis=0) ** 2).sum(axis=1))
        even[1:] &= size < 0.02 * np.maximum(STANDARD_GRAVITY, np.sqrt((rate[1:] ** 2).sum(axis=1)))
        stretches = np.asarray(spans(even), int).reshape(-1, 2)
        # Most flights are as on earth: the change of velocity over a stretch tells that at once.
        first, last = stretches.T
        overall = (velocity[last] - velocity[first]) / (trajectory.t[last] - trajectory.t[first])[:, None]
        odd = ((overall - EARTH) ** 2).sum(axis=1) > (0.8 * SHARE * STANDARD_GRAVITY) ** 2
        for start, stop in stretches[odd]:
            seconds = trajectory.t[stop] - trajectory.t[start]
            mean = np.median(rate[start:stop], axis=0)
            strong = float(np.sqrt((mean**2).sum()))
            fast = strong > 3 * STANDARD_GRAVITY and stop - start >= ROWS
            if (seconds < HELD_S or stop - start < ROWS) and not fast:
                continue
            way = float(np.ptp(trajectory.pos[start : stop + 1, b], axis=0).max())
            near = max(1.0, strong / STANDARD_GRAVITY) * 0.1 * STANDARD_GRAVITY
            if np.abs(rate[start:stop] - mean).max() > near or way < trajectory.size_m[b]:
                continue
            if np.sqrt(((mean - EARTH) ** 2).sum()) > SHARE * STANDARD_GRAVITY:
                found.append((way, int(b), int(start), int(stop), mean))
    # A rail or a bearing may lead one body that coasts; where nothing falls, several coast.
    coasting = {b for _, b, _, _, mean in found if np.sqrt((mean**2).sum()) < SHARE * STANDARD_GRAVITY}
    if len(coasting) == 1:
        found = [row for row in found if row[1] not in coasting]
    for way, b, start, stop, mean in sorted(found, key=lambda row: -row[0])[:3]:
        told = ", ".join(f"{g:.3g}" for g in mean)
        message = (
            f"{trajectory.names[b]} touches nothing and moves {way:.3g} m with an even ({told}) m/s^2, not as on earth"
        )
        window = (trajectory.t[start], trajectory.t[stop])
        strong = float(np.sqrt((mean**2).sum()))
        yield Sign(trajectory.names[b], window, strong, STANDARD_GRAVITY, "m/s^2", "warn", message)


@cache
def _world(gravity: str, name: str = "crate") -> Trajectory:
    return modelled.run(modelled.scene(modelled.box(name, "0 0 3"), option=f'gravity="{gravity}"'), 0.5)


def _bare(gravity: str) -> Case:
    return Case(
        f"poses alone, gravity {gravity}", replace(_world(gravity), mechanics=Mechanics(), model=None), severity="warn"
    )


GOOD = (
    lambda: Case("the earth's", _world("0 0 -9.81")),
    lambda: Case("the moon's, said", _world("0 0 -1.62", "moon_rock")),
    lambda: Case("a bouncing ball", analytic.bouncing()),
)
BAD = (
    lambda: Case("a third of it, unsaid", _world("0 0 -3"), severity="warn"),
    lambda: _bare("0 -9.81 0"),
    lambda: _bare("0 0 2"),
)

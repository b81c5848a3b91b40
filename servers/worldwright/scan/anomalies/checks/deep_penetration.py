"""Two bodies overlap far more than a contact should let them.

What it means: the contact is too soft for the load or the speed, the bodies were placed inside each other, or the step
is too long for how fast they meet. It looks like clipping, and overlaps at the start burst apart.

Formula: depth / t, with t the half-thickness of the thinner geom that moves (half the smallest extent): of that part
alone, whatever it is welded to, since it is the part that is seen inside the other. A small ball on a body that only touches and is
not drawn, as on a robot's finger tip, counts as its body does.
Threshold: a tenth for 0.1 s or 0.3 at any moment warns; 0.3 for 0.1 s, or 1 at any moment (half of the body is
inside), blocks. What the plan lets overlap (`topology.overlaps`) is looked at only where it is deeper.
Source: the manual on soft contacts and `solref`, `solimp`; the reference paper's checks on clipping.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.finding import AnomalySeverity
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ...predicting.shown import Shown
from ..declared import overlap_m
from ..sign import Case, Context, Sign, SkipError, sliding_sum

CODE = "WS110"
RELATIVE = True
SHOWN_AS = "penetration"
NEEDS = ("pos",)
SUSTAINED_S = 0.1
LASTING_S = 0.25
FEW = 3
EVERYDAY_M = 0.03
NUB = 0.25
"""Of its body's half-thickness: a ball that is not drawn and smaller than that only helps its body to touch."""


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the worst pair of each body that overlaps too much."""
    contacts = trajectory.contacts
    if contacts is None:
        yield from _unsized(trajectory) if trajectory.mechanics.half_extents is None else _deepest(trajectory)
        return
    if trajectory.mechanics.half_extents is None:
        raise SkipError("the recording has no mechanics.half_extents")
    if not len(contacts.row):
        return
    ratio = contacts.depth_m / _half_thickness(trajectory)
    held = max(1, round(SUSTAINED_S / trajectory.interval_s))
    suspicious = ratio > 0.1
    pairs = np.unique(np.stack([contacts.body1, contacts.body2], axis=1)[suspicious], axis=0)
    for one, other in pairs:
        ends = [trajectory.names[i] if i >= 0 else "world" for i in (one, other)]
        rows = contacts.of_pair(one, other) & suspicious
        if allowed := overlap_m(context, trajectory, *ends):
            half = _half_thickness(trajectory, scenery=1.0, unknown=0.0)
            rows &= contacts.depth_m > np.where(np.isfinite(half), np.minimum(allowed, half), 0.0)
        worst = np.zeros(len(trajectory.t))
        np.maximum.at(worst, contacts.row[rows], ratio[rows])
        lasting = _lasting_level(worst, held)
        if worst.max() < 0.3 and lasting < 0.1:
            continue
        severity = "blocking" if worst.max() > 1.0 or lasting > 0.3 else "warn"
        threshold = 0.3 if worst.max() >= 0.3 else 0.1
        n = int(np.argmax(worst))
        depth = float(contacts.depth_m[rows & (contacts.row == n)].max())
        names = " and ".join(ends if one > other else reversed(ends))
        inside = np.flatnonzero(worst > 0.1)
        window = (trajectory.t[inside[0]], trajectory.t[inside[-1]])
        message = f"{names} overlap by up to {depth:.3g} m, {worst.max():.0%} of the thinner one's half-thickness"
        yield Sign(names, window, worst.max(), threshold, "of the half-thickness", severity, message, depth)


def _deepest(trajectory: Trajectory) -> Iterator[Sign]:
    """Judge a recording that tells only the deepest penetration of each row, against the largest body that moves.

    Which bodies overlap is not told, and a hard blow on the usual soft contacts goes deep for a moment: a whole bounding
    radius blocks, as does a quarter at the start or, where at most three bodies move, for 0.25 s.
    """
    deepest, half = _told(trajectory), trajectory.mechanics.half_extents
    assert half is not None
    known = trajectory.moves_freely & ~np.isnan(half).any(axis=1)
    if not known.any():
        raise SkipError("the sizes of the bodies that move are not known")
    ratio = deepest / float(trajectory.size_m[known].max())
    lasting = _lasting_level(ratio, max(1, round(LASTING_S / trajectory.interval_s)))
    if known.sum() > FEW:
        lasting = 0.0  # in a crowd blow follows blow: some pair being deep at any time says nothing about one pair
    if ratio.max() < 0.25:
        return
    severity: AnomalySeverity = "blocking" if ratio.max() > 1.0 or ratio[0] > 0.25 or lasting > 0.25 else "warn"
    inside = np.flatnonzero(ratio > 0.1)
    window = (trajectory.t[inside[0]], trajectory.t[inside[-1]])
    message = f"bodies overlap by up to {deepest.max():.3g} m, {ratio.max():.0%} of a bounding radius"
    name = _inside(trajectory, int(np.argmax(ratio)))
    yield Sign(name, window, ratio.max(), 0.25, "of the bounding radius", severity, message)


def _unsized(trajectory: Trajectory) -> Iterator[Sign]:
    """Judge poses alone: a depth that no contact of everyday things has, at the start or for long."""
    deepest, pressed = _told(trajectory), trajectory.contact_force_sum
    if pressed is None:
        raise SkipError("the recording has neither contacts nor contact_force_sum")
    rows = max(1, round(LASTING_S / trajectory.interval_s))
    lasting = _lasting_level(deepest, rows)
    if max(float(deepest[0]), lasting) < EVERYDAY_M:
        return
    n = 0 if deepest[0] >= EVERYDAY_M else int(np.argmax(deepest))
    inside = np.flatnonzero(deepest > 0.5 * EVERYDAY_M)
    window = (trajectory.t[inside[0]], trajectory.t[inside[-1]])
    message = f"bodies overlap by up to {deepest.max():.3g} m; their sizes are not known"
    name = trajectory.names[int(np.argmax(pressed[n]))]
    yield Sign(name, window, float(deepest.max()), EVERYDAY_M, "m", "warn", message)


def _told(trajectory: Trajectory) -> np.ndarray:
    """(T,) m: the deepest penetration of each row, 0 in a row that tells none."""
    deepest = trajectory.max_penetration
    if deepest is None:
        raise SkipError("the recording has neither contacts nor max_penetration")
    if np.isnan(deepest).all():
        raise SkipError("max_penetration holds no number")
    return np.where(np.isnan(deepest), 0.0, deepest)


def _inside(trajectory: Trajectory, n: int) -> str:
    """The body of a row's deepest contact that moves more, by the model, else the one that is pressed hardest."""
    if trajectory.model is not None:
        pairs = Shown(trajectory).pairs(n)
        ends = [b for b in (pairs[0][1:] if pairs else ()) if b >= 0 and trajectory.moves_freely[b]]
        if ends:
            return trajectory.names[max(ends, key=lambda b: float(np.ptp(trajectory.pos[:, b], axis=0).max()))]
    pressed = trajectory.contact_force_sum
    if pressed is not None and pressed[n].max() > 0:
        return trajectory.names[int(np.argmax(np.where(trajectory.moves_freely, pressed[n], 0.0)))]
    return "world"


def _half_thickness(trajectory: Trajectory, scenery: float = 2.0, unknown: float = np.inf) -> np.ndarray:
    """(N,) m: the half-thickness of the thinner geom of each contact; what does not move counts `scenery` times."""
    contacts, facts = trajectory.contacts, trajectory.mechanics
    assert contacts is not None
    thin = facts.half_thickness()
    assert thin is not None
    best = np.full(len(contacts.row), np.inf)
    for body, geom in ((contacts.body1, contacts.geom1), (contacts.body2, contacts.geom2)):
        inside = body >= 0
        own = np.where(inside, thin[body], np.inf)
        if geom is not None and facts.geom_half_extents is not None:
            own = np.where(inside, facts.geom_half_extents[geom].min(axis=1), np.inf)
            own = np.where(_nubs(trajectory)[geom] & inside, thin[body], own)
        still = inside & ~np.where(inside, trajectory.moves_freely[body], False)
        own = np.where(still, scenery * own, own)
        best = np.fmin(best, np.where(np.isnan(own), unknown, own))
    return best


def _nubs(trajectory: Trajectory) -> np.ndarray:
    """(G,) which geoms are small balls that are not drawn on a body that is larger."""
    facts = trajectory.mechanics
    half, of, thin = facts.geom_half_extents, facts.geom_body, facts.half_thickness()
    assert half is not None and thin is not None
    if of is None or facts.geom_drawn is None:
        return np.zeros(len(half), dtype=bool)
    balls = np.array([kind == "sphere" for kind in facts.geom_type])
    small = half.max(axis=1) < NUB * np.where(of >= 0, thin[of], 0.0)
    return np.asarray(balls & small & ~facts.geom_drawn)


def _lasting_level(values: np.ndarray, rows: int) -> float:
    """The mean over the worst window of `rows`, or 0 for a shorter recording."""
    if len(values) < rows:
        return 0.0
    return float((sliding_sum(values, rows) / rows).max())


def _overlapping(depth: float, seconds: float) -> Trajectory:
    still = analytic.resting()
    assert still.contacts is not None
    deep = np.where(still.t < seconds, depth, 1e-5)
    return replace(still, contacts=replace(still.contacts, depth_m=deep))


def _with_depth(depth: float) -> Case:
    still = analytic.resting()
    told = np.where(still.t < 0.2, depth, 0.0)
    return Case("only the deepest is told", replace(still, contacts=None, max_penetration=told), severity="blocking")


def _on_a_ball(drawn: bool) -> Trajectory:
    """A body of 5 cm that lies on a ball of 4 mm, 3 mm deep for a moment."""
    lying = _overlapping(0.003, 0.01)
    assert lying.contacts is not None
    rows = len(lying.contacts.row)
    contacts = replace(lying.contacts, geom1=np.zeros(rows, dtype=int), geom2=np.ones(rows, dtype=int))
    mechanics = replace(
        lying.mechanics,
        geom_names=("ground", "ball"), geom_body=np.array([-1, 0]), geom_type=("plane", "sphere"),
        geom_half_extents=np.array([[np.inf, np.inf, 0.0], [0.002, 0.002, 0.002]]), geom_drawn=np.array([True, drawn]),
    )  # fmt: skip
    return replace(lying, contacts=contacts, mechanics=mechanics)


GOOD = (
    lambda: Case("a body at rest", analytic.resting()),
    lambda: Case("a soft landing, 1 cm for 10 ms", _overlapping(0.01, 0.01)),
    lambda: Case("a ball that is not drawn helps it to touch", _on_a_ball(False)),
)
BAD = (
    lambda: _with_depth(0.06),
    lambda: Case("2 cm of 5 for half a second", _overlapping(0.02, 0.5), severity="blocking"),
    lambda: Case("1 cm of 5 for half a second", _overlapping(0.01, 0.5), severity="warn"),
    lambda: Case("a small ball is seen to sink", _on_a_ball(True), severity="blocking"),
    lambda: Case("more than half way in, once", _overlapping(0.06, 0.004), severity="blocking"),
)

"""What an author's law gives and takes, held against the ledger: momentum, energy, mass and volume of its points.

What its bodies were given is the engine's own ledger, in which nobody else may push them. The rest is the word of the author's
process (`worldkit.laws`): points, masses, what is stored, and what the world was given, which nothing else shows. So a law that by
mistake pushes without being pushed back shows here, and one that makes energy; a reader sees what went to the world, and what came
out of store.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..errors import RecordingError
from . import laws_told
from .records import Interventions

Array = np.ndarray
COLUMNS = ("mass", "momentum", "energy", "weight", "stored", "volume", "held")
ROUNDING = 1e-6
"""A share of what gravity gave and of what moves to and fro within: what is off by less is rounding, where nothing else acted."""


@dataclass(frozen=True)
class LawBalance:
    """One law at its F recorded instants, in the world frame."""

    name: str
    bodies: tuple[str, ...]
    t: Array
    """(F,) s."""
    mass: Array
    """(F,) kg."""
    momentum: Array
    """(F, 3) kg m/s."""
    energy: Array
    """(F,) J: of motion, by weight, and stored."""
    weight: Array
    """(F,) J: of that, by weight."""
    stored: Array
    """(F,) J: of that, stored, as the law says."""
    volume: Array
    """(F,) m^3; 0 where the law says none."""
    given: Array
    """(F, 3) N s: the impulse that bodies were given since the start."""
    held: Array
    """(F, 3) N s: the impulse that what stands fast was given since the start, as the law says."""
    work: Array
    """(F,) J: the work that it did on bodies since the start."""
    pushed: float
    """N s: all impulses that bodies were given, as magnitudes."""
    gravity: Array
    """(3,) m/s^2."""
    cell: float = 0.0
    """m: of its grid, where it is known to be a law of the suite's with one; else 0."""

    @cached_property
    def from_nowhere(self) -> float:
        """The momentum that no force accounts for, as a share of what was exchanged: the largest that there ever was, or, where
        that is more, all of it from one instant to the next, since what swings to and fro returns to nought as often as it swings.
        """
        off = np.diff(self.momentum + self.given + self.held, axis=0) - self._pulls
        largest, pulls, swing = float(_size(np.cumsum(off, axis=0)).max()), _size(self._pulls), self._swing
        ever = float(np.maximum(_size(off) - ROUNDING * (pulls + swing), 0.0).sum())
        return max(largest, ever) / max(self.exchanged, ROUNDING * float(pulls.sum() + swing.max()), 1e-12)

    @property
    def _swing(self) -> Array:
        """(F - 1,) N s: how large the terms can be whose sum its momentum is, by its mass and energy of motion (Cauchy, Schwarz)."""
        motion = np.maximum(self.energy - self.weight - self.stored, 0.0)
        return np.asarray(np.sqrt(2.0 * np.abs(self.mass) * motion)[1:])

    @property
    def _pulls(self) -> Array:
        """(F - 1, 3) N s: what gravity gave from one instant to the next."""
        return np.asarray(self.mass[:-1, None] * self.gravity * np.diff(self.t)[:, None])

    @property
    def exchanged(self) -> float:
        """N s: all impulses between points, bodies and what stands fast, as magnitudes.

        Mere weight is none: points that only lie, or only fall, would else make every other impulse small beside theirs.
        """
        changes = (np.diff(self.momentum, axis=0), np.diff(self.held, axis=0))
        return self.pushed + sum(float(np.minimum(_size(d), _size(d - self._pulls)).sum()) for d in changes)

    @property
    def to_world(self) -> float:
        """N s: all impulses that what stands fast was given, as magnitudes; nobody sees what becomes of them."""
        return float(_size(np.diff(self.held, axis=0)).sum())

    @cached_property
    def total(self) -> Array:
        """(F,) J: its energy and the work that it did."""
        return self.energy + self.work

    @property
    def scale_j(self) -> float:
        """How far its energy without that by weight, and its work, reach, J: ballast that is let down makes nothing small."""
        return float(max(np.ptp(self.energy - self.weight), np.ptp(self.work), 1e-12))

    @property
    def cell_j(self) -> float:
        """What lifts all of its mass by one cell of its grid, J: so exactly does a grid know where what lies on it lies."""
        return float(np.abs(self.mass).max() * np.linalg.norm(self.gravity) * self.cell)

    @property
    def drawn_j(self) -> float:
        """Energy that it took from what it began with in store, J, at most."""
        return float(self.stored[0] - self.stored.min())

    @property
    def made_j(self) -> float:
        """Energy that it made from nothing, J: the largest rise of the total above an earlier value."""
        return float((self.total - np.minimum.accumulate(self.total)).max())

    @property
    def lost_j(self) -> float:
        """Energy that it turned into heat, J, over the whole recording."""
        return float(self.total[0] - self.total[-1])

    @property
    def mass_change(self) -> float:
        """The largest change of mass, as a share of that at the start."""
        return _change(self.mass)

    @property
    def volume_change(self) -> float | None:
        """The largest change of volume, as a share of that at the start; None where the law says none."""
        return _change(self.volume) if self.volume.any() else None


def _change(values: Array) -> float:
    return float(np.abs(values - values[0]).max() / max(abs(float(values[0])), 1e-300))


def _size(vectors: Array) -> Array:
    return np.sqrt((np.asarray(vectors) ** 2).sum(axis=1))


def read(recording: Any, ledger: Interventions, gravity: Array | None) -> tuple[LawBalance, ...]:
    """The balances of a recording's laws; none where it has none, or where fewer than two instants were recorded.

    Raises:
        RecordingError: what it says of its laws or their sums makes no sense.
    """
    rows = laws_told.of(recording.meta, str(recording.folder))
    if not rows or len(recording.balances) < 2 * len(rows):
        return ()
    if gravity is None:
        raise _damaged(recording, "it has an author's law, and says no gravity")
    return tuple(_of(recording, number, law, ledger, np.asarray(gravity)) for number, law in enumerate(rows))


def _of(recording: Any, number: int, law: Any, ledger: Interventions, gravity: Array) -> LawBalance:
    from worldengine.inputs.openings import owner

    sums, step = recording.balances, float(recording.time_step)
    mine = np.asarray(sums.medium) == number
    t = np.asarray(sums.step)[mine] * step
    try:
        columns = {name: np.asarray(getattr(sums, name))[mine] for name in COLUMNS}
    except AttributeError as lacking:  # an earlier version recorded fewer
        raise _damaged(recording, f"of the law {law.name} it lacks a sum: {lacking}") from lacking
    if len(t) < 2 or not (np.diff(t) > 0).all() or not all(np.isfinite(column).all() for column in columns.values()):
        cause = f"the sums of the law {law.name} are no numbers at two instants or more, one after another"
        raise _damaged(recording, cause)
    kinds, bodies = np.asarray(ledger.kind, dtype=str), {*recording.names}
    # A body may be called `arm.left`, whose pushes are not those of the `arm`.
    whose = [target if target in bodies else owner(target) for target in map(str, ledger.target)]
    acted = np.isin(kinds, ("force", "torque")) & np.isin(np.array(whose, dtype=str), law.bodies)
    when = np.asarray(ledger.time)[acted]
    values = (
        np.asarray(ledger.value).reshape(len(kinds), -1) if len(kinds) else np.zeros((0, 3))
    )  # taken away, it pushes nobody
    force = values[acted][:, :3] * (kinds[acted] == "force")[:, None]
    order = np.argsort(when, kind="stable")
    upto = np.searchsorted(when[order], t - 1e-9)
    impulse = np.concatenate([np.zeros((1, 3)), np.cumsum(force[order] * step, axis=0)])
    work = np.concatenate([[0.0], np.cumsum(np.asarray(ledger.work_j)[acted][order])])
    pushed = float(_size(force).sum() * step)
    return LawBalance(
        law.name, law.named, t, given=impulse[upto], work=work[upto], pushed=pushed, gravity=gravity, **columns
    )


def _damaged(recording: Any, cause: str) -> RecordingError:
    move = "restore it as it was recorded, or run the physics pass again"
    return RecordingError(cause, place=str(recording.folder), next_move=move)

"""What an author's law gives and takes, held against the ledger: momentum, energy, mass and volume of its points.

The sums are computed from the points while the law runs (`worldkit.laws`); what its bodies were given is the engine's own ledger,
in which nobody else may push them. So a law that pushes without being pushed back shows here, and one that makes energy.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from .records import Interventions

Array = np.ndarray


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
    volume: Array
    """(F,) m^3; 0 where the law says none."""
    given: Array
    """(F, 3) N s: the impulse that bodies and what stands fast were given since the start."""
    work: Array
    """(F,) J: the work that it did on bodies since the start."""
    exchanged: float
    """N s: all impulses between points, bodies and gravity, as magnitudes."""
    gravity: Array
    """(3,) m/s^2."""

    @cached_property
    def from_nowhere(self) -> float:
        """The largest momentum that no force accounts for, as a share of what was exchanged."""
        weight = np.concatenate(
            [np.zeros((1, 3)), np.cumsum(self.mass[:-1, None] * self.gravity * np.diff(self.t)[:, None], axis=0)]
        )
        off = np.sqrt((((self.momentum - self.momentum[0]) + self.given - weight) ** 2).sum(axis=1))
        return float(off.max() / max(self.exchanged, 1e-12))

    @cached_property
    def total(self) -> Array:
        """(F,) J: its energy and the work that it did."""
        return self.energy + self.work

    @property
    def scale_j(self) -> float:
        """How far its energy and its work reach, J."""
        return float(max(np.ptp(self.energy), np.ptp(self.work), 1e-12))

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


def read(recording: Any, ledger: Interventions, gravity: Array) -> tuple[LawBalance, ...]:
    """The balances of a recording's laws; none where it has none, or where too little was recorded."""
    rows: Sequence[Mapping[str, Any]] = recording.meta.get("laws") or ()
    if not rows or len(recording.balances) < 2 * len(rows):
        return ()
    sums, step = recording.balances, float(recording.time_step)
    kinds, targets = np.asarray(ledger.kind, dtype=str), np.asarray(ledger.target, dtype=str)
    found = []
    for number, row in enumerate(rows):
        mine = np.asarray(sums.medium) == number
        t, bodies = np.asarray(sums.step)[mine] * step, tuple(map(str, row["bodies"]))
        acted = np.isin(kinds, ("force", "torque")) & np.isin(targets, bodies)
        when, force = (
            np.asarray(ledger.time)[acted],
            np.asarray(ledger.value)[acted][:, :3] * (kinds[acted] == "force")[:, None],
        )
        order = np.argsort(when, kind="stable")
        upto = np.searchsorted(when[order], t - 1e-9)
        impulse = np.concatenate([np.zeros((1, 3)), np.cumsum(force[order] * step, axis=0)])
        work = np.concatenate([[0.0], np.cumsum(np.asarray(ledger.work_j)[acted][order])])
        mass, held = np.asarray(sums.mass)[mine], np.asarray(sums.held)[mine]
        pushed = float(np.sqrt((force**2).sum(axis=1)).sum() * step)
        weight = float(mass.max() * np.sqrt((gravity**2).sum()) * (t[-1] - t[0]))
        found.append(
            LawBalance(
                name=str(row["law"]["name"]),
                bodies=bodies,
                t=t,
                mass=mass,
                momentum=np.asarray(sums.momentum)[mine],
                energy=np.asarray(sums.energy)[mine],
                volume=np.asarray(sums.volume)[mine],
                given=impulse[upto] + held - held[0],
                work=work[upto],
                exchanged=pushed + weight + float(np.sqrt((np.diff(held, axis=0) ** 2).sum(axis=1)).sum()),
                gravity=gravity,
            )
        )
    return tuple(found)

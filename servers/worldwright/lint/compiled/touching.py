"""Which bodies of a compiled world can touch, and with what friction, rebound and give: as the engine will have it.

Friction written on a geom need not be what acts: the larger of two counts, a higher priority outdoes both, an explicit pair
outdoes everything, exclusions and masks take a contact away. `Touching` applies these rules to the arrays of a model.

Source: MuJoCo manual, "Contact parameters" (how geoms mix) and "Collision detection" (which pairs are filtered); the tests
hold it against `mjData.contact`.
"""

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import product
from typing import Any

import numpy as np

GEOM = ("contype", "conaffinity", "condim", "priority", "solmix", "margin", "gap")
"""These numbers of a geom decide its contacts, with its friction, solref, solimp, surface velocity and adhesion."""
LEAST_FRICTION = 1e-5
"""The engine lets no coefficient be smaller (`mjMINMU`)."""
Ends = tuple[str, str]


@dataclass(frozen=True)
class Touch:
    """One way in which two bodies touch."""

    condim: int
    friction: tuple[float, ...]
    """(5,) two tangential coefficients, unitless; one torsional, two rolling, m."""
    solref: tuple[float, ...]
    solref_friction: tuple[float, ...]
    """With zeros, friction uses `solref`."""
    solimp: tuple[float, ...]
    margin: float
    gap: float
    """A contact is listed this far beyond the margin, m, and exerts nothing there."""
    adhesion: float
    surface: tuple[float, ...]
    """(12,) velocities of both surfaces, m/s and rad/s, each in the frame of its geom."""

    @property
    def acting(self) -> tuple[float, float, float, float]:
        """Two sliding coefficients, the torsional and the larger rolling one, as far as `condim` lets them act."""
        slide, across, spin, *roll = self.friction
        return (
            slide if self.condim >= 3 else 0.0,
            across if self.condim >= 3 else 0.0,
            spin if self.condim >= 4 else 0.0,
            max(roll) if self.condim >= 6 else 0.0,
        )

    def spring(self, time_step: float) -> tuple[float, float]:
        """(damping ratio, time constant in s) along the normal, from either format of `solref`."""
        first, second = self.solref
        if first > 0:
            return second, max(first, 2 * time_step) * max(second, 1e-6)
        stiffness = max(-first, 1e-9)
        return -second / (2 * stiffness**0.5), stiffness**-0.5


class Touching:
    """The contacts that a world allows, by the bodies that they are between.

    Args:
        view: the compiled world (arrays under the engine's names, `texts["names"]`).
        owner: gives the thing that a body belongs to, by its index; geoms of one owner are not compared.
    """

    def __init__(self, view: Any, owner: Callable[[int], str]) -> None:
        self.view = view
        self.owner = owner

    @cached_property
    def rows(self) -> np.ndarray:
        """(kinds, columns) the different geoms there are, as far as contacts are concerned."""
        return self._kinds[0]

    @cached_property
    def _kinds(self) -> tuple[np.ndarray, np.ndarray]:
        v, n = self.view, len(self.view.geom_bodyid)
        columns = [np.asarray(getattr(v, f"geom_{name}"), float).reshape(n, -1) for name in GEOM]
        more = (v.geom_friction, v.geom_solref, v.geom_solimp, v.geom_surfacevel, v.geom_adhesion)
        table = np.hstack([*columns, *(np.asarray(array, float).reshape(n, -1) for array in more)])
        if not n:
            return table, np.zeros(0, int)
        rows, kind = np.unique(table, axis=0, return_inverse=True)
        return rows, kind.reshape(-1)

    def kind(self, geom: int) -> int:
        """Which of `rows` a geom is of."""
        return int(self._kinds[1][geom])

    def is_paired(self, geom: int) -> bool:
        """Whether an explicit pair names a geom."""
        return geom in self.view.pair_geom1 or geom in self.view.pair_geom2

    @cached_property
    def geoms(self) -> dict[str, dict[int, Counter[int]]]:
        """The number of geoms of each kind on every body of an owner."""
        found: dict[str, dict[int, Counter[int]]] = {}
        for body, kind in zip(self.view.geom_bodyid.tolist(), self._kinds[1].tolist(), strict=True):
            found.setdefault(self.owner(body), {}).setdefault(body, Counter())[kind] += 1
        return found

    def signature(self, owner: str) -> frozenset[tuple[float, ...]]:
        """The numbers that decide an owner's contacts, apart from pairs, exclusions and joints."""
        kinds = {kind for counted in self.geoms.get(owner, {}).values() for kind in counted}
        return frozenset(tuple(self.rows[kind].tolist()) for kind in kinds)

    @cached_property
    def pairs(self) -> dict[Ends, list[tuple[int, int, int]]]:
        """Explicit pairs by the owners they are between: (index, geom, geom)."""
        found: dict[Ends, list[tuple[int, int, int]]] = {}
        v = self.view
        for index, (one, other) in enumerate(zip(v.pair_geom1.tolist(), v.pair_geom2.tolist(), strict=True)):
            ends = self.ends(*(self.owner(int(v.geom_bodyid[geom])) for geom in (one, other)))
            found.setdefault(ends, []).append((index, one, other))
        return found

    @cached_property
    def apart(self) -> frozenset[Ends]:
        """Owners between some of whose bodies contacts are excluded."""
        signatures = (int(s) for s in self.view.exclude_signature)
        return frozenset(self.ends(self.owner(s >> 16), self.owner(s & 0xFFFF)) for s in signatures)

    @staticmethod
    def ends(one: str, other: str) -> Ends:
        """Two owners in one order."""
        return (one, other) if one <= other else (other, one)

    def between(self, one: str, other: str) -> set[Touch]:
        """Every way in which two owners can touch."""
        view = self.view
        if view.contacts_off:
            return set()
        listed = self.pairs.get(self.ends(one, other), [])
        found = {self._paired(index) for index, _, _ in listed}
        taken = Counter(frozenset(pair) for pair in ((a, b) for _, a, b in listed))
        kinds, bodies = self._kinds[1], view.geom_bodyid
        held: Counter[tuple[int, int, int, int]] = Counter()
        for pair in taken:
            first, *rest = sorted(pair)
            second = rest[0] if rest else first
            for a, b in ((first, second), (second, first)):
                held[int(bodies[a]), int(kinds[a]), int(bodies[b]), int(kinds[b])] += 1
        for (a, of_a), (b, of_b) in product(self.geoms.get(one, {}).items(), self.geoms.get(other, {}).items()):
            if not self._may_meet(a, b):
                continue
            for (k, many), (m, more) in product(of_a.items(), of_b.items()):
                if many * more > held[a, k, b, m] and (touch := self._mixed(k, m)) is not None:
                    found.add(touch)
        return found

    def of_flex(self, flex: int, other: str) -> set[Touch]:
        """Every way in which a flex can touch the geoms of an owner; by the engine's rules it mixes as a geom does."""
        view = self.view
        if view.contacts_off:
            return set()
        columns = [np.ravel(getattr(view, f"flex_{name}")[flex]) for name in (*GEOM, "friction", "solref", "solimp")]
        row = np.concatenate([*columns, np.zeros(self.rows.shape[1] - sum(map(len, columns)))]).astype(float)
        kinds = {kind for counted in self.geoms.get(other, {}).values() for kind in counted}
        return {touch for kind in kinds if (touch := self._mix(row, self.rows[kind])) is not None}

    def of_geom(self, geom: int, other: str) -> set[Touch]:
        """Every way in which one geom can touch another owner: what `between` says of all of a body, said of a part."""
        view, listed = self.view, dict[int, int]()
        if view.contacts_off:
            return set()
        for index, (a, b) in enumerate(zip(view.pair_geom1.tolist(), view.pair_geom2.tolist(), strict=True)):
            if geom in (a, b):
                listed[b if a == geom else a] = index
        kinds, bodies, mine = self._kinds[1], view.geom_bodyid, int(view.geom_bodyid[geom])
        found = set[Touch]()
        for body in self.geoms.get(other, {}):
            for theirs in np.flatnonzero(bodies == body).tolist():
                if theirs in listed:
                    found.add(self._paired(listed[theirs]))
                elif self._may_meet(mine, body) and (touch := self._mixed(int(kinds[geom]), int(kinds[theirs]))):
                    found.add(touch)
        return found

    def _may_meet(self, a: int, b: int) -> bool:
        """Whether two bodies may meet: no part or carrier of each other, not both standing still, not excluded."""
        v = self.view
        weld_a, weld_b = int(v.body_weldid[a]), int(v.body_weldid[b])
        if weld_a == weld_b or (
            v.body_treeid[a] < 0 and v.body_treeid[b] < 0 and v.body_mocapid[a] < 0 > v.body_mocapid[b]
        ):
            return False
        if "filterparent" not in v.disabled and weld_a and weld_b:
            above = [int(v.body_weldid[v.body_parentid[weld]]) for weld in (weld_a, weld_b)]
            if above[0] == weld_b or above[1] == weld_a:
                return False
        return (min(a, b) << 16) + max(a, b) not in self._excluded

    @cached_property
    def _excluded(self) -> frozenset[int]:
        return frozenset(int(s) for s in self.view.exclude_signature)

    @lru_cache(maxsize=100_000)  # noqa: B019 (lives as long as one comparison)
    def _mixed(self, k: int, m: int) -> Touch | None:
        """The contact of two kinds of geoms, or None when their masks never match."""
        return self._mix(self.rows[k], self.rows[m])

    @staticmethod
    def _mix(one: np.ndarray, other: np.ndarray) -> Touch | None:
        """The same of their rows."""
        if not (int(one[0]) & int(other[1]) or int(other[0]) & int(one[1])):
            return None
        condim, friction, solref, solimp = 2, slice(7, 10), slice(10, 12), slice(12, 17)
        if one[3] != other[3]:
            above = one if one[3] > other[3] else other
            dim, mu, ref, imp = above[condim], above[friction], above[solref], above[solimp]
            sticks = above[23:].sum()
        else:
            dim, mu = max(one[condim], other[condim]), np.maximum(one[friction], other[friction])
            sticks, total = one[23:].sum() + other[23:].sum(), one[4] + other[4]
            share = one[4] / total if total >= 1e-15 else 0.5
            imp = share * one[solimp] + (1 - share) * other[solimp]
            both = one[solref][0] > 0 and other[solref][0] > 0
            ref = share * one[solref] + (1 - share) * other[solref] if both else np.minimum(one[solref], other[solref])
        mu = np.maximum(mu, LEAST_FRICTION)[[0, 0, 1, 2, 2]]
        surface = sorted((tuple(one[17:23].tolist()), tuple(other[17:23].tolist())))
        return Touch(
            int(dim),
            tuple(mu.tolist()),
            tuple(ref.tolist()),
            (0.0, 0.0),
            tuple(imp.tolist()),
            float(one[5] + other[5]),
            float(one[6] + other[6]),
            float(sticks),
            (*surface[0], *surface[1]),
        )

    def _paired(self, index: int) -> Touch:
        v = self.view
        geoms = (int(v.pair_geom1[index]), int(v.pair_geom2[index]))
        surface = sorted(tuple(np.ravel(v.geom_surfacevel[geom]).tolist()) for geom in geoms)
        return Touch(
            int(v.pair_dim[index]),
            tuple(np.maximum(v.pair_friction[index], LEAST_FRICTION).tolist()),
            tuple(v.pair_solref[index].tolist()),
            tuple(v.pair_solreffriction[index].tolist()),
            tuple(v.pair_solimp[index].tolist()),
            float(v.pair_margin[index]),
            float(v.pair_gap[index]),
            float(np.sum(v.pair_adhesion[index])),
            (*surface[0], *surface[1]),
        )

    def suspects(self, twin: "Touching") -> Iterator[str]:
        """The owners whose contacts may differ between the two worlds."""
        differing = {name for name in self.geoms if self.signature(name) != twin.signature(name)}
        for ends in {*self.pairs, *twin.pairs}:
            if {self._paired(i) for i, _, _ in self.pairs.get(ends, [])} != {
                twin._paired(i) for i, _, _ in twin.pairs.get(ends, [])
            }:
                differing |= set(ends)
        for ends in self.apart ^ twin.apart:
            differing |= set(ends)
        yield from sorted(differing & set(twin.geoms))

"""Drops that fly up where something strikes the water, fall back, and return their volume and momentum.

They carry a part of what the impact leaves over (`afloat`), a ring of them around what goes in: first quick and flat, then slower
and steep, as the crown of a splash is (Cossali, Coghe, Marengo, "The impact of a single drop", Exp. Fluids 1997, for its order).
"""

import numpy as np

from .body_of_water import Water

SHARE = 0.35
"""Of what an impact leaves over, the part that flies."""
LEAST_SPEED = 0.6
"""m/s: what goes in more slowly sends no drop up."""
SIZE, SMALLEST, LARGEST = 0.055, 0.0006, 0.009
"""Radius of a drop over the half width of what goes in; and its limits, m."""
SPREAD = 0.45
"""Of the logarithm of their sizes."""
AIR = 1.2
Array = np.ndarray


class Spray:
    """The drops of one container, at most B.

    Args:
        water: that they come from and fall into.
        beads: B.
    """

    def __init__(self, water: Water, beads: int) -> None:
        self._water, self.beads = water, beads
        self._rng = np.random.default_rng(20)
        self.place, self.speed, self.radius = np.zeros((beads, 3)), np.zeros((beads, 3)), np.zeros(beads)
        """(B, 3) m, (B, 3) m/s, (B,) m; of one that does not fly the radius is 0."""
        self.spilt = 0.0
        """m^3: what fell beside the water."""
        self._debt = np.zeros(len(water.hulls.bodies))
        self._flung = np.zeros(len(water.hulls.bodies))

    @property
    def volumes(self) -> Array:
        """(B,) m^3."""
        return np.asarray(4 / 3 * np.pi * self.radius**3)

    def fling(
        self, body: int, work: float, middle: Array, half: float, speed: Array, against: float, under: float
    ) -> None:
        """Let drops fly from what a body's impact left over.

        Args:
            body: which of the bodies.
            work: what is left over in this step, J.
            middle: (2,) m, where it goes in.
            half: its half width, m.
            speed: (3,) m/s, its own.
            against: its speed through the surface, m/s.
            under: the share of it that is under water.
        """
        if under < 1e-6:
            self._debt[body] = self._flung[body] = 0.0
        if against < LEAST_SPEED or work <= 0:
            return
        self._debt[body] += SHARE * work
        density, idle = self._water.liquid.density, np.flatnonzero(self.radius == 0)
        room = self.beads * min(1.0, 1.2 * under + 0.05) - self._flung[body]
        for bead in idle[: max(0, int(room))]:
            radius = SIZE * half * float(np.exp(SPREAD * self._rng.standard_normal()))
            radius = float(np.clip(radius, SMALLEST, LARGEST))
            late = min(1.0, under)
            quick = against * (0.85 - 0.35 * late) * float(self._rng.uniform(0.45, 1.25))
            cost = 0.5 * density * 4 / 3 * np.pi * radius**3 * quick**2
            if cost > self._debt[body]:
                break
            self._debt[body] -= cost
            self._flung[body] += 1
            turn = float(self._rng.uniform(0, 2 * np.pi))
            steep = np.radians(52 + 26 * late + 7 * float(self._rng.standard_normal()))
            out = np.array([np.cos(turn), np.sin(turn)])
            self.radius[bead] = radius
            self.place[bead, :2] = middle + out * half * (0.75 + 0.45 * late)
            self.place[bead, 2] = self._water.level + 0.2 * half
            self.speed[bead, :2] = out * quick * np.cos(steep) + 0.35 * speed[:2]
            self.speed[bead, 2] = quick * np.sin(steep)
            mass = density * 4 / 3 * np.pi * radius**3
            one = self.place[bead : bead + 1, :2]
            self._water.pour(one, np.array([-mass / density]), np.array([mass * self.speed[bead, 2]]))

    def advance(self, seconds: float) -> None:
        """Let them fly on, and those that come down return."""
        flying = np.flatnonzero(self.radius > 0)
        if not len(flying):
            return
        v, r = self.speed[flying], self.radius[flying]
        fast = np.sqrt((v**2).sum(axis=1))
        brake = 3 / 8 * AIR / self._water.liquid.density * 0.5 / r * fast
        v = v / (1 + brake * seconds)[:, None]
        v[:, 2] -= self._water.gravity * seconds
        self.speed[flying] = v
        self.place[flying] += v * seconds
        cells, weights, _ = self._water.grid.around(self.place[flying, :2])
        over = weights.any(axis=1)
        surface = self._water.level + (weights * self._water.fields[0][cells]).sum(axis=1)
        low = (self.place[flying, 2] < surface) & (v[:, 2] < 0)
        down, beside = flying[low & over], flying[low & ~over & (self.place[flying, 2] < self._water.level - 0.05)]
        volume = self.volumes
        if len(down):
            falls = -self.speed[down, 2] * self._water.liquid.density * volume[down]
            self._water.pour(self.place[down, :2], volume[down], falls)
        self.spilt += float(volume[beside].sum())
        for gone in (down, beside):
            self.radius[gone], self.speed[gone] = 0.0, 0.0

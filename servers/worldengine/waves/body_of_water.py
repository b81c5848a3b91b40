"""Water in a container: its waves, and the forces between it and what floats in it, falls into it or sinks.

What a body displaces is put on the surface as volume, spread as a source at its depth spreads it; so water rises by what is under
it, and what falls in sends rings out. The same spreading, read backwards, is the surface that the body feels, and the pressure of
water is rho g (surface felt - height): Archimedes at a wavy level, with what rights a leaning body. Both together keep energy:

    E = rho/2 <phi, G phi> + rho/2 <eta, r eta> + rho g sum V (I - eta s),   I the integral of the share s under water

Water that has to get out of the way goes with the body (added mass, half of what a sphere displaces), which is reckoned with in the
same step, so that a cork does not jump. When a body gets wet, that mass is set going: von Karman's impact; half of the work goes
into the spray.
Source: Newman, Marine Hydrodynamics (1977), sections 4.16 and 6.18 (Haskind); von Karman, NACA TN 321 (1929); Cummins, "The impulse
response function and ship motions" (1962).
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from . import standing_waves
from .gravity_waves import Airy, ruffled
from .hull_samples import Hulls
from .wet_grid import WetGrid

if TYPE_CHECKING:
    pass

LAYERS = 4
"""Depths at which the waves are felt; between two of them on the straight line."""
NEAR = 0.75
"""What a geom displaces is spread at least as from so many of its half widths deep, or it would lift itself."""
ADDED = 0.5
"""Added mass over displaced mass (Lamb, section 92: a sphere)."""
SHORT = 0.12
"""Of the shortest wave's omega: how quickly it dies, 1/s for each; it is the grid's."""
Array = np.ndarray


@dataclass(frozen=True)
class Liquid:
    """What fills a container."""

    density: float
    """kg/m^3."""
    viscosity: float = 1.0e-3
    """Pa s."""
    tension: float = 0.0728
    """N/m."""


class Water:
    """The water of one container.

    Args:
        grid: its surface.
        level: its height at rest, m.
        depth: on the mean, m.
        liquid: what it is.
        hulls: the bodies in it.
        gravity: m/s^2, downwards.
    """

    def __init__(self, grid: WetGrid, level: float, depth: float, liquid: Liquid, hulls: Hulls, gravity: float) -> None:
        self.grid, self.level, self.depth, self.liquid, self.hulls, self.gravity = (
            grid, level, depth, liquid, hulls, gravity,
        )  # fmt: skip
        self.waves = standing_waves.of(grid)
        self.airy = Airy(gravity, depth, liquid.tension / liquid.density)
        k = self.waves.k
        self._lift, self._pull, self._omega = self.airy.lift(k), self.airy.restoring(k), self.airy.frequency(k)
        self._dies = self._damping(k)
        smallest = float(hulls.size.min()) if len(hulls.size) else 0.1
        first = max(NEAR * smallest, float(grid.cell.max()))
        last = max(2 * first, min(depth, 16 * first))
        self.layers = np.geomspace(first, last, LAYERS)
        """(J,) m under the level at rest."""
        self._felt = np.stack([self.airy.below(d, k) for d in self.layers])
        self.height, self.potential = np.zeros(len(k)), np.zeros(len(k))
        """Shares of the standing waves in eta, m, and in phi, m^2/s."""
        self._laid = np.zeros((LAYERS, grid.size))
        self._pushed = np.zeros((LAYERS, grid.size))
        self._poured = np.zeros(grid.size)
        self._any_push = False
        self.fields = np.zeros((LAYERS, grid.size))
        """(J, C) m: the surface as felt at each layer."""
        self.rising = np.zeros((LAYERS, grid.size))
        """(J, C) m/s: how fast that rises."""
        self._begun, self._stored = 0.0, 0.0
        self._turn: tuple[float, tuple[Array, Array, Array]] | None = None
        self._spread_at = np.clip(NEAR * hulls.size, first, None)

    def _damping(self, k: Array) -> Array:
        """How quickly each wave dies, 1/s: in the water (Lamb, section 348), under the film that water outdoors has (351), at floor and
        walls (Keulegan 1959), and at the grid's end.
        """
        nu = self.liquid.viscosity / self.liquid.density
        along = np.sqrt(np.maximum(nu * self._omega / 2, 0.0))
        round_it = 2 * np.sqrt(np.pi / self.grid.area)  # of a round container: wall over area
        floor = 2 * k / np.sinh(np.clip(2 * k * self.depth, 1e-9, 50.0))
        rubbed = along * (round_it + floor) / 2
        film = k * np.sqrt(nu * self._omega) / (2 * np.sqrt(2))
        grid = SHORT * self._omega * (k / k.max()) ** 4
        found = 2 * nu * k * k + film + rubbed + grid
        found[0] = 0.0
        return np.asarray(found)

    def ruffle(self, wind: float, seed: int) -> None:
        """Begin with the waves that a wind, m/s, has raised."""
        k, rng = self.waves.k, np.random.default_rng(seed)
        spectrum = ruffled(k, wind, float(np.sqrt(self.grid.area)), self.gravity)
        # A standing wave has a cell of (pi / L)^2 of the wave number's quarter plane; <e^2> over the water is 1.
        cell = np.pi**2 / self.grid.area
        size = np.sqrt(np.maximum(4 * spectrum * cell / 4, 0.0) * self.grid.area)
        size[0] = 0.0
        tame = np.exp(-((k / (0.5 * k.max())) ** 2))
        turn = rng.uniform(0, 2 * np.pi, len(k))
        strength = size * tame * np.sqrt(rng.exponential(1.0, len(k)) * 2)
        self.height += strength * np.cos(turn)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.where(self._lift > 0, self._omega / np.maximum(self._lift, 1e-12), 0.0)
        self.potential += strength * ratio * np.sin(turn)
        self.look_around(0.0)

    def weigh(self, points: Array) -> "Felt":
        """What each lump at points (L, 3) feels of the water."""
        cells, weights, slopes = self.grid.around(points[:, :2])
        below = self.level - points[:, 2]
        at = np.clip(np.maximum(below, self._spread_at), self.layers[0], self.layers[-1])
        upper = np.clip(np.searchsorted(self.layers, at, side="right") - 1, 0, LAYERS - 2)
        gap = self.layers[upper + 1] - self.layers[upper]
        share = (at - self.layers[upper]) / gap
        first, second = self.fields[upper[:, None], cells], self.fields[upper[:, None] + 1, cells]
        both = first + share[:, None] * (second - first)
        surface = np.einsum("lc,lc->l", weights, both)
        tilt = np.einsum("lc,lci->li", both, slopes)
        fainter = np.where((below > self._spread_at) & (below < self.layers[-1]), 1.0, 0.0)
        deep = np.einsum("lc,lc->l", weights, second - first) / gap * -fainter
        wet = weights.any(axis=1) & (below < self.depth + self.hulls.rise)
        s, integral = self.hulls.under(below + surface)
        rise = self.rising[upper[:, None], cells]
        rise = rise + share[:, None] * (self.rising[upper[:, None] + 1, cells] - rise)
        up = np.einsum("lc,lc->l", weights, rise)
        return Felt(cells, weights, upper, share, surface, np.column_stack([tilt, deep]), s * wet, integral * wet, up)

    def push(self, felt: "Felt", impulse: Array) -> None:
        """Push the water down by an impulse at each lump (L,), N s, which it takes up at its next step."""
        self._any_push = True
        self._pushed += self._scatter(felt, impulse)

    def pour(self, points: Array, volume: Array, impulse: Array) -> None:
        """Let small volumes (n,), m^3, with downward impulses (n,), N s, into the surface at points (n, 2); or take them out."""
        cells, weights, _ = self.grid.around(points)
        for what, amount in ((self._poured, volume), (self._pushed[0], impulse)):
            what += np.bincount(cells.ravel(), (weights * amount[:, None]).ravel(), minlength=self.grid.size)
        self._any_push = True

    def begin(self, felt: "Felt") -> None:
        """Take the level as it is with the bodies where they are."""
        self._laid = self._scatter(felt, felt.share_under * self.hulls.volume)
        self._begun = float(self._laid.sum())

    def advance(self, felt: "Felt", seconds: float) -> None:
        """Let the waves go on, with the bodies as they are felt now."""
        laid = self._scatter(felt, felt.share_under * self.hulls.volume)
        gained = laid - self._laid
        gained[0] += self._poured
        self._poured[:] = 0.0
        self._laid = laid
        total = self.height[0] + gained.sum() / np.sqrt(self.grid.area)
        self.height += (self.waves.shares(gained) * self._felt).sum(axis=0)
        self.height[0] = total
        if self._any_push:
            impulse = (self.waves.shares(self._pushed) * self._felt).sum(axis=0) / self.liquid.density
            impulse[0] = 0.0
            self.potential -= impulse
            self._pushed[:], self._any_push = 0.0, False
        cos, lifted, pulled = self._turned(seconds)
        height = self.height * cos + self.potential * lifted
        self.potential = self.potential * cos - self.height * pulled
        height[0], self.potential[0] = self.height[0], 0.0
        self.height = height
        self.look_around(seconds)

    def _turned(self, seconds: float) -> "tuple[Array, Array, Array]":
        """By how much each wave turns and fades in a step, which mostly is as long as the last one."""
        if self._turn is None or self._turn[0] != seconds:
            turn, fade = self._omega * seconds, np.exp(-self._dies * seconds)
            cos, sin = np.cos(turn) * fade, np.sin(turn) * fade
            speed = np.maximum(self._omega, 1e-12)
            self._turn = (seconds, (cos, sin * self._lift / speed, sin * self._pull / speed))
        return self._turn[1]

    def look_around(self, seconds: float) -> None:
        """Bring what is felt at each layer up to date."""
        fields = self.waves.heights(self._felt * self.height)
        if seconds > 0:
            self.rising = (fields - self.fields) / seconds
        self.fields = fields
        self._stored = 0.5 * float((self._lift * self.potential**2 + self._pull * self.height**2).sum())

    def surface(self) -> Array:
        """(C,) m: the height of the surface over its level at rest, in each cell."""
        return self.waves.heights(self.height[None])[0]

    @property
    def laid(self) -> float:
        """m^3: what bodies displaced at the last step, less that at the start."""
        return float(self._laid.sum()) - self._begun

    @property
    def waiting(self) -> float:
        """m^3: what was taken out for drops since the last step, less what came back; it is taken from the surface at the next."""
        return -float(self._poured.sum())

    @property
    def swell(self) -> float:
        """m^3: the volume above the level at rest, less what lies below it."""
        return float(self.height[0] * np.sqrt(self.grid.area))

    def energy(self, felt: "Felt") -> float:
        """J: of the waves, and by the weight of what bodies displace."""
        buoyant = self.gravity * (self.hulls.volume * (felt.integral - felt.surface * felt.share_under)).sum()
        return float(self.liquid.density * (self._stored + buoyant))

    def _scatter(self, felt: "Felt", amounts: Array) -> Array:
        """(J, C): amounts (L,) laid on the cells of the layers, as `weigh` reads them."""
        out = np.zeros((LAYERS, self.grid.size))
        flat = out.reshape(-1)
        for layer, part in ((felt.upper, 1.0 - felt.share), (felt.upper + 1, felt.share)):
            where = (layer[:, None] * self.grid.size + felt.cells).ravel()
            flat += np.bincount(where, ((part * amounts)[:, None] * felt.weights).ravel(), minlength=flat.size)
        return out


@dataclass(frozen=True)
class Felt:
    """What lumps feel of the water; L of them."""

    cells: Array
    weights: Array
    """(L, 4)."""
    upper: Array
    share: Array
    """(L,) the layer above, and how far each is on the way to the next."""
    surface: Array
    """(L,) m over the level at rest."""
    slope: Array
    """(L, 3) of that."""
    share_under: Array
    integral: Array
    """(L,) and m."""
    up: Array
    """(L,) m/s: how fast the surface felt rises."""

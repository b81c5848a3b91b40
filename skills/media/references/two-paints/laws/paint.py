"""Two paints, poured on a tilted canvas, that run down and blend: a film of height h on a grid, by lubrication.

Gravity draws it down the slope and levels it, h cubed over the viscosity. What the pigments take from light (the logarithm of a
colour) goes with the volume, so that yellow and blue make green. Points of the grid stay; their heights, masses, velocities and
colours change. Paint that still waits is the mass of the first ring of its stream; a stream itself is drawn only.
"""

import numpy as np
from scipy.ndimage import gaussian_filter

from worldkit import moved_shapes

TILT, MIDDLE = np.radians(14.0), (0.0, -0.00242, 0.05911)  # of the canvas, and the middle of its upper side, m
ACROSS, DOWN, CELL = 96, 76, 0.004  # cells across the canvas and down it, m
DRY, SUNK = 2e-4, 3e-4  # m too thin to flow; m by which it is drawn lower
MINGLES, FINER = 2e-7, 2  # m^2/s between colours that touch; steps in a step
SPOUTS, HIGH, WIDE = 2, 0.25, 0.006  # streams; m above the canvas; m, the radius of each
RINGS, AROUND = 12, 8  # of the tube that shows one
POURED, RATE, SPOT = 3.0, 20e-6, 0.01  # s; m^3/s each; m where it lands
INKS = ((1.0, 0.78, 0.03), (0.03, 0.20, 0.62))  # yellow, blue
LOST = -np.log(np.maximum(INKS, 0.03)) * 2.2  # of light, of each colour; of a mixture, the mean by volume
X, Y = ((np.arange(n) - (n - 1) / 2) * CELL for n in (ACROSS, DOWN))
TURN = 2 * np.pi * np.arange(AROUND) / AROUND
RING = np.stack([np.cos(TURN), np.sin(TURN), 0 * TURN], axis=1)


class Paint:
    """A film of height h on a tilted canvas, by lubrication, with what its pigments take from light; streams pour it."""

    name, bodies, shown_by = "paint", ("world",), "film"

    def __init__(self, viscosity, density):
        self.viscosity, self.density = viscosity, density  # Pa s, kg/m^3
        self.gravity, self.middle = np.array([0.0, 0.0, -9.81]), np.array(MIDDLE)
        self.turn = np.array([[1, 0, 0], [0, np.cos(TILT), -np.sin(TILT)], [0, np.sin(TILT), np.cos(TILT)]])
        self.triangles = self.faces()
        self.film = np.zeros((4, DOWN, ACROSS))  # h, m, and h times what is lost of red, green and blue
        self.flow, self.time, self.left = np.zeros((2, DOWN, ACROSS)), 0.0, np.full(SPOUTS, RATE * POURED)
        weave = gaussian_filter(np.random.default_rng(5).normal(size=(DOWN, ACROSS)), 5.0)
        self.eased = np.clip(1 + 0.35 * weave / weave.std(), 0.3, 1.7)  # it goes more easily here than there
        self.leaves = RATE / (np.pi * WIDE**2)  # m/s
        self.falls = self.falling(HIGH)
        self.tell()

    def faces(self):  # of the film, and of the tubes of the streams
        one = (np.arange(DOWN - 1)[:, None] * ACROSS + np.arange(ACROSS - 1)).ravel()
        cells = [np.stack([one, one + 1, one + ACROSS], 1), np.stack([one + 1, one + ACROSS + 1, one + ACROSS], 1)]
        tube, first = np.array(moved_shapes.tube(RINGS, AROUND)), ACROSS * DOWN
        return np.concatenate([*cells, *(tube + first + n * RINGS * AROUND for n in range(SPOUTS))])

    def start(self, model, data):
        canvas = data.geom("canvas")  # not the body, which stays level where the plan tilts the shape (deg_x)
        self.gravity, self.turn = model.opt.gravity, canvas.xmat.reshape(3, 3).copy()
        self.middle = canvas.xpos + self.turn @ (0, 0, model.geom("canvas").size[2])
        self.tell()

    def step(self, model, data, seconds):
        pull, before = self.turn.T @ self.gravity, self.momentum
        for _ in range(FINER):
            self.pour(seconds / FINER)
            self.carry(seconds / FINER, self.spread(seconds / FINER, pull))
            self.time += seconds / FINER
        self.tell()
        return [self.mass.sum() * self.gravity - (self.momentum - before) / seconds]  # what is left of its weight

    def pour(self, dt):
        for spout, (x, y) in enumerate(self.spouts(self.time - self.falls) if self.time > self.falls else ()):
            gone = min(RATE * dt, self.left[spout])
            spot = np.exp(-((((X - x) ** 2 + (Y[:, None] - y) ** 2) / SPOT**2) ** 3))  # nearly a disc
            self.left[spout] -= gone
            inks = np.concatenate([[1.0], LOST[spout]])
            self.film += inks[:, None, None] * spot * (gone / CELL**2 / spot.sum())

    def spread(self, seconds, pull):
        h, gone, thins = self.film[0].copy(), [0.0, 0.0], self.density / (3 * self.viscosity)
        while seconds > 1e-12:  # as small a step as the thickest film needs
            flows = 1.7 * thins * h.max() ** 2 / CELL
            dt = min(seconds, 0.7 / (flows * (4 * abs(pull[2]) * h.max() / CELL + 6 * abs(pull[1])) + 1e-9))
            seconds, before, h = seconds - dt, h, h.copy()
            for axis in (0, 1):
                there, change, eased = (a.T if axis else a for a in (before, h, self.eased))
                low, top = there[:, :-1], there[:, 1:]
                drive = thins * eased[:, :-1] * (pull[axis] + pull[2] / CELL * (top - low))
                goes = np.where(drive > 0, low, top)
                flux = dt / CELL * drive * np.where(goes > DRY, goes * goes * goes, 0)
                change[:, :-1] -= flux
                change[:, 1:] += flux
                gone[axis] = gone[axis] + flux
        return gone

    def carry(self, seconds, gone):
        colour, new = self.film / np.maximum(self.film[0], 1e-12), self.film.copy()
        for axis, moved in enumerate(gone):
            h, c, change = (np.swapaxes(a, -1, -2) if axis else a for a in (self.film[0], colour, new))
            steps, bend = (
                np.diff(c),
                np.zeros_like(c),
            )  # colours keep their edges: as steep in a cell as its sides let it (superbee)
            a, b = steps[..., :-1], steps[..., 1:]
            small, large = np.minimum(abs(a), abs(b)), np.maximum(abs(a), abs(b))
            bend[..., 1:-1] = np.where(a * b > 0, np.sign(a) * np.minimum(2 * small, large), 0) / 2
            carried = moved * np.where(moved > 0, (c + bend)[..., :-1], (c - bend)[..., 1:])
            carried -= MINGLES * seconds / CELL**2 * np.minimum(h[:, :-1], h[:, 1:]) * steps
            change[..., :-1] -= carried
            change[..., 1:] += carried
            mean = CELL / seconds * (np.pad(moved, ((0, 0), (1, 0))) + np.pad(moved, ((0, 0), (0, 1)))) / 2
            self.flow[axis] = mean.T if axis else mean
        self.film = new

    def spouts(self, time):
        one, time = np.arange(SPOUTS), np.asarray(time)[..., None]
        x = 0.1 * (one - (SPOUTS - 1) / 2) + 0.06 * np.sin(2.6 * time + np.pi * one)
        return np.stack([x, 0.10 + 0.02 * np.cos(3.1 * time + one)], axis=-1)

    def sways(self, time):  # m/s
        one = np.arange(SPOUTS)
        return np.stack([0.156 * np.cos(2.6 * time + np.pi * one), -0.062 * np.sin(3.1 * time + one)], axis=-1)

    def falling(self, drop):
        pulls = -self.gravity[2]
        return (np.sqrt(self.leaves**2 + 2 * pulls * drop) - self.leaves) / pulls

    def tell(self):
        flat = np.stack([*np.meshgrid(X, Y), gaussian_filter(self.film[0], 1) - SUNK], axis=-1).reshape(-1, 3)
        crisp = gaussian_filter(self.film, (0, 0.6, 0.6))
        inks = (crisp[1:] / np.maximum(crisp[0], 1e-9)).reshape(3, -1).T
        points, colours = [self.middle + flat @ self.turn.T], [inks]
        ends = [
            np.clip(self.leaves * t - self.gravity[2] / 2 * t**2, 0, HIGH)
            for t in np.maximum((self.time - POURED, self.time), 0)
        ]
        drop = np.linspace(*ends, RINGS)
        wide = WIDE * (1 + 2 * -self.gravity[2] * drop / self.leaves**2) ** -0.25 * (ends[0] < ends[1])
        left = self.spouts(self.time - self.falling(drop))
        for spout in range(SPOUTS):
            rings = self.middle + left[:, spout] @ self.turn[:, :2].T + (HIGH - drop)[:, None] * (0, 0, 1)
            points.append((rings[:, None] + wide[:, None, None] * RING).reshape(-1, 3))
            colours.append(np.tile(LOST[spout], (RINGS * AROUND, 1)))
        self.points, self.colours = np.concatenate(points), np.exp(-np.concatenate(colours) / 2.2)
        self.mass, self.velocities = np.zeros(len(self.points)), np.zeros((len(self.points), 3))
        cells, waits = ACROSS * DOWN, ACROSS * DOWN + np.arange(SPOUTS)[:, None] * RINGS * AROUND + np.arange(AROUND)
        self.mass[:cells] = self.density * CELL**2 * self.film[0].ravel()
        self.mass[waits] = self.density * self.left[:, None] / AROUND  # in its can, at the top of its stream
        self.velocities[:cells] = (self.flow / np.maximum(self.film[0], DRY)).reshape(2, -1).T @ self.turn[:, :2].T
        self.velocities[waits] = (self.sways(self.time) @ self.turn[:, :2].T)[:, None]
        self.momentum = self.mass @ self.velocities

    def energy(self):
        swayed = (self.sways(self.time) ** 2).sum(axis=1)  # by a hand, out of what it has in store
        return -self.density / 2 * self.left @ swayed  # what its weight gives, its thickness takes

    def volume(self):
        return CELL**2 * self.film[0].sum() + self.left.sum()

"""A rubber band round two pegs."""

import numpy as np

from worldkit import moved_shapes

PIECES, AROUND, FINER = 64, 8, 48  # along it, around it, steps within one
RADIUS, PEG, APART, HIGH = (
    0.0012,
    0.008,
    0.06,
    0.05,
)  # m: half its thickness; the pegs, their distance, the height of their grooves
LEFT = (-0.06, 0.0)  # m: the peg that stands fast
TIGHT = 1.04  # how much it is stretched when it lies round both
DAMPING, WALL, GROOVE = 0.02, 4.0e3, 200.0  # N s/m of each piece; N/m into a peg, and along it
ROUND = PEG + RADIUS
AREA, REST = np.pi * RADIUS**2, (2 * np.pi * ROUND + 2 * APART) / TIGHT / PIECES
TURN = 2 * np.pi * np.arange(AROUND) / AROUND


def loop():
    """(PIECES, 3) m: round both pegs, at even steps along its way."""
    half, apart = np.pi * ROUND, APART
    s = np.linspace(0, 2 * (half + apart), PIECES, endpoint=False)
    x, y = np.zeros(PIECES), np.zeros(PIECES)
    for first, middle, turn in ((0.0, apart, -np.pi / 2), (half + apart, 0.0, np.pi / 2)):
        on = (s >= first) & (s < first + half)
        angle = turn + (s[on] - first) / ROUND
        x[on], y[on] = middle + ROUND * np.cos(angle), ROUND * np.sin(angle)
        off = (s >= first + half) & (s < first + half + apart)
        gone = s[off] - first - half
        x[off], y[off] = (apart - gone, ROUND) if turn < 0 else (gone, -ROUND)
    return np.stack([x + LEFT[0], y + LEFT[1], np.full(PIECES, HIGH)], axis=1)


class Band:
    """A closed chain of neo-Hookean pieces, which slides on both pegs, told as the rings of a tube that thins as it stretches."""

    name, bodies, shown_by = "band", ("peg_left", "peg_right"), "rubber"

    def __init__(self, shear, rubber_density):
        self.shear, self.piece = shear, rubber_density * AREA * REST  # Pa, kg
        self.triangles = moved_shapes.tube(PIECES + 1, AROUND)
        self.x = loop()
        self.v = np.zeros_like(self.x)
        self.mass = np.repeat(np.r_[np.full(PIECES, self.piece), 0.0] / AROUND, AROUND)  # the last ring is the first
        self.tell()

    def start(self, model, data):
        self.gravity = model.opt.gravity

    def step(self, model, data, seconds):
        pegs, given, h = [data.body(one).xpos for one in self.bodies], np.zeros((2, 3)), seconds / FINER
        for _ in range(FINER):
            away = np.roll(self.x, -1, axis=0) - self.x
            length = np.linalg.norm(away, axis=1, keepdims=True)
            stretch, along = length / REST, away / length
            slower = ((np.roll(self.v, -1, axis=0) - self.v) * along).sum(axis=1, keepdims=True)
            pull = along * (AREA * self.shear * (stretch - stretch**-2) + DAMPING * slower)
            force = self.piece * self.gravity + pull - np.roll(pull, 1, axis=0)
            for peg, at in enumerate(pegs):
                push = self.pushed(at)
                force += push
                given[peg] -= push.sum(axis=0) / FINER
            self.v = self.v + h / self.piece * force
            self.x = self.x + h * self.v
        self.tell()
        return given

    def pushed(self, at):
        out = self.x[:, :2] - at[:2]
        far = np.linalg.norm(out, axis=1)
        deep = np.maximum(ROUND - far, 0.0)
        push = np.zeros_like(self.x)
        push[:, :2] = out * (WALL * deep / far)[:, None]
        push[:, 2] = np.where(deep > 0, GROOVE * (HIGH - self.x[:, 2]), 0.0)
        return push

    def tell(self):
        ahead, behind = np.roll(self.x, -1, axis=0), np.roll(self.x, 1, axis=0)
        self.stretch = np.linalg.norm(ahead - self.x, axis=1) / REST
        thin = ((self.stretch + np.roll(self.stretch, 1)) / 2) ** -0.5
        along = (ahead - behind) / np.linalg.norm(ahead - behind, axis=1, keepdims=True)
        aside = np.cross(along, (0.0, 0.0, 1.0))
        aside /= np.linalg.norm(aside, axis=1, keepdims=True)
        up = np.cross(aside, along)
        ring = np.cos(TURN)[:, None] * aside[:, None] + np.sin(TURN)[:, None] * up[:, None]
        rings = self.x[:, None] + RADIUS * thin[:, None, None] * ring
        self.points = np.concatenate([rings, rings[:1]]).reshape(-1, 3)
        self.velocities = np.repeat(np.concatenate([self.v, self.v[:1]]), AROUND, axis=0)

    def energy(self):
        return AREA * REST * self.shear / 2 * (self.stretch**2 + 2 / self.stretch - 3).sum()

"""Two balls that fall, recorded, and films of them, for tests of how a film is drawn."""

import numpy as np

from small_worlds import ball, empty, floor, lay_film, record
from worldengine.film import described, motion_facts
from worldengine.film.directed import Screening
from worldkit import portable
from worldkit.filming import Film, Recorded

SIZE = (96, 54)


def world():
    """Two balls over a floor; the first is red and changes its colour while it falls."""
    spec = empty()
    floor(spec)
    ball(spec, "first", (0, 0, 0.6), rgba=(0.8, 0.1, 0.1, 1))
    ball(spec, "second", (0.5, 0, 0.4), rgba=(0.1, 0.1, 0.8, 1))
    spec.worldbody.add_camera(name="side", pos=(0, -3, 0.5), xyaxes=(1, 0, 0, 0, 0, 1))
    return spec


class Made:
    """A recorded world, and films of it."""

    def __init__(self, folder):
        self.folder = folder
        spec = world()

        def glow(model, data):
            model.geom_rgba[model.geom("second").id, 0] = min(1.0, data.time)

        self.recording = record(spec, folder / "trajectory", 500, glow)
        portable.write(world(), folder / "world.mjz")
        self.plain = portable.read(folder / "world.mjz")
        facts = {"fps": 24, "size": list(SIZE), "movers": ["first", "second"]}
        motion_facts.write(self.recording, folder / "motion.npz", facts)
        with np.load(folder / "motion.npz") as arrays:
            self.seen = Recorded(dict(arrays))

    def film(self, tell, change=None):
        film = Film(self.seen)
        tell(film)
        lay_film(self.folder, film, change)
        return described.read(self.folder, self.recording)

    def screening(self, tell):
        return Screening(self.folder / "world.mjz", self.plain, self.recording, self.film(tell), SIZE, 24)

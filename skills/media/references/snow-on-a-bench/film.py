"""A still camera before the bench, level with it: it snows, and the slats whiten; then near, what lies on them."""

import numpy as np

from worldkit.filming import Film, along


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("snow_field", facing_deg=-105, hour="overcast")
    film.surface("snow_skin", of="snow", look="snow", smooth=2)
    chance = np.random.default_rng(3)
    count = 900
    first = chance.uniform((-3, -1.3, 0), (3, 6, 3.2), (count, 3))
    first = first[(first[:, 1] > 0.5) | (np.abs(first[:, 0]) > 0.75) | (first[:, 1] < -0.35)]
    phase, wide = chance.uniform(0, 6.28, len(first)), chance.uniform(0.01, 0.05, len(first))
    fall = chance.uniform(1.0, 1.4, len(first))
    size = chance.uniform(0.005, 0.013, len(first))

    def flakes(times):
        t = np.asarray(times)[:, None]
        z = np.mod(first[None, :, 2] - fall * t, 3.2)
        x = first[None, :, 0] + wide * np.sin(2.5 * t + phase)
        y = first[None, :, 1] + wide * np.cos(2.1 * t + phase)
        return np.stack([x, y, z], -1), np.broadcast_to(size, z.shape)

    film.particles("falling snow around", flakes, diameter=0.01, look="#f4f6f8")
    eye = along([(-0.75, -2.6, 0.95), (-0.62, -2.2, 0.92)], (0.0, 0.06, 0.56), lens_mm=50, focus=2.4, aperture=5.6)
    film.shot(eye, until=film.recorded.duration, speed=0.8)

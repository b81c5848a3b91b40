"""In the preview light comes through leaves, and the ground below a lamp gives back some of what the lamp gives it."""

import numpy as np
import pytest

from small_worlds import ball, empty, floor, lay_film, record
from worldengine.film import described, motion_facts
from worldengine.film.directed import Screening
from worldkit import portable
from worldkit.filming import Film, Recorded, Surface, still
from worldkit.materials import look

SIZE = (96, 54)
pytestmark = pytest.mark.gl


@pytest.fixture(scope="module")
def world(tmp_path_factory):
    """A ball out of sight, and what draws the first frame of a film of it: brightness (H, W)."""
    folder, spec = tmp_path_factory.mktemp("leaves"), empty()
    floor(spec)
    ball(spec, "ball", (0, -9, 0.1))
    portable.write(spec, folder / "world.mjz")
    recording, plain = record(spec, folder / "trajectory", 100), portable.read(folder / "world.mjz")
    motion_facts.write(recording, folder / "motion.npz", {"fps": 24, "size": list(SIZE), "movers": ["ball"]})

    def picture(tell):
        with np.load(folder / "motion.npz") as arrays:
            film = Film(Recorded(dict(arrays)))
        film.sky(zenith="#050505", horizon="#050505", ground="#050505", strength=0.1)
        tell(film)
        film.shot(still((0, -4, 1.2), (0, 0, 1.2), lens_mm=30), until=0.1)
        lay_film(folder, film)
        told = described.read(folder, recording)
        with Screening(folder / "world.mjz", plain, recording, told, SIZE, 24, "preview") as screening:
            return screening.picture(0, "video").astype(float).mean(axis=-1)

    return picture


def test_leaves_glow_where_light_comes_through_them_and_what_is_solid_does_not(world):
    green = "#" + "".join(f"{round(255 * part):02x}" for part in look("foliage").rgba[:3])

    def tell(film):
        film.light(azimuth_deg=90, elevation_deg=25, strength=1)  # from behind, as the camera sees it
        for x, made in ((-0.8, "foliage"), (0.8, Surface(colour=green, roughness=0.55))):
            points = np.array([(x + a, 0, 1.2 + b) for a in (-0.5, 0.5) for b in (-0.5, 0.5)])
            film.mesh(f"sheet at {x}", points, np.array([(0, 2, 3), (0, 3, 1)]), look=made)

    shown = world(tell)[20:34]
    assert shown[:, 30:36].mean() > 1.5 * shown[:, 60:66].mean()


def test_a_pale_ground_below_a_lamp_lights_what_hangs_over_it(world):
    def above(ground):
        def tell(film):
            film.light(strength=0.01)
            film.ground(Surface(colour=ground, roughness=0.9))
            film.lamp("lamp", (0, 0.4, 0.9), aim=(0, 0.4, 0), cone_deg=70, strength=4)
            film.draw("board", "box", (1.6, 0.1, 0.6), pos=(0, 0.6, 1.6), look=Surface(colour="#e8e8e8"))

        return world(tell)[12:18, 40:56].mean()

    assert above("#e0e0e0") > 1.5 * above("#101010")

"""What a picture shows is found once for a frame, though smearing it and laying puffs over it both ask."""

import numpy as np
import pytest

from small_worlds import ball, empty, floor, lay_film, record
from worldengine.film import described, motion_facts
from worldengine.film.directed import Screening
from worldengine.film.renderers.preview.shaded import Shaded
from worldkit import portable
from worldkit.filming import Film, Recorded, orbit

pytestmark = pytest.mark.gl
SIZE = (96, 54)


@pytest.fixture(scope="module")
def screening(tmp_path_factory):
    folder = tmp_path_factory.mktemp("looked")
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 0.05))
    portable.write(spec, folder / "world.mjz")
    recording = record(spec, folder / "trajectory", 500)
    recording.meta["movers"] = ["ball"]
    facts = {"fps": 24, "size": list(SIZE), "movers": ["ball"]}
    motion_facts.write(recording, folder / "motion.npz", facts)
    with np.load(folder / "motion.npz") as arrays:
        film = Film(Recorded(dict(arrays)))
    film.emit("mist", (0, 0, 0.1), rate=300, speed=0.5, diameter=(0.05, 0.2))
    film.shot(orbit("ball", azimuth_deg=(0, 180), distance=1.0), until=0.4)
    lay_film(folder, film)
    told, plain = described.read(folder, recording), portable.read(folder / "world.mjz")
    with Screening(folder / "world.mjz", plain, recording, told, SIZE, 24, "preview") as screening:
        yield screening


def test_a_smeared_frame_with_puffs_is_looked_at_once_and_none_takes_it_over_from_another(screening, monkeypatch):
    looked, surfaces = [], Shaded.surfaces
    monkeypatch.setattr(Shaded, "surfaces", lambda *given: looked.append(1) or surfaces(*given))
    plain, smears = screening.picture(6), len(looked)
    assert screening._travel_px(6) >= 1.0 and smears == 1
    apart = screening.wordless(6)
    screening.surfaces(2)
    assert np.array_equal(screening.lettered(6, apart), plain)
    screening.picture(2)
    assert np.array_equal(screening.picture(6), plain)

"""A film draws a hill anew in place of its shapes, and the statement says how far it is from the simulated one."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, lay_film, record
from worldengine.film import described, dressed, motion_facts
from worldengine.recording import still_surfaces
from worldkit import portable
from worldkit.filming import Film, Recorded, still


def world():
    """A hill of eight wedges that rises along x from 0 to 1 m, its frame turned and beside the world's; a ball on it."""
    spec = empty()
    body = spec.worldbody.add_body(name="hill", pos=(1.0, 2.0, 0.3), quat=(0.9659258, 0, 0, 0.2588190))
    for k in range(8):
        x0, x1 = -2 + k / 2, -1.5 + k / 2
        low, high = (x0 + 2) / 4, (x1 + 2) / 4
        points = [(x, y, z) for x, top in ((x0, low), (x1, high)) for y in (-2, 2) for z in (-0.2, top)]
        spec.add_mesh(name=f"wedge{k}", uservert=np.array(points).ravel())
        body.add_geom(name=f"wedge{k}", type=mujoco.mjtGeom.mjGEOM_MESH, meshname=f"wedge{k}")
    ball(spec, "ball", (1, 2, 1.2))
    return spec


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("skins")
    model = world().compile()
    recording = record(model, folder / "trajectory", 50)
    still_surfaces.write(model, Path(recording.folder))
    portable.write(world(), folder / "world.mjz")
    motion_facts.write(recording, folder / "motion.npz", {"fps": 24, "size": [160, 90], "movers": ["ball"]})
    with np.load(folder / "motion.npz") as arrays:
        return folder, recording, Recorded(dict(arrays))


def drawn(made, lift):
    """The film of a sheet over the hill, so far above its surface, through the world's frame."""
    folder, recording, seen = made
    film = Film(seen)
    x, y = np.meshgrid(np.linspace(-1.2, 3.2, 23), np.linspace(-0.2, 4.2, 23))
    z = seen.surface("hill")(x, y)
    points = np.stack([x, y, np.nan_to_num(z, nan=0.3) + lift], -1).reshape(-1, 3)
    k = np.arange(23 * 23).reshape(23, 23)
    a, b, c, d = (part.ravel() for part in (k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]))
    faces = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    faces = faces[np.isfinite(z.ravel()[faces]).all(axis=1)]
    film.mesh("turf", seen.into("hill", points), faces, to="hill", instead=True, look="grass")
    film.shot(still((0, -5, 3), "ball"), until=0.04)
    lay_film(folder, film)
    return described.read(folder, recording)


@pytest.mark.parametrize("lift", [0.0, 0.05])
def test_a_drawn_ground_takes_the_place_of_the_simulated_one_and_says_how_far_it_is_off(made, lift):
    film = drawn(made, lift)
    (said,) = film.drawn_only()
    assert said == f"turf (skin over hill, {'up to 0.05 m off' if lift else 'within 1 mm of'} its surface)"
    assert film.things[0]["off_m"] == pytest.approx(lift, abs=2e-3)
    model = dressed.dress(made[0] / "world.mjz", film)
    assert [model.geom(f"wedge{k}").group[0] for k in range(8)] == [dressed.HIDDEN_GROUP] * 8
    assert model.geom("drawn.turf").group[0] == 2 and not model.geom("drawn.turf").contype[0]

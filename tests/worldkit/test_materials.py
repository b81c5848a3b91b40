import subprocess
import sys

import mujoco
import numpy as np
import pytest

from worldkit import materials
from worldkit.materials import LOOKS, look, paint

FLAT = [name for name in LOOKS if look(name).paint and not look(name).around]
AROUND = [name for name in LOOKS if look(name).around]


def test_naming_looks_loads_no_simulator():
    code = "import sys, worldkit.materials; sys.exit('mujoco' in sys.modules or 'cv2' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize("name", FLAT)
def test_a_flat_texture_repeats_without_a_seam(name):
    pixels = paint.tile(look(name), 128)[..., :3].astype(float)
    for axis in (0, 1):
        inside = np.abs(np.diff(pixels, axis=axis)).mean(axis=(1 - axis, 2))
        seam = np.abs(pixels.take(0, axis) - pixels.take(-1, axis)).mean()
        assert seam <= 1.5 * inside.max() + 1.0


@pytest.mark.parametrize("name", AROUND)
def test_a_ball_shows_its_turning(name):
    faces = paint.cube(look(name), 48)[..., :3].astype(float)
    assert faces.reshape(-1, 3).std(axis=0).max() > 3.0
    # Neighbouring faces meet: the last column of +x is the first of -z.
    across = np.abs(faces[0][:, -1] - faces[5][:, 0]).mean()
    assert across < 40.0


def test_paint_is_the_same_every_time():
    entry = look("wood_planks")
    first = paint.tile(entry, 128).copy()
    paint.tile.cache_clear()
    assert np.array_equal(first, paint.tile(entry, 128))


def test_every_look_compiles_into_a_model():
    spec = mujoco.MjSpec()
    for number, name in enumerate(LOOKS):
        spec.worldbody.add_geom(size=(0.1, 0, 0), pos=(number, 0, 0), material=materials.add(spec, name))
    model = spec.compile()
    assert model.nmat == len(LOOKS) and model.ntex == len(FLAT) + len(AROUND)
    names = [model.mat(int(m)).name for m in model.geom_matid]
    assert names == list(LOOKS)


def test_something_clear_has_its_colour_at_its_depth_and_is_paler_where_it_is_thin():
    def seen(entry, depth_m):
        light = np.exp(-np.array(entry.absorbs) * depth_m)
        return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)

    syrup, deep = look("clear #b5651d"), look("clear #b5651d 30mm")
    told = np.array((0xB5, 0x65, 0x1D)) / 255
    assert np.allclose(seen(syrup, 0.01), told, atol=1e-6) and np.allclose(seen(deep, 0.03), told, atol=1e-6)
    assert (seen(syrup, 0.001) > told + 0.1).all() and (seen(syrup, 0.04) < 0.8 * told).all()
    assert syrup.clear > 0 and min(look("clear #000000").absorbs) > 0 and max(look("clear #ffffff").absorbs) == 0
    for wrong in ("clear", "clear amber", "clear #b5651d 0mm", "clear #b5651d 3 m"):
        with pytest.raises(ValueError, match="no look is called"):
            look(wrong)

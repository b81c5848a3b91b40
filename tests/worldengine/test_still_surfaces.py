"""What stands still is handed to films as triangles, whose height is where rays from above meet it."""

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor
from worldengine.recording import still_surfaces
from worldkit.filming import ground


def world():
    spec = empty()
    floor(spec)
    rough = np.random.default_rng(2).random((9, 13))
    spec.add_hfield(name="hill", nrow=9, ncol=13, size=(3, 2, 1.5, 0.5), userdata=rough.ravel())
    hill = spec.worldbody.add_body(name="hill", pos=(1, -1, 0.5), quat=(0.9659258, 0, 0, 0.2588190))
    hill.add_geom(name="hill", type=mujoco.mjtGeom.mjGEOM_HFIELD, hfieldname="hill")
    ramp = spec.worldbody.add_body(name="ramp", pos=(8, 0, 0.5), quat=(0.9659258, 0, 0.2588190, 0))
    ramp.add_geom(name="ramp", type=mujoco.mjtGeom.mjGEOM_BOX, size=(1, 1, 0.1))
    spec.add_mesh(name="rock", uservert=[-1, -1, 0, 1, -1, 0, 0, 1, 0, 0.2, 0.1, 1.3])
    rock = spec.worldbody.add_body(name="rock", pos=(0, 8, 0))
    rock.add_geom(name="rock", type=mujoco.mjtGeom.mjGEOM_MESH, meshname="rock")
    ball(spec, "ball", (0, 0, 9))
    return spec.compile()


@pytest.mark.parametrize("name", ["hill", "ramp", "rock"])
def test_a_surface_is_where_rays_from_above_meet_it(tmp_path, name):
    model = world()
    still_surfaces.write(model, tmp_path)
    found = still_surfaces.read(tmp_path)
    assert set(found["names"]) == {"hill", "ramp", "rock"}
    mine = found["owner"] == list(found["names"]).index(name)
    height = ground.over(found["vertices"], found["faces"][mine])
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    centre = data.xpos[model.body(name).id]
    places = centre[:2] + np.random.default_rng(1).uniform(-4, 4, (2000, 2))
    z = height(places[:, 0], places[:, 1])
    only, met = np.zeros(1, np.int32), 0
    for (x, y), told in zip(places, z, strict=True):
        far = mujoco.mj_ray(model, data, (x, y, 8.0), (0, 0, -1.0), None, 1, -1, only, None)
        if only[0] >= 0 and model.geom(only[0]).name == name:
            met += 1
            assert told == pytest.approx(8.0 - far, abs=1e-4)
        else:
            assert np.isnan(told)
    assert met > 50


def test_a_world_without_any_writes_nothing(tmp_path):
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 1))
    still_surfaces.write(spec.compile(), tmp_path)
    assert not list(tmp_path.iterdir()) and not len(still_surfaces.read(tmp_path)["names"])

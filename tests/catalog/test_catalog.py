"""The catalog: made by its recipes byte for byte, in scale, and standing where a plan puts it."""

import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

from worldkit import assets, bodies, scene

ROOT = Path(__file__).parents[2]
KEYS = tuple(assets.keys())
WATER = 1000.0


def world(key: str):
    """One asset standing loose on the floor at its usual height, as a plan places it."""
    spec = scene.new("stand", time_step=0.002)
    height = assets.find(key).metric_height
    assets.add(spec, key, name="thing", height=height, pos=(0, 0, height / 2))
    return spec


def run(spec, seconds: float):
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    for _ in range(round(seconds / model.opt.timestep)):
        mujoco.mj_step(model, data)
    return model, data


@pytest.mark.slow
def test_every_file_is_what_its_recipe_makes():
    done = subprocess.run(
        [sys.executable, "-m", "catalog.make", "--check"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        env={"PYTHONPATH": f"{ROOT}:{ROOT / 'servers'}", "PATH": "/usr/bin:/bin"},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.count("unchanged") == len(KEYS) >= 12


@pytest.mark.parametrize("key", KEYS)
def test_an_asset_says_what_it_is_and_where_it_comes_from(key):
    asset = assets.find(key)
    assert asset.licence and asset.source and asset.description and asset.facing
    assert (ROOT / "catalog" / key / "thumbnail.png").stat().st_size > 2000


@pytest.mark.parametrize("key", KEYS)
def test_its_mass_belongs_to_its_size(key):
    asset = assets.find(key)
    extents = np.array(asset.extents(asset.metric_height))
    density = asset.mass_at(asset.metric_height) / extents.prod()
    assert 1.0 < density < 8.0 * WATER
    assert 0.005 < extents.max() < 5.0


@pytest.mark.parametrize("key", KEYS)
def test_what_collides_is_as_large_as_what_is_drawn(key):
    spec = world(key)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    low, high = {}, {}
    body = model.body("thing").id
    for g in np.flatnonzero(model.geom_bodyid == body):
        kind = "hull" if model.geom_contype[g] or model.geom_conaffinity[g] else "drawn"
        turn = data.geom_xmat[g].reshape(3, 3)
        if model.geom_type[g] == mujoco.mjtGeom.mjGEOM_MESH:
            mesh = model.mesh(model.geom_dataid[g])
            first, count = mesh.vertadr[0], mesh.vertnum[0]
            points = data.geom_xpos[g] + model.mesh_vert[first : first + count] @ turn.T
        else:
            middle = data.geom_xpos[g] + turn @ model.geom_aabb[g, :3]
            reach = np.abs(turn) @ model.geom_aabb[g, 3:]
            points = np.stack([middle - reach, middle + reach])
        low[kind] = np.minimum(low.get(kind, np.inf), points.min(axis=0))
        high[kind] = np.maximum(high.get(kind, -np.inf), points.max(axis=0))
    size = high["drawn"] - low["drawn"]
    assert np.all(np.abs(high["hull"] - high["drawn"]) < 0.06 * size.max() + 0.002)
    assert np.all(np.abs(low["hull"] - low["drawn"]) < 0.06 * size.max() + 0.002)
    asset = assets.find(key)
    assert np.allclose(size, asset.extents(asset.metric_height), atol=0.03 * size.max())


@pytest.mark.parametrize("key", KEYS)
def test_it_stands_where_it_is_put(key):
    _model, data = run(world(key), 2.0)
    height = assets.find(key).metric_height
    moved = data.body("thing").xpos - (0, 0, height / 2)
    assert np.abs(moved[2]) < 0.003 + 0.01 * height
    rolls = key in {"basketball", "billiard_ball"}
    assert rolls or np.hypot(*moved[:2]) < 0.01
    upright = data.body("thing").xmat.reshape(3, 3)[2, 2]
    assert rolls or upright > 0.999
    assert np.abs(data.qvel[:3]).max() < 0.02


def test_a_ball_stays_in_the_bowl():
    spec = world("bowl")
    height = assets.find("bowl").metric_height
    bodies.sphere(spec, "marble", diameter=0.02, pos=(0.02, 0.01, height + 0.05))
    _model, data = run(spec, 2.5)
    marble, bowl = data.body("marble").xpos, data.body("thing").xpos
    rim = max(assets.find("bowl").extents(height)[:2]) / 2
    assert np.hypot(*(marble - bowl)[:2]) < rim
    assert 0.005 < marble[2] < height


def test_a_ball_rests_on_the_bed_of_the_table():
    spec = scene.new("pool", time_step=0.002)
    height = assets.find("pool_table").metric_height
    assets.add(spec, "pool_table", name="table", height=height, pos=(0, 0, height / 2), fixed=True)
    bodies.sphere(spec, "ball", diameter=0.057, pos=(0.2, 0.1, height + 0.1))
    _model, data = run(spec, 2.0)
    ball = data.body("ball").xpos
    assert height - 0.12 < ball[2] < height + 0.03
    assert np.abs(data.qvel[-6:-3]).max() < 0.05

"""The catalog: what its recipes make on any processor, in scale, and standing where a plan puts it."""

import importlib.util
import subprocess
import sys
from pathlib import Path

import cv2
import mujoco
import numpy as np
import pytest

from worldkit import assets, bodies, scene

ROOT = Path(__file__).parents[2]
_SPEC = importlib.util.spec_from_file_location("sameness", ROOT / "catalog/make/sameness.py")
sameness = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(sameness)
same = sameness.same
KITS = {path.stem for path in (ROOT / "catalog/make/kits").glob("*.py")}
"""Things of sculpted parts, which `test_kits.py` looks at."""
KEYS = tuple(key for key in assets.keys() if key not in KITS)  # noqa: SIM118 - a function of the catalog, not a mapping
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


ANOTHER = {
    "NPY_DISABLE_CPU_FEATURES": "X86_V3",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-AVX,-FMA",
    "OPENBLAS_CORETYPE": "Nehalem",
}
"""Makes numpy and the C library of an x86 processor round as an older make would: the last bits of sums differ."""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("keys", "processor"),
    [(KEYS[::2], {}), (KEYS[1::2], {}), (("bowling_pin", "lamp"), ANOTHER)],
    ids=["this, one half", "this, the other", "another"],
)
def test_every_file_is_what_its_recipe_makes(keys, processor):
    done = subprocess.run(
        [sys.executable, "-m", "catalog.make", "--check", *keys],
        cwd=ROOT,
        capture_output=True,
        text=True,
        env={"PYTHONPATH": f"{ROOT}:{ROOT / 'servers'}", "PATH": "/usr/bin:/bin", **processor},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.count("unchanged") == len(keys)


def test_the_catalog_has_a_dozen_assets():
    assert len(KEYS) >= 12


def test_what_another_processor_rounds_is_the_same_and_a_change_is_not():
    folder = ROOT / "catalog/bowling_pin"
    asset = (folder / "asset.yaml").read_bytes()
    assert same("asset.yaml", asset, asset.replace(b"-2.00955e-21", b"3.1e-35"))
    hull = (folder / "hulls/00.obj").read_text().splitlines()
    number = float(hull[0].split()[1])
    nudged = [hull[0].replace(hull[0].split()[1], f"{number + 1e-5:.5f}"), *hull[1:]]
    moved = [hull[0].replace(hull[0].split()[1], f"{number + 3e-5:.5f}"), *hull[1:]]
    text = "\n".join(hull).encode()
    assert same("hulls/00.obj", text, "\n".join(nudged).encode())
    assert not same("hulls/00.obj", text, "\n".join(moved).encode())
    assert not same("hulls/00.obj", text, "\n".join(hull[:-1]).encode())
    for before, after in ((b"e-21", b"e-7"), (b"mass: ", b"mass: 1"), (b"category", b"categories")):
        assert before in asset and not same("asset.yaml", asset, asset.replace(before, after, 1))
    drawn = (folder / "pin.obj").read_bytes()
    assert not same("pin.obj", drawn, drawn.replace(b"f 1/", b"f 2/", 1))
    picture = cv2.imread(str(folder / "coat.png"), cv2.IMREAD_UNCHANGED)
    for share, levels, alike in ((5e-4, 4, True), (5e-3, 4, False), (5e-4, 40, False)):
        other = picture.astype(int).ravel()
        other[: int(share * other.size)] += np.where(other[: int(share * other.size)] > 127, -levels, levels)
        _, data = cv2.imencode(".png", other.reshape(picture.shape).astype(np.uint8))
        assert same("coat.png", (folder / "coat.png").read_bytes(), data.tobytes()) == alike


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

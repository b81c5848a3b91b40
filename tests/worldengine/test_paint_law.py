"""The worked law of the skill media, poured for a second and a half: volume, weight, flow and mixing."""

import importlib.util
import types
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from hung_springs import run
from small_worlds import empty
from worldengine.inputs.declared_media import Medium
from worldengine.recording import point_colours, stored
from worldkit import moved_shapes

LAWS = Path(__file__).parents[2] / "skills/media/references/two-paints/laws"
STEPS = 60
"""Of 0.02 s."""


@pytest.fixture(scope="module")
def law() -> types.ModuleType:
    """The case's law as a module."""
    spec = importlib.util.spec_from_file_location("paint", LAWS / "paint.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def canvas(paint: Any) -> mujoco.MjSpec:
    spec = empty(time_step=0.02)
    board = spec.worldbody.add_body(
        name="canvas", pos=(0, 0, 0.1), quat=(np.cos(np.radians(7)), np.sin(np.radians(7)), 0, 0)
    )
    board.add_geom(name="canvas", type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.2, 0.16, 0.01), rgba=(0.9, 0.9, 0.87, 1))
    moved_shapes.surface(spec, "film", paint.points, paint.triangles)
    return spec


@pytest.fixture(scope="module")
def poured(law: types.ModuleType, tmp_path_factory: pytest.TempPathFactory) -> stored.Recording:
    folder = tmp_path_factory.mktemp("paint") / "out"
    rows = (Medium("paint", (), "film", world=True),)
    paint = law.Paint(0.9, 1250.0)
    return run(folder, paint, canvas(paint), rows, steps=STEPS)


def test_no_volume_no_mass_and_no_momentum_comes_from_nowhere(poured: stored.Recording) -> None:
    sums = poured.balances
    assert sums.volume == pytest.approx(np.full(len(sums), sums.volume[0]), rel=1e-10)
    assert sums.mass == pytest.approx(1250.0 * sums.volume, rel=1e-10)
    weight = np.array([0, 0, -9.81]) * sums.mass[:, None] * sums.step[:, None] * poured.time_step
    assert sums.momentum - sums.momentum[0] + sums.held == pytest.approx(weight, abs=1e-9), "less that of the cans"
    assert (np.diff(sums.weight) < 0).all(), "it only ever sinks"


def test_it_runs_down_the_slope_and_paints_mix(law: types.ModuleType, poured: stored.Recording) -> None:
    grid = law.DOWN * law.ACROSS
    place = poured.media.place.reshape(-1, grid + law.SPOUTS * law.RINGS * law.AROUND, 3)[:, :grid]
    colour = point_colours.shares(poured.media.colour.reshape(len(place), -1)[-1, :grid])
    high = (place - place[:1])[..., 2]
    wet = high > 3e-4
    assert not wet[0].any() and 0.05 < wet[-1].mean() < 0.4
    half = len(wet) // 2
    lowest = [place[n][wet[n], 1].min() for n in (half, -1)]
    assert lowest[1] < lowest[0] - 0.01, "down, which is towards -y"
    away = np.linalg.norm(colour[wet[-1], None] - np.array(law.INKS), axis=-1).min(axis=1)
    assert 0.1 < (away > 0.1).mean() < 0.9, "some is none of the colours poured, and some still is"

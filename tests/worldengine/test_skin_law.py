"""The page of the skill media that closes a hot bottle: coarser and shorter, in a recorded world, with its sums."""

import re
import types
from pathlib import Path

import mujoco
import numpy as np
import pytest

from hung_springs import run
from small_worlds import empty
from worldengine.inputs.declared_media import Medium
from worldengine.recording import stored
from worldkit import moved_shapes

PAGE = Path(__file__).parents[2] / "skills" / "media" / "references" / "skin.md"
AROUND, STEPS = 12, 40
"""Points of a ring; steps of 0.01 s."""


@pytest.fixture(scope="module")
def page() -> list[str]:
    return re.findall(r"^```python program\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


@pytest.fixture(scope="module")
def cooled(page: list[str], tmp_path_factory: pytest.TempPathFactory) -> stored.Recording:
    module = types.ModuleType("bottle")
    exec(compile(page[0], "laws/bottle.py", "exec"), module.__dict__)  # the page's own text
    spec = empty(time_step=0.01)
    spec.worldbody.add_geom(name="ground", type=mujoco.mjtGeom.mjGEOM_PLANE, size=(1, 1, 0.1))
    moved_shapes.surface(spec, "walls", *module.shape(around=AROUND))
    law = module.Bottle(warm=333.0, around=288.0, finest=AROUND)
    folder = tmp_path_factory.mktemp("bottle") / "out"
    return run(folder, law, spec, (Medium("bottle", (), "walls", world=True),), steps=STEPS)


def test_no_momentum_comes_from_nowhere_and_no_energy_is_made(cooled: stored.Recording) -> None:
    sums = cooled.balances
    weight = np.array([0, 0, -9.81]) * sums.mass[:, None] * sums.step[:, None] * cooled.time_step
    assert sums.momentum + sums.held == pytest.approx(weight, abs=1e-9)
    reach = np.ptp(sums.energy - sums.weight)
    assert (sums.energy - np.minimum.accumulate(sums.energy)).max() < 0.05 * reach


def test_it_caves_in_at_its_side_and_its_neck_stays(page: list[str], cooled: stored.Recording) -> None:
    place = cooled.media.place.reshape(len(cooled.balances), -1, 3)
    start, end = (np.hypot(points[:, 0], points[:, 1]) for points in (place[0], place[-1]))
    side = (place[0, :, 2] > 0.05) & (place[0, :, 2] < 0.12)
    neck = place[0, :, 2] > 0.188
    assert (end - start)[side].min() < -0.004, "a dent"
    middle = place[-1, neck, :2].mean(axis=0)
    left = np.hypot(*(place[-1, neck, :2] - middle).T)
    assert left == pytest.approx(start[neck], abs=5e-4)
    assert place[-1, :, 2].min() > -5e-4, "it stands on the ground"


def test_the_pages_balloon_begins_in_balance(page: list[str]) -> None:
    names: dict = {}
    exec(compile(page[2], "laws/balloon.py", "exec"), names)
    balloon = names["Balloon"](young=1e6)
    balloon._close()
    thick, radius, stretch, shear = 2.5e-4, 0.05, 2.0, 1e6 / 3
    book = 2 * shear * thick / radius * (1 / stretch - stretch**-7)
    assert balloon.pressure - balloon.gas.outside == pytest.approx(book, rel=0.01)

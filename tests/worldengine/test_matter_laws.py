"""The pages of the skill media on honey, snow and steam: coarser or shorter, in a recorded world, with their sums."""

import re
import types
from pathlib import Path

import mujoco
import numpy as np
import pytest

from hung_springs import run
from small_worlds import empty, lay_film
from worldengine.film import described, motion_facts
from worldengine.inputs.declared_media import Medium
from worldengine.recording import stored
from worldkit import moved_shapes
from worldkit.filming import Film, Recorded, still
from worldkit.matter import Matter

PAGES = Path(__file__).parents[2] / "skills" / "media" / "references"


def law_of(page: str) -> types.ModuleType:
    text = (PAGES / f"{page}.md").read_text(encoding="utf-8")
    module = types.ModuleType(page)
    exec(
        compile(
            re.findall(r"^```python program\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)[0], f"laws/{page}.py", "exec"
        ),
        module.__dict__,
    )
    return module


def recorded(law: Matter, body: str, low: float, folder: Path, steps: int) -> stored.Recording:
    """A run of it over a plate that a stiff spring holds; the plate's top at the height `low`."""
    spec = empty(time_step=0.004)
    plate = spec.worldbody.add_body(name=body, pos=(0, 0, low - 0.02))
    plate.gravcomp = 1
    plate.add_joint(name="gives", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(0, 0, 1), stiffness=2e4, damping=100)
    plate.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.5, 0.5, 0.02), mass=5.0)
    moved_shapes.grains(spec, law.shown_by, law.points, law.radius)
    return run(folder / "out", law, spec, (Medium(law.name, (body,), law.shown_by, world=True),), steps=steps)


def kept(recording: stored.Recording) -> None:
    """No momentum across from nowhere, no mass, no energy: the plate hardly moves, and takes what falls."""
    sums = recording.balances
    weight = 9.81 * sums.mass[-1] * sums.step[-1] * recording.time_step
    assert np.abs((sums.momentum + sums.held)[:, :2]).max() < 0.05 * weight
    assert sums.mass == pytest.approx(sums.mass[0], rel=1e-12)
    reach = np.ptp(sums.energy - sums.weight)
    assert (sums.energy - np.minimum.accumulate(sums.energy)).max() < 0.05 * reach


def test_the_pages_honey_spreads_on_a_plate(tmp_path: Path) -> None:
    module = law_of("honey")
    honey = module.Honey(1400.0, 3.0, spacing=0.004)
    low = float(honey.points[:, 2].min()) - 0.002
    recording = recorded(honey, "jar", low, tmp_path, steps=50)
    place = recording.media.place.reshape(len(recording.balances), -1, 3)
    assert np.ptp(place[-1, :, 2]) < 0.8 * np.ptp(place[0, :, 2]) and place[-1, :, 2].min() > low - 5e-4
    kept(recording)
    assert recording.balances.volume[-1] == pytest.approx(recording.balances.volume[0], rel=0.02)


def test_the_pages_snow_comes_down_with_its_mass(tmp_path: Path) -> None:
    module = law_of("snow")
    snow = module.Snowfall(100.0, 0.3, spacing=0.03)
    recording = recorded(snow, "seat", 0.9, tmp_path, steps=150)
    place = recording.media.place.reshape(len(recording.balances), -1, 3)
    lies = place[-1, :, 2] < 1.0
    assert 0.1 < lies.mean() < 0.5 and place[-1, lies, 2].min() > 0.89
    assert recording.balances.mass == pytest.approx(0.3)
    kept(recording)


def test_the_pages_steam_rises_from_its_spout_with_its_sums_and_is_seen_as_it_leaves(tmp_path: Path) -> None:
    steam = law_of("steam").Steam((0.1, 0, 0.2), (0.8, 0, 0.6))
    spec = empty(time_step=0.004)
    moved_shapes.grains(spec, "vapour", steam.points, 0.003)
    recording = run(tmp_path / "out", steam, spec, (Medium("steam", (), "vapour", world=True),), steps=500)
    sums = recording.balances
    place = recording.media.place.reshape(len(sums), -1, 3)
    assert place[-1, :, 2].max() > 0.5 and (place[-1, -60:] == place[0, -60:]).all(), "the last of them wait"
    weight = np.array([0, 0, -9.81]) * sums.mass[:, None] * sums.step[:, None] * recording.time_step
    assert np.abs(sums.momentum + sums.held - weight).max() < 1e-6 * np.abs(weight[-1]).max()
    assert np.ptp(sums.energy) < 1e-4 * np.ptp(sums.stored)
    motion_facts.write(recording, tmp_path / "motion.npz", {"fps": 24, "size": [64, 36], "movers": []})
    with np.load(tmp_path / "motion.npz") as arrays:
        film = Film(Recorded(dict(arrays)))
    film.cloud("steam", of="steam", diameter=(0.015, 0.12), life=2.2, opacity=0.5)
    film.shot(still((0, -1, 0.3), (0.1, 0, 0.3)), until=2.0)
    lay_film(tmp_path, film)
    told = described.read(tmp_path, recording)
    seen = [len(told.clouds[0].puffs(frame)[0]) for frame in (1, 20, 40)]
    assert seen[0] == 0 < seen[1] < seen[2]
    assert told.clouds[0].began[:3] == pytest.approx(0.2 + np.arange(3) / 45, abs=0.03)

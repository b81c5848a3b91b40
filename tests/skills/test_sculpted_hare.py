"""The worked figure of the skill `sculpting`: made and seen as the skill says, and fit to be a body."""

import runpy
import shutil
from pathlib import Path

import cv2
import mujoco
import numpy as np
import pytest

from worldkit import scene, sculpt
from worldwright.stage import tools as stage

HARE = Path(__file__).parents[2] / "skills/sculpting/references/hare.py"


def test_its_sheet_shows_a_whole_hare_of_its_size(tmp_path):
    shutil.copy(HARE, tmp_path)
    coarse = tmp_path / "coarse.py"
    coarse.write_text(
        "from hare import HARE, paint\nfrom worldkit import sculpt\n"
        "FIGURE = sculpt.Part('hare', HARE, paint=paint, mass=3.6, make={'cells': 56, 'triangles': 6000})\n"
    )
    told = stage.sheet(f"{coarse}:FIGURE")
    (part,) = told.data.parts
    assert part.bits == 1 and part.mass_kg == pytest.approx(3.6) and part.hulls > 4
    assert told.data.extent_m == pytest.approx((0.45, 0.24, 0.56), abs=0.02)
    page = cv2.imdecode(np.frombuffer(told.pictures[0].data, np.uint8), cv2.IMREAD_COLOR)
    hue, saturation, _ = np.moveaxis(cv2.cvtColor(page, cv2.COLOR_BGR2HSV).astype(int), -1, 0)
    brown = (saturation > 80) & (hue < 25)
    for quarter in (brown[: len(page) // 2, : page.shape[1] // 2], brown[len(page) // 2 :, page.shape[1] // 2 :]):
        assert 0.03 < quarter.mean() < 0.4


def test_it_sits_where_it_is_put():
    held = runpy.run_path(str(HARE))
    spec = scene.new("sits", time_step=0.002)
    sculpt.add(spec, held["HARE"], name="hare", pos=(0, 0, 0.282), mass=3.6, cells=48)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 500)
    assert np.abs(data.body("hare").xpos - (0, 0, 0.28)).max() < 0.02
    assert data.body("hare").xmat[8] > 0.98  # upright

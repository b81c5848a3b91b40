"""The catalog's things of sculpted parts: each was made of the code beside it, and stood for five seconds when it was."""

import csv
import hashlib
import importlib
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest
import yaml

from worldkit import assets, models
from worldwright.intake import taking_in
from worldwright.intake.libraries import own_kits
from worldwright.intake.refusing import IntakeFailedError

ROOT = Path(__file__).parents[2]
CODE = sorted(path.stem for path in (ROOT / "catalog/make/kits").glob("*.py") if path.stem != "__init__")
KITS = [key for key in CODE if (ROOT / "catalog" / key).is_dir()]
"""Those whose meshes lie in the catalog; the others are made when one is first asked for."""


def facts(key: str) -> dict:
    return yaml.load((ROOT / "catalog" / key / "asset.yaml").read_text(encoding="utf-8"), yaml.CSafeLoader)


@pytest.fixture
def make(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT))
    yield importlib.import_module("catalog.make.kit")
    for name in [name for name in sys.modules if name.partition(".")[0] == "catalog"]:
        del sys.modules[name]


@pytest.mark.parametrize("key", KITS)
def test_a_kit_is_what_its_code_made_and_stood_still(key):
    told = facts(key)
    measured = told["measured"]
    code = (ROOT / f"catalog/make/kits/{key}.py").read_bytes()
    assert measured["source_sha256"] == hashlib.sha256(code).hexdigest(), f"python -m catalog.make {key} --thumbnails"
    assert measured["stands"] and measured.get("moving_stands", True)
    assert told["description"] and told["metric_height_source"] and told["licence"] == "Apache-2.0"
    assert 0.005 < max(told["native_extents"]) < 5.0
    assert (ROOT / "catalog" / key / "thumbnail.png").stat().st_size > 2000
    assert ("moving" in measured) == (ROOT / "catalog" / key / "moving.xml").is_file()


def test_some_kits_move_and_all_together_stay_small():
    held = [facts(key)["measured"] for key in KITS]
    assert sum("moving" in measured for measured in held) >= 3
    assert sum(path.stat().st_size for key in KITS for path in (ROOT / "catalog" / key).iterdir()) < len(KITS) * 300_000


def test_the_table_tells_of_every_kit_and_offers_those_that_lie_nowhere():
    with (ROOT / "catalog/make/kits.csv").open(encoding="utf-8", newline="") as lines:
        rows = {row["key"]: row for row in csv.DictReader(lines)}
    assert sorted(rows) == CODE
    for key in KITS:
        sides = [float(rows[key][side]) for side in ("depth_m", "width_m", "height_m")]
        assert sides == pytest.approx(facts(key)["native_extents"], rel=1e-3)
        assert rows[key]["description"] == facts(key)["description"]
    offered = {offer.key: offer for offer in own_kits.offers()}
    assert sorted(offered) == sorted({*CODE} - {*KITS}) and offered["teapot"].extents[2] == pytest.approx(0.159)


def test_a_kit_that_lies_nowhere_is_made_when_it_is_asked_for(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_ASSETS", str(tmp_path / "own"))
    made = taking_in.add(Path("wine_glass"), {}).data
    assert made.stands and made.extents_m[2] == pytest.approx(0.2125, abs=1e-3)
    assert assets.find("wine_glass").folder == tmp_path / "own/wine_glass"
    with pytest.raises(IntakeFailedError, match="its own height"):
        taking_in.add(Path("teapot"), {"height": 2.0})


def test_a_kit_whose_code_fails_says_where(tmp_path, monkeypatch):
    monkeypatch.setattr(own_kits.sys, "executable", "/bin/false")
    with pytest.raises(IntakeFailedError, match="exit code 1"):
        own_kits.lay("teapot", tmp_path)


def test_a_kit_that_is_made_again_is_the_same_thing(make):
    kit = importlib.import_module("catalog.make.kits.prism").KIT
    made, again = make.files("prism", kit)
    told = facts("prism")
    assert again["native_extents"] == pytest.approx(told["native_extents"], abs=1e-6)
    assert again["mass"] == pytest.approx(told["mass"], rel=1e-4)
    assert again["materials"] == told["materials"] and {"look": "glass_blue"} in told["materials"].values()
    assert set(made) <= {path.name for path in (ROOT / "catalog/prism").iterdir()}


def test_the_balls_of_the_cradle_pass_a_blow_on():
    """The last ball leaves faster than those before it; soft contacts share the blow, so that it is not all of it."""
    text = (ROOT / "catalog/newtons_cradle/moving.xml").read_text(encoding="utf-8")
    spec = mujoco.MjSpec()
    spec.option.timestep = 0.0005
    height = assets.find("newtons_cradle").metric_height
    models.attach(spec, text, name="toy", pos=(0, 0, height / 2), folder="newtons_cradle", fixed=True)
    model = spec.compile()
    data = mujoco.MjData(model)
    data.joint("toy_thread_1").qpos = 0.5  # drawn back, towards -x
    most = np.zeros(5)
    for _ in range(400):
        mujoco.mj_step(model, data)
        most = np.maximum(most, [abs(float(data.joint(f"toy_thread_{n}").qvel[0])) for n in range(1, 6)])
    assert most[0] > 4.0 and most[4] > 0.5 * most[0]
    assert most[4] > 1.1 * most[1:4].max()


def test_the_metronome_beats_to_both_sides_and_holds_its_weight():
    text = (ROOT / "catalog/metronome/moving.xml").read_text(encoding="utf-8")
    spec = mujoco.MjSpec()
    spec.option.timestep = 0.002
    height = assets.find("metronome").metric_height
    models.attach(spec, text, name="toy", pos=(0, 0, height / 2), folder="metronome", fixed=True)
    model = spec.compile()
    data = mujoco.MjData(model)
    data.joint("toy_beat").qpos = 0.3
    swings = []
    for _ in range(1000):
        mujoco.mj_step(model, data)
        swings.append(float(data.joint("toy_beat").qpos[0]))
    assert np.count_nonzero(np.diff(np.sign(swings))) >= 4 and min(swings) < -0.2
    assert abs(float(data.joint("toy_tempo").qpos[0])) < 0.01

"""An arm that picks and a drone that flies are rows of a plan: declared, drafted whole, and refused with a cause."""

from pathlib import Path

import pytest
from pydantic import ValidationError

import packaged_dogs
import packaged_machines
from worldkit.robots import packaged
from worldwright.draft import draft
from worldwright.draft.driving import control
from worldwright.draft.requirements import Needs
from worldwright.lint.tools import check_plan
from worldwright.model.plan import law_words
from worldwright.model.plan.committed import Plan
from worldwright.model.plan.plan_text import read_plan
from worldwright.model.plan.scene_objects import AssetRow
from worldwright.place.engine import resolve
from worldwright.stamp.gates.auto_approve import _chosen

CASES = Path(__file__).parents[3] / "skills/robots/references"


def _written(folder, monkeypatch, key, model, case):
    packaged_dogs.install(folder / "site", monkeypatch, key, model)
    packaged.lay(key, folder / "run" / key)
    path = folder / "run/plan.md"
    path.write_text((CASES / case / "plan.md").read_text(encoding="utf-8"), encoding="utf-8")
    return path


def test_an_arm_declares_its_motors_and_is_drafted_whole(tmp_path, monkeypatch):
    path = _written(tmp_path, monkeypatch, "yam", packaged_machines.ARM, "mug-on-a-shelf")
    assert not [f.message for f in check_plan(path).findings if f.severity == "error"]
    plan = read_plan(path).plan
    (control,) = plan.simulation_parameters.interventions
    assert len(control.bodies) == 7 and control.bodies[-1] == "yam_left_finger_motor" and "20 N" in control.law
    made = draft(plan, resolve(plan).scene)
    assert not made.open_places and "    YAM_PICKER(model, data)" in made.source
    assert 'YAM_PICKER = robots.picker("yam", "yam", "mug", "shelf", from_s=0.3)' in made.source
    assert ("assets.yam.picks.from_s", [0.3]) in list(_chosen(plan))
    path.write_text(path.read_text(encoding="utf-8").replace("thing: mug", "thing: jug"), encoding="utf-8")
    assert any("`jug`" in f.message and f.code == "WP013" for f in check_plan(path).findings)


def test_a_drone_declares_its_rotors_and_its_gusts(tmp_path, monkeypatch):
    path = _written(tmp_path, monkeypatch, "cf21b", packaged_machines.DRONE, "drone-in-gusts")
    assert not [f.message for f in check_plan(path).findings if f.severity == "error"]
    plan = read_plan(path).plan
    control, gusts = plan.simulation_parameters.interventions
    assert control.bodies == tuple(f"cf21b_rotor{n}" for n in range(4)) and (gusts.kind, gusts.bodies) == (
        "force",
        ("cf21b",),
    )
    assert not law_words.BRAKES.search(gusts.law)  # a wind from behind drives it
    made = draft(plan, resolve(plan).scene)
    assert not made.open_places and "    CF21B_FLIER(model, data)" in made.source
    assert "robots.Gusts((1.0, 0.0, 0.0), 2.0)" in made.source
    assert "assets.cf21b.flies.gusts" in dict(_chosen(plan)) and not [
        f for f in check_plan(path).findings if f.code == "WP124"
    ]


ARM = {"name": "yam", "type": "mjcf", "filename": "a.xml", "fixed": True}
DRONE = {"name": "d", "type": "mjcf", "filename": "a.xml"}
PICKS = {"thing": "mug", "places_on": "shelf", "arm": "yam"}
FLIES = {"drone": "cf21b", "through": [[0, 0, 1]]}


@pytest.mark.parametrize(
    ("row", "told"),
    [
        ({**ARM, "picks": {**PICKS, "arm": "crane"}}, "there is no arm `crane`"),
        ({**ARM, "fixed": False, "picks": PICKS}, "whose base stands"),
        ({**ARM, "picks": PICKS, "count": 2}, "no `count`"),
        ({**DRONE, "flies": {**FLIES, "drone": "kite"}}, "there is no drone `kite`"),
        ({**DRONE, "fixed": True, "flies": FLIES}, "free to move"),
        ({**DRONE, "flies": {**FLIES, "through": [[0, 0, 1], [0, 0, 1]]}}, "are one"),
        ({**DRONE, "flies": {**FLIES, "through": []}}, "at least 1"),
    ],
)
def test_a_row_that_cannot_be_says_why(row, told):
    with pytest.raises(ValidationError, match=told):
        AssetRow.model_validate(row)


@pytest.mark.parametrize(
    ("picks", "told"),
    [
        ({"thing": "crate"}, "`picks.thing` of `yam` is `crate`, which is `fixed`"),
        ({"thing": "yam"}, "is `yam` itself"),
        ({"places_on": "mug"}, "is `mug` itself"),
        ({"thing": "nuts"}, "several: name one, such as `nuts_1`"),
        ({"places_on": "cloth"}, "which is soft"),
    ],
)
def test_an_arm_picks_one_hard_thing_that_is_free(picks, told):
    box = {"primitive": "box", "size": [0.1, 0.1, 0.01]}
    rows = [{**box, "name": "crate", "fixed": True}, {**box, "name": "mug"}, {**box, "name": "nuts", "count": 3}]
    soft = {"kind": "cloth", "modulus": "stuff"}
    plan = {
        "title": "Picked",
        "plan_type": "scene",
        "simulation_parameters": {
            "time_step": 0.002,
            "simulation_duration": 1.0,
            "integrator": "discrete",
            "masses": {"cloth": 0.1},
            "constants": {"stuff": {"value": 1e5, "unit": "Pa", "source": "a table"}},
        },
        "objectives": [{"claim": "It is picked."}],
        "scene_objects": [*rows, {**box, "name": "cloth", "soft": soft}],
        "assets": [{**ARM, "picks": {**PICKS, "places_on": "crate"}}],
    }
    assert Plan.model_validate(plan)
    plan["assets"][0]["picks"] |= picks
    with pytest.raises(ValidationError, match=told):
        Plan.model_validate(plan)


def test_a_push_on_a_drone_in_gusts_is_left_open_beside_them():
    gusts = {"strength_m_s": 2.0, "source": "a breeze"}
    push = {"kind": "force", "bodies": ["d"], "law": "a push of 1 N along +X", "trigger": "always", "source": "ours"}
    plan = Plan.model_validate(
        {
            "title": "Blown",
            "plan_type": "scene",
            "simulation_parameters": {"time_step": 0.002, "simulation_duration": 1.0, "interventions": [push]},
            "objectives": [{"claim": "It is pushed."}],
            "assets": [{**DRONE, "flies": {**FLIES, "gusts": gusts}}],
        }
    )
    needs = Needs()
    assert "D_FLIER(model, data)" in control(plan, needs)
    (place,) = needs.open_places
    assert "a push of 1 N" in place

"""Models and meshes that a plan brings in are drafted whole, and what is wrong with their files is told by name."""

import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

from worldwright.draft import draft
from worldwright.lint.tools import check_plan
from worldwright.model.errors import PlanError
from worldwright.model.plan import imported
from worldwright.model.plan.plan_text import read_plan
from worldwright.place.checks import check
from worldwright.place.engine import resolve
from worldwright.place.settling import settle

HERE = Path(__file__).parent
ARM = (HERE / "models" / "arm.urdf").read_text()
CHEST = (HERE / "models" / "chest.xml").read_text()
PLAN = (HERE / "models" / "plan.md").read_text()


@pytest.fixture
def run(tmp_path):
    def write(arm=ARM, chest=CHEST, plan=PLAN):
        (tmp_path / "parts").mkdir(exist_ok=True)
        (tmp_path / "arm.urdf").write_text(arm)
        (tmp_path / "parts" / "chest.xml").write_text(chest)
        (tmp_path / "plan.md").write_text(plan)
        return tmp_path / "plan.md"

    return write


def built(path):
    plan = read_plan(path).plan
    made = draft(plan, resolve(plan).scene)
    assert made.complete, made.open_places
    names: dict = {"__name__": "drafted"}
    exec(compile(made.source, "drafted", "exec"), names)
    model = names["build"]().compile()
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    mujoco.mj_forward(model, data)
    return made.source, model, data


def test_models_and_jointed_meshes_are_drafted_whole(run):
    path = run()
    assert [f for f in check_plan(path).findings if f.severity == "error"] == []
    source, model, data = built(path)
    assert model.body("arm_upper").parentid[0] == model.body("arm").id
    assert np.degrees(data.joint("arm_shoulder").qpos[0]) == pytest.approx(20)
    assert np.degrees(data.joint("chest_1_lid_hinge").qpos[0]) == pytest.approx(-60)
    assert data.joint("chest_2").qvel[:3].tolist() == [0, 1.3, 0]
    assert [model.actuator(a).name for a in range(model.nu)] == [
        "chest_1_opener",
        "arm_servo",
    ]  # none that nobody asks for
    assert np.allclose(data.body("arm").xpos, (-0.3, 0, 0.7))  # the base's origin is the model's lowest point
    assert np.allclose(data.body("chest_1").xmat.reshape(3, 3)[:, 0], (0, 1, 0), atol=1e-9)  # facing left
    assert np.allclose(data.body("mug").xpos, (0.9, 0, 1.1)) or model.body("mug").jntnum[0] == 1
    assert model.joint("mug_pivot").bodyid[0] == model.body("mug").id and "<option" not in source
    assert model.geom("chest_2_walls").friction[0] == 0.9


def test_the_layout_knows_the_size_of_a_model(run):
    plan = read_plan(run()).plan
    scene = resolve(plan).scene
    assert scene["arm"].size == pytest.approx((0.2, 0.3, 0.5)) and scene["chest_1"].size == pytest.approx(
        (0.4, 0.2, 0.22)
    )
    assert not [
        f for f in check(plan, resolve(plan), file="p", locate=lambda *p: None).findings if f.severity == "error"
    ]
    moved = {m.name: m for m in settle(plan, scene, file="p", locate=lambda *p: None, duration_s=1.0).objects}
    assert moved["chest_1"].tilt_deg < 0.5 and moved["chest_2"].drop_m < 1e-3


def test_the_draft_is_formatted(run, tmp_path):
    source, _, _ = built(run())
    path = tmp_path / "simulation.py"
    path.write_text(source)
    for command in (["format", "--check", "--diff"], ["check", "--select", "F,W"]):
        options = ["--line-length", "120", "--isolated"]
        done = subprocess.run([sys.executable, "-m", "ruff", *command, *options, path], capture_output=True, text=True)
        assert done.returncode == 0, done.stdout


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"plan": PLAN.replace("parts/chest.xml", "parts/chst.xml")}, "asset `chest`: there is no file parts/chst.xml beside the plan"),
        ({"plan": PLAN.replace("parts/chest.xml", "../chest.xml")}, "asset `chest`: there is no file ../chest.xml beside the plan"),
        ({"plan": PLAN.replace("filename: arm.urdf", "filename: arm")}, "asset `arm` of type urdf: `arm` is not the name of such a file"),
        ({"plan": PLAN.replace("type: mjcf", "type: urdf")}, "chest.xml is not of type urdf"),
        ({"arm": ARM.replace("cylinder", "cylindre")}, "arm.urdf does not load: model arm: a URDF has no element <cylindre>"),
        ({"chest": CHEST.replace("<freejoint/>", "<fridge/>")}, "chest.xml does not load: model chest_1: XML Error: Schema violation: unrecognized element Element 'fridge'"),
        ({"chest": CHEST[:-20]}, "chest.xml does not load: parts/chest.xml:"),
        ({"plan": PLAN.replace("arm_shoulder: {", "arm_sholder: {")}, "arm.urdf has no joint `arm_sholder`"),
        ({"plan": PLAN.replace("name: chest_1_opener", "name: chest_1_closer")}, "chest.xml has no actuator `chest_1_closer`"),
        ({"plan": PLAN.replace("[arm_upper,", "[arm_lower,")}, "arm.urdf has no body `arm_lower`"),
        ({"plan": PLAN.replace("masses: {}", "masses: {arm: 9.0}")}, "`arm` weighs 7 kg by arm.urdf, not 9 kg"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_model_is_told(run, change, told):
    path = run(**change)
    findings = [f for f in check_plan(path).findings if f.code == "WP126"]
    assert any(told in f.message for f in findings), findings
    assert all(f.fix and f.line for f in findings)


def test_a_broken_model_is_told_by_the_layout_and_the_draft_too(run):
    plan = read_plan(run()).plan
    scene = resolve(plan).scene
    broken = read_plan(run(arm=ARM.replace("cylinder", "cylindre"))).plan
    assert any("<cylindre>" in f.message for f in resolve(broken).scene.findings)
    with pytest.raises(PlanError, match="<cylindre>"):
        draft(broken, scene)


def test_a_height_can_only_agree(run):
    fine = read_plan(run(plan=PLAN.replace("- mug: 0.1", "- mug: 0.1\n- arm: 0.5"))).plan
    assert resolve(fine).scene.ok
    other = read_plan(run(plan=PLAN.replace("- mug: 0.1", "- mug: 0.1\n- arm: 0.6"))).plan
    (finding,) = [f for f in resolve(other).scene.findings if "high" in f.message]
    assert "arm.urdf is 0.5 m high as it stands there, not 0.6 m" in finding.message


def test_names_inside_a_model_do_not_hide_those_of_the_plan(run):
    plan = PLAN.replace("arm_upper", "arm_tip").replace("table", "arm_tip")
    path = run(arm=ARM.replace('"upper"', '"tip"'), plan=plan)
    made = read_plan(path).plan
    with pytest.raises(PlanError, match=r"`arm_tip` is in arm\.urdf and in the plan"):
        draft(made, resolve(made).scene)


def test_a_copy_of_a_run_takes_its_models_along(run):
    path = run()
    assert sorted(imported.beside(path.parent)) == ["arm.urdf", "parts/chest.xml"]
    assert imported.beside(path.parent / "parts") == {}


def test_a_model_of_the_catalog_may_have_meshes(run, tmp_path, monkeypatch):
    from worldkit import assets

    catalog = tmp_path / "catalog"
    (catalog / "wedge").mkdir(parents=True)
    (catalog / "mug").symlink_to(assets.catalog_root() / "mug")
    wedge = "v 0 0 0\nv .4 0 0\nv 0 .2 0\nv 0 0 .22\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    (catalog / "wedge" / "wedge.obj").write_text(wedge)
    model = CHEST.replace("<asset>", '<asset><mesh name="wedge" file="wedge.obj"/>').replace(
        '<geom name="walls" type="box" size=".2 .1 .1"', '<geom name="walls" type="mesh" mesh="wedge"'
    )
    (catalog / "wedge" / "chest.xml").write_text(model)
    monkeypatch.setenv("WORLDWRIGHT_CATALOG", str(catalog))
    source, world, _ = built(run(plan=PLAN.replace("parts/chest.xml", "wedge/chest.xml")))
    assert world.nmesh >= 1 and 'folder="wedge"' in source

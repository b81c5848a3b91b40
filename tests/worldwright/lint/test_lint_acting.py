"""A compiled world is held against its plan as it will act: by the engine's own rules, and without a gap."""

import re
from pathlib import Path

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mujoco.introspect import structs

from worldkit import softs
from worldwright.lint import engine, tools
from worldwright.lint.case import plan_with
from worldwright.lint.compiled import planned, touching
from worldwright.lint.compiled.fetch import Outcome
from worldwright.lint.compiled.measure import facts
from worldwright.lint.compiled.view import ModelView
from worldwright.lint.harm import outcome_of
from worldwright.lint.rules.model.acting import soft_differs, standing_differs
from worldwright.lint.rules.model.acting._twins import PLAN, changed
from worldwright.model.errors import JobError
from worldwright.model.storage import StorageError

RULES = Path(engine.__file__).parent / "rules" / "model" / "acting"
GEOM = st.fixed_dictionaries(
    {
        "condim": st.sampled_from((1, 3, 4, 6)),
        "priority": st.sampled_from((0, 0, 2)),
        "friction": st.tuples(*[st.floats(0, 2)] * 3),
        "solref": st.sampled_from(((0.02, 1.0), (0.01, 0.4), (-40000.0, -30.0), (-90000.0, -10.0))),
        "solimp": st.sampled_from(
            ((0.9, 0.95, 0.001, 0.5, 2.0), (0.99, 0.99, 0.001, 0.5, 2.0), (0.2, 0.9, 0.02, 0.5, 2))
        ),
        "solmix": st.sampled_from((1.0, 3.0, 0.0)),
        "margin": st.sampled_from((0.0, 0.01)),
        "adhesion": st.sampled_from((0.0, 5.0)),
        "contype": st.sampled_from((1, 1, 2)),
        "conaffinity": st.sampled_from((1, 3)),
    }
)


def view_of(model: mujoco.MjModel) -> ModelView:
    arrays, texts = facts(model)
    return ModelView(Outcome("compiled", arrays=arrays, texts=texts))


@settings(max_examples=120, deadline=None)
@given(one=GEOM, other=GEOM, paired=st.booleans(), apart=st.booleans(), same_joint=st.booleans())
def test_contacts_are_what_the_engine_makes_of_two_geoms(one, other, paired, apart, same_joint):
    """Two overlapping balls: `mjData.contact` is the judge."""
    spec = mujoco.MjSpec()
    first = spec.worldbody.add_body(name="one")
    first.add_freejoint()
    first.add_geom(name="one", size=(0.1, 0, 0), **one)
    second = (first if same_joint else spec.worldbody).add_body(name="other", pos=(0.15, 0, 0))
    second.add_joint(name="hinge") if same_joint else second.add_freejoint()
    second.add_geom(name="other", size=(0.1, 0, 0), **other)
    if paired:
        spec.add_pair(
            geomname1="one", geomname2="other", condim=4, friction=(0.3, 0.1, 0.2, 0.1, 0.4), solref=(0.03, 0.7)
        )
    if apart:
        spec.add_exclude(bodyname1="one", bodyname2="other")
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    view = view_of(model)
    touches = touching.Touching(view, lambda body: view.texts["names"]["body"][body])
    found = touches.between("one", "other")
    assert len(found) == data.ncon
    assert touches.of_geom(0, "other") == touches.of_geom(1, "one") == found
    for touch in found:
        contact = data.contact[0]
        assert touch.condim == contact.dim
        assert np.allclose(touch.friction, contact.friction)
        assert np.allclose(touch.solref, contact.solref)
        assert np.allclose(touch.solref_friction, contact.solreffriction)
        assert np.allclose(touch.solimp, contact.solimp)
        assert touch.margin == pytest.approx(contact.includemargin)
        assert touch.adhesion == pytest.approx(contact.adhesion)


def test_pairs_against_hopping_act_like_the_contacts_they_replace():
    from worldkit import world

    space: dict = {}
    exec(changed()[0], space)
    model = world.finish(space["build"](), "here")
    assert model.npair > 0
    arrays, texts = facts(model)
    plan = plan_with(PLAN)
    found = engine.check_acting(Outcome("compiled", arrays=arrays, texts=texts), outcome_of(planned.source(plan)), plan)
    assert [f for f in found if f.code.startswith("WM16")] == []


SEEN = (
    r"tex_|skin_|light_|mat_|cam_|site_|sensor_|numeric_|text_|tuple_|key_|name_|names|paths|vis|stat$|.*_rgba|.*_group"
)
DERIVED = (
    r"bvh_|oct_|efm|mapM|mapD|[BMD]_(row|col|diag)|ten_J|flexedge_|.*bvh(adr|num)|.*_treeid|.*invweight0|.*_sameframe"
)
COUNTS = r"n[a-zA-Z]+|flg_|buffer|signature|.*_user|.*adr|.*num$|.*_simple|dof_(parentid|Madr|simplenum|M0|length|jntid|bodyid)"
TOLD_ELSEWHERE = {
    "opt": "by its own fields, below",
    "plugin": "WM163 counts them",
    "plugin_attr": "WM163",
    "actuator_plugin": "WM163",
    "qpos0": "the built pose: WM152, WM168",
    "body_pos": "through home_xpos: WM152, WM162",
    "body_quat": "likewise",
    "body_rootid": "follows from the parents",
    "body_subtreemass": "follows from the masses; WM154",
    "body_margin": "the largest of its geoms'",
    "body_contype": "of its geoms",
    "body_conaffinity": "of its geoms",
    "body_plugin": "WM163",
    "body_jntnum": "joints are compared one by one",
    "body_dofnum": "likewise",
    "geom_size": "through the box around what can be touched and its volume: WM151, WM170",
    "geom_pos": "likewise",
    "geom_quat": "likewise",
    "geom_aabb": "likewise",
    "geom_rbound": "likewise",
    "geom_type": "likewise, as geom_kind",
    "geom_plugin": "WM163",
    "geom_matid": "seen only",
    "geom_castshadow": "seen only",
    "geom_condim": "contacts: touching.GEOM",
    "geom_contype": "contacts",
    "geom_conaffinity": "contacts",
    "geom_priority": "contacts",
    "geom_solmix": "contacts",
    "geom_margin": "contacts",
    "geom_gap": "a contact in the gap carries no force of its own",
    "pair_gap": "likewise",
    "pair_signature": "follows from its geoms",
    "jnt_type": "as joint_kind",
    "jnt_actuatorid": "follows from the actuators",
    "tendon_actuatorid": "follows from the actuators",
    "jnt_solref": "a limit's firmness: softer limits show as WS311 in the recording",
    "jnt_solimp": "likewise",
    "jnt_actfrcrange": "with its flag, which no plan sets",
    "tendon_actfrcrange": "likewise",
    "dof_solref": "of friction, which no plan sets",
    "dof_solimp": "likewise",
    "tendon_solimp_lim": "with solref_lim, which is compared",
    "tendon_solref_fri": "of friction, which no plan sets",
    "tendon_solimp_fri": "likewise",
    "tendon_type": "follows from what it runs over",
    "tendon_width": "seen only",
    "tendon_matid": "seen only",
    "tendon_length0": "follows from its points",
    "tendon_treenum": "follows from its points",
    "eq_solimp": "with solref, which is compared",
    "actuator_ctrlspec": "follows from the kind of gain",
    "actuator_actnum": "follows from the dynamics",
    "actuator_actearly": "half a step of the activation",
    "actuator_history": "with the delay, which is compared",
    "actuator_acc0": "derived",
    "actuator_length0": "derived",
    "actuator_lengthrange": "of muscles, which no plan has",
    "hfield_size": "a height field is no object of a plan: WM169",
    "hfield_nrow": "likewise",
    "hfield_ncol": "likewise",
    "hfield_data": "likewise",
    "tree_bodynum": "derived",
    "tree_dofnum": "derived",
}
"""Fields that no rule here reads by name, and why not."""
OPTIONS_ELSEWHERE = {
    "timestep": "WM155",
    "gravity": "WM155",
    "integrator": "WM155",
    "cone": "either shape of the friction cone is the engine's own; pyramids only make it weaker across",
    "jacobian": "storage",
    "solver": "each solves the same problem, and its iterations are compared",
    "ls_iterations": "the solver's own search",
    "ls_tolerance": "the solver's own search",
    "noslip_tolerance": "with its iterations",
    "ccd_tolerance": "where two convex shapes touch, to a micron",
    "ccd_iterations": "likewise",
    "sdf_initpoints": "signed distance fields are plug-ins: WM163",
    "sdf_iterations": "likewise",
    "magnetic": "read by sensors only",
    "o_margin": "with the flag `override`",
    "o_solref": "likewise",
    "o_solimp": "likewise",
    "o_friction": "likewise",
    "enableflags": "flag by flag",
    "disableflags": "flag by flag",
}


def test_of_two_parts_the_one_that_leans_most_alike_is_named():
    """Built: a level board that sags by half a degree, and a ramp; it is held against the board, however short what is said of the ramp."""

    def world(sag):
        spec = mujoco.MjSpec()
        shelf = spec.worldbody.add_body(name="shelf")
        for name, tilt in (("board", sag), ("ramp", 30)):
            shelf.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_BOX, size=(1, 0.3, 0.1), euler=(0, tilt, 0))
        return view_of(spec.compile())

    built = world(0.56)
    built.planned = world(0)
    (problem,) = standing_differs.check(built)
    assert "board leans by 0.56 degrees where the plan lays it level" in problem.message


def read_by_a_rule() -> str:
    """The source of what judges, with f-strings of fields spelled out."""
    files = [*RULES.glob("*.py"), Path(touching.__file__), RULES.parent / "_planned.py"]
    text = "\n".join(path.read_text(encoding="utf-8") for path in files)
    return text + " ".join(f"tendon_{word}" for word in ("stiffness", "damping", "frictionloss", "armature"))


def test_every_field_of_the_model_is_judged_or_said_not_to_be():
    text = read_by_a_rule()
    fields = [field.name for field in structs.STRUCTS["mjModel"].fields]
    skipped = re.compile(rf"(?:{SEEN}|{DERIVED}|{COUNTS}|mesh_|flex_|tree_bodyadr)")
    open_fields = [
        f for f in fields if not re.search(rf"\b{f}\b", text) and not skipped.match(f) and f not in TOLD_ELSEWHERE
    ]
    assert open_fields == []
    assert set(TOLD_ELSEWHERE) <= set(fields)


def test_every_option_is_judged_or_said_not_to_be():
    text = (RULES / "law_differs.py").read_text(encoding="utf-8")
    options = [field.name for field in structs.STRUCTS["mjOption"].fields]
    assert [o for o in options if f'"{o}"' not in text and o not in OPTIONS_ELSEWHERE] == []


def test_a_bundle_is_judged_without_its_program(tmp_path):
    from worldkit import portable
    from worldwright.lint import tools

    space: dict = {}
    exec(changed("spec.geom('crate').friction[0] = spec.geom('ground').friction[0] = 0.05")[0], space)
    bundle = tmp_path / portable.NAME
    portable.write(space["build"](), bundle)
    found = [f for f in tools.acts_as_planned(bundle, plan_with(PLAN)) if f.severity == "error"]
    assert {f.code for f in found} == {"WM160"} and "0.05" in found[0].message


def test_a_draft_makes_the_planned_world_which_is_not_built_again_and_another_program_is_held_against_one(monkeypatch):
    """Of the planned world nobody asks what its physics costs: it takes no step."""
    plan = plan_with(PLAN)
    mine = Outcome("compiled")
    assert planned.beside(plan, planned.source(plan), lambda: mine, 20.0) == (mine, mine)
    monkeypatch.setattr(planned, "_KEPT", {})
    made, twin = planned.beside(plan, planned.source(plan) + "\n", lambda: mine, 20.0)
    assert made is mine and twin.status == "compiled" and twin.texts["names"]["body"]
    assert twin.pass_s is None and "rehearsed" not in twin.texts
    failed = Outcome("failed")
    assert planned.beside(plan, planned.source(plan), lambda: failed, 20.0) == (failed, twin), "and one that fails, too"


@pytest.mark.parametrize(
    ("error", "lacks"),
    [
        (JobError("making it took more than 4 GB of memory", code="out_of_memory", next_move="free some"), "4 GB"),
        (JobError("[Errno 28] No space left on device", code="disk_full", next_move="free some space"), "No space"),
        (JobError("ModuleNotFoundError: No module named 'manifold3d'", code="crashed"), "'manifold3d'"),
        (StorageError("the kept shapes cannot be written"), "cannot be written"),
    ],
)
def test_what_the_machine_lacks_is_not_the_plans_fault(error, lacks, monkeypatch, tmp_path):
    """Neither in what lint says, nor where a world is to be stamped: nobody knows then whether it acts as planned."""

    def wanting(_):
        raise error

    monkeypatch.setattr(planned, "sculpt_of", wanting)
    monkeypatch.setattr(planned, "_KEPT", {})
    plan = plan_with(PLAN)
    (said,) = engine.check_acting(outcome_of(changed()[0]), planned.world(plan), plan)
    assert said.code == "WM171" and "this machine could not make" in said.message and lacks in said.message
    assert said.fix and "plan" not in said.fix
    world = tmp_path / "world.xml"
    world.write_text("<mujoco/>", encoding="utf-8")
    with pytest.raises(JobError, match="this machine could not make") as told:
        tools.acts_as_planned(world, plan)
    assert lacks in told.value.cause and told.value.next_move


def test_what_the_plan_lacks_is(monkeypatch):
    plan = plan_with(PLAN | {"topology": {"scene_predicates": None}})
    assert planned.world(plan).lacked is None


@pytest.mark.parametrize("status", ["refused", "out_of_memory", "timed_out", "too_large"])
def test_a_world_of_the_plan_that_a_limit_stopped_is_told_as_such(status):
    plan = plan_with(PLAN)
    (said,) = engine.check_acting(outcome_of(changed()[0]), Outcome(status, wall_s=20.0), plan)
    assert "this machine could not make" in said.message and said.fix != "correct the plan"


def test_a_flex_that_bends_by_no_numbers_has_none_of_another():
    spec = mujoco.MjSpec()
    softs.add(spec, "jelly", softs.Jelly(1e5, points=3), size=(0.2, 0.2, 0.2), pos=(0, 0, 1), mass=1)
    softs.add(spec, "cloth", softs.Cloth(1e5, points=3), size=(0.5, 0.5, 0.01), pos=(2, 0, 1), mass=0.1)
    arrays, texts = facts(spec.compile())
    view = ModelView(Outcome("compiled", arrays=arrays, texts=texts))
    sizes = [len(soft_differs._slice(view, "flex_bending", "flex_bendingadr", flex)) for flex in range(2)]
    assert sizes == [0, view.flex_bending.size] and sizes[1] > 0

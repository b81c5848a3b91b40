"""What the rules warn of does happen in the installed simulator: errors, silent no-ops, wrong physics."""

import math

import mujoco
import numpy as np
import pytest

from worldwright.lint import engine
from worldwright.lint.case import Case

RUNNABLE = [
    (rule, index, case)
    for rule in engine.program_rules()
    if rule.code in ("WL101", "WL102", "WL142")
    for index, case in enumerate(rule.BAD)
    if isinstance(case, str) and "worldkit" not in case and "def " not in case
]


@pytest.mark.parametrize(
    ("rule", "index", "case"), RUNNABLE, ids=[f"{rule.code}-{index}" for rule, index, _ in RUNNABLE]
)
def test_bad_names_keywords_and_values_raise(rule, index, case):
    with pytest.raises((AttributeError, TypeError, ImportError)):
        exec(compile(case, rule.name, "exec"), {})


@pytest.mark.parametrize("code", ["WL103", "WL104", "WL105"])
def test_bad_mjcf_does_not_compile_and_good_mjcf_does(code):
    rule = engine.PROGRAM_RULES[code]
    documents = [case.source for case in rule.BAD if isinstance(case, Case)]
    assert documents
    for text in documents:
        with pytest.raises(ValueError, match=r"Schema violation|invalid keyword"):
            mujoco.MjSpec.from_string(text)
    for case in rule.GOOD:
        if isinstance(case, Case):
            mujoco.MjSpec.from_string(case.source)


def test_full_extents_as_geom_size_make_eight_times_the_mass():
    def mass(size):
        spec = mujoco.MjSpec()
        body = spec.worldbody.add_body()
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=size)
        return spec.compile().body_mass[1]

    extents = np.array([0.4, 0.3, 0.2])
    assert mass(extents) == pytest.approx(8 * mass(extents / 2))
    assert mass(extents / 2) == pytest.approx(1000 * extents.prod())


def test_a_scalar_last_identity_turns_a_body_by_half_a_turn():
    spec = mujoco.MjSpec()
    body = spec.worldbody.add_body(quat=(0, 0, 0, 1))
    body.add_geom(size=[0.1, 0, 0], pos=(1, 0, 0))
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.geom_xpos[0] == pytest.approx([-1, 0, 0])


def test_radians_as_a_joint_range_lock_the_joint():
    spec = mujoco.MjSpec()
    body = spec.worldbody.add_body()
    body.add_geom(size=[0.1, 0, 0])
    body.add_joint(range=(-math.pi / 2, math.pi / 2))
    assert math.degrees(spec.compile().jnt_range[0, 1]) == pytest.approx(math.pi / 2)


def fall(**geom):
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[5, 5, 0.1])
    body = spec.worldbody.add_body(pos=(0, 0, 0.2), gravcomp=geom.pop("gravcomp", 0))
    body.add_freejoint()
    body.add_geom(size=[0.1, 0, 0], **geom)
    if geom.pop("flag", False):
        spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    model = spec.compile()
    data = mujoco.MjData(model)
    for _ in range(500):
        mujoco.mj_step(model, data)
    return data.qpos[2]


def test_a_body_without_contact_falls_through_the_floor_and_gravcomp_hangs_in_the_air():
    assert fall() == pytest.approx(0.1, abs=0.01)
    assert fall(contype=0, conaffinity=0) < -3
    assert fall(gravcomp=1) == pytest.approx(0.2, abs=1e-6)


def test_writing_derived_state_moves_nothing():
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><body name='b' pos='0 0 3'><freejoint/><geom size='.1'/></body></worldbody></mujoco>"
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    data.body("b").xpos[2] = 9
    mujoco.mj_forward(model, data)
    assert data.body("b").xpos[2] == pytest.approx(3)


def test_a_long_time_step_breaks_contact():
    """WP102: above half of the contact's time constant a dropped ball sinks deep into the floor."""

    def deepest_penetration(step):
        spec = mujoco.MjSpec()
        spec.option.timestep = step
        spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[5, 5, 0.1])
        body = spec.worldbody.add_body(pos=(0, 0, 0.5))
        body.add_freejoint()
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.05, 0.05, 0.05])
        model = spec.compile()
        data = mujoco.MjData(model)
        deepest = 0.0
        for _ in range(int(2 / step)):
            mujoco.mj_step(model, data)
            deepest = max([deepest, *(-data.contact.dist)]) if data.ncon else deepest
        return deepest

    assert deepest_penetration(0.05) > 3 * deepest_penetration(0.002)

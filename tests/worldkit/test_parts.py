import math

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldkit import bodies, contacts, sliding
from worldkit.parts import SHAPES, Part, laid_out, rotation, turned

LADDER = (
    Part("rail", "box", size=(0.06, 0.03, 2.0), offset=(-0.2, 0, 1.0), count=2, step=(0.4, 0, 0)),
    Part("rung", "cylinder", size=(0.03, 0.03, 0.4), offset=(0, 0, 0.25), deg_y=90, count=7, step=(0, 0, 0.25)),
)
DUMBBELL = (
    Part("handle", "cylinder", size=(0.03, 0.03, 0.2), deg_y=90, mass=1.0),
    Part("plate", "cylinder", size=(0.2, 0.2, 0.05), offset=(-0.125, 0, 0), deg_y=90, mass=5.0, count=2, step=(0.25, 0, 0)),
)  # fmt: skip


def compiled(parts, **common):
    spec = mujoco.MjSpec()
    bodies.compound(spec, "it", parts=parts, **({"pos": (0, 0, 1)} | common))
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    return model, data


def test_a_ladder_is_one_body_centred_on_the_box_around_its_parts():
    whole = laid_out("ladder", LADDER)
    assert whole.extents == pytest.approx((0.46, 0.03, 2.0))
    model, data = compiled(LADDER, pos=(3, 4, 1), mass=8.0)
    assert (model.nbody, model.njnt, model.ngeom) == (2, 1, 9)
    assert [model.geom(i).name for i in range(9)] == ["it/rail_1", "it/rail_2", *(f"it/rung_{k}" for k in range(1, 8))]
    assert np.allclose(data.body("it").xpos, (3, 4, 1))
    assert np.allclose(data.geom("it/rail_1").xpos, (2.8, 4, 1)) and np.allclose(
        data.geom("it/rung_7").xpos, (3, 4, 1.75)
    )
    assert model.body("it").mass[0] == pytest.approx(8.0)
    rails, rungs = 2 * 0.06 * 0.03 * 2.0, 7 * math.pi * 0.015**2 * 0.4
    shared = sum(model.body_mass[1] * v / (rails + rungs) for v in (rails, rungs))
    assert shared == pytest.approx(8.0)


def test_the_inertia_of_a_dumbbell_is_that_of_the_textbook():
    """Solid cylinders and the parallel-axis theorem: Beer and Johnston, Vector Mechanics, appendix on mass moments."""
    model, data = compiled(DUMBBELL)
    assert model.body("it").mass[0] == pytest.approx(11.0)
    about_axis = 1 / 2 * 1.0 * 0.015**2 + 2 * (1 / 2 * 5.0 * 0.1**2)
    across = 1 / 12 * (3 * 0.015**2 + 0.2**2) + 2 * (5 / 12 * (3 * 0.1**2 + 0.05**2) + 5 * 0.125**2)
    assert sorted(model.body_inertia[1]) == pytest.approx(sorted((about_axis, across, across)))
    assert np.allclose(data.body("it").xipos, (0, 0, 1))


def test_an_unevenly_packed_suitcase_leans_to_its_heavy_part():
    suitcase = (
        Part("shell", "box", size=(0.5, 0.25, 0.6), mass=3.0),
        Part("books", "box", size=(0.1, 0.2, 0.3), offset=(0.18, 0, -0.1), mass=9.0),
    )
    whole = laid_out("suitcase", suitcase)
    centre = whole.centre_of_mass(whole.masses())
    assert centre == pytest.approx((9 * 0.18 / 12, 0, -9 * 0.1 / 12))
    _, data = compiled(suitcase)
    assert np.allclose(data.body("it").xipos - data.body("it").xpos, centre)


@settings(max_examples=25, deadline=None)
@given(
    st.lists(
        st.tuples(
            st.sampled_from([s for s in SHAPES if s != "container"]),
            st.tuples(*[st.floats(0.05, 0.5)] * 3),
            st.tuples(*[st.floats(-1, 1)] * 3),
            st.tuples(*[st.floats(-180, 180)] * 3),
        ),
        min_size=1,
        max_size=4,
    ),
    st.floats(-180, 180),
)
def test_the_box_and_the_masses_are_those_of_the_compiled_world(rows, tilt):
    parts = []
    for k, (shape, (x, y, z), offset, (a, b, c)) in enumerate(rows):
        size = {"sphere": (x, x, x), "cylinder": (x, x, z), "capsule": (x, x, x + z)}.get(shape, (x, y, z))
        parts.append(Part(f"p{k}", shape, size=size, offset=offset, deg_x=a, deg_y=b, deg_z=c))
    whole = laid_out("it", parts, tilt)
    model, data = compiled(parts, tilt_deg=tilt, density=500.0)
    masses = whole.masses(density=500.0)
    assert model.body_mass[1] == pytest.approx(sum(masses), rel=1e-6)
    offset = data.body("it").xipos - data.body("it").xpos
    assert np.allclose(offset, whole.centre_of_mass(masses), atol=1e-6)
    # Against the box of the surfaces themselves: points of each shape, put where the compiled world has it.
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 181), np.linspace(0, np.pi, 91))
    ball = np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)], axis=-1).reshape(-1, 3)
    clouds = []
    for g in range(model.ngeom):
        kind, half = mujoco.mjtGeom(model.geom_type[g]), model.geom_size[g]
        if kind == mujoco.mjtGeom.mjGEOM_BOX:
            points = np.array([(i, j, k) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]) * half
        elif kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
            ring = np.stack([np.cos(u[0]), np.sin(u[0]), np.ones(181)], axis=1) * (half[0], half[0], half[1])
            points = np.concatenate([ring, ring * (1, 1, -1)])
        elif kind == mujoco.mjtGeom.mjGEOM_CAPSULE:
            points = np.concatenate([ball * half[0] + (0, 0, s * half[1]) for s in (-1, 1)])
        else:
            points = ball * (half[[0, 0, 0]] if kind == mujoco.mjtGeom.mjGEOM_SPHERE else half)
        clouds.append(points @ data.geom_xmat[g].reshape(3, 3).T + data.geom_xpos[g])
    cloud = np.concatenate(clouds) - (0, 0, 1)
    assert np.allclose(cloud.max(axis=0), np.array(whole.extents) / 2, atol=1e-3)
    assert np.allclose(cloud.min(axis=0), -np.array(whole.extents) / 2, atol=1e-3)


def test_each_part_has_its_own_friction_look_and_grip():
    rubber, steel = contacts.surface(friction=1.1), contacts.surface(friction=0.2, restitution=0.5, time_constant=0.004)
    parts = (
        Part("shell", "box", size=(0.4, 0.2, 0.4), offset=(0, 0, 0.25)),
        Part("foot", "box", size=(0.4, 0.2, 0.05), offset=(0, 0, 0.025), surface=rubber, look="rubber_black"),
        Part("label", "box", size=(0.1, 0.202, 0.1), offset=(0, 0, 0.3), visual_only=True),
    )
    spec = mujoco.MjSpec()
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.worldbody.add_geom(name="ground", type=mujoco.mjtGeom.mjGEOM_PLANE, size=(0, 0, 1), **steel)
    bodies.compound(spec, "it", parts=parts, pos=(0, 0, 0.225), surface=steel, mass=2.0)
    model = spec.compile()
    assert model.geom("it/foot").friction[0] == 1.1 and model.geom("it/shell").friction[0] == 0.2
    assert model.geom("it/shell").solref[0] < 0 < model.geom("it/foot").solref[0]  # no spring of steel under rubber
    assert model.geom("it/foot").matid != model.geom("it/shell").matid
    label = model.geom("it/label")
    assert (label.contype[0], label.conaffinity[0], label.group[0]) == (0, 0, 2)
    assert model.body("it").mass[0] == pytest.approx(2.0)
    assert (
        sliding.add_pairs(spec, model) == 2
    )  # shell and foot on the ground, whose damper counts for both; not the label
    pair = spec.pairs[0]
    assert {pair.geomname1, pair.geomname2} == {"ground", "it/shell"}


def test_shares_of_a_mass():
    light = {"density": 100.0}
    two = (
        Part("a", "box", size=(1, 1, 1), surface=light),
        Part("b", "box", size=(1, 1, 1), offset=(2, 0, 0), surface={"density": 300.0}),
    )
    assert laid_out("it", two).masses() == pytest.approx([100, 300])
    assert laid_out("it", two).masses(8.0) == pytest.approx([2, 6])
    one_known = (two[0], Part("b", "box", size=(1, 1, 1), offset=(2, 0, 0)))
    assert laid_out("it", one_known).masses(8.0) == pytest.approx([4, 4])  # a density is missing: by volume alone
    assert laid_out("it", one_known).masses(8.0, density=300.0) == pytest.approx([2, 6])
    own = (
        Part("a", "box", size=(1, 1, 1), mass=3.0),
        Part("b", "container", size=(1, 1, 1), wall=0.1, offset=(2, 0, 0)),
    )
    masses = laid_out("it", own).masses(8.0)
    assert masses[0] == 3.0 and len(masses) == 6 and sum(masses) == pytest.approx(8.0)
    bin_ = (Part("bin", "container", size=(1, 1, 1), wall=0.1, mass=4.0),)
    assert sum(laid_out("it", bin_).masses()) == pytest.approx(4.0)


@pytest.mark.parametrize(
    ("parts", "mass", "says"),
    [
        ((), None, "compound it: it needs at least one part"),
        ((Part("a", "cube", size=(1, 1, 1)),), None, "part it/a: there is no shape 'cube'; known: box, sphere"),
        ((Part("a", "sphere", size=(1, 1, 2)),), None, r"a sphere is round: write \[d, d, d\]"),
        ((Part("a", "cylinder", size=(1, 2, 2)),), None, r"a cylinder is round: write \[d, d, height\]"),
        ((Part("a", "capsule", size=(1, 1, 0.5)),), None, "includes both caps"),
        ((Part("a", "container", size=(1, 1, 1)),), None, "walls of 0.0 m do not fit"),
        ((Part("a", "box", size=(1, 1, 0)),), None, "every extent must be a positive number"),
        ((Part("a", "box", size=(1, 1, 1)),) * 2, None, "two parts are called it/a"),
        ((Part("a", "box", size=(1, 1, 1), count=3),), None, "3 copies need a `step` or a turn"),
        (DUMBBELL, 9.0, "compound it: its parts weigh 11 kg together, not 9 kg"),
        ((*DUMBBELL, Part("grip", "sphere", size=(0.1, 0.1, 0.1))), 9.0, "leaves nothing of 9 kg for the others"),
    ],
)
def test_what_cannot_be_built_is_said(parts, mass, says):
    with pytest.raises(ValueError, match=says):
        bodies.compound(mujoco.MjSpec(), "it", parts=parts, mass=mass, pos=(0, 0, 1))


def test_copies_go_round_and_quarter_turns_are_exact():
    spokes = (Part("spoke", "box", size=(0.5, 0.05, 0.05), offset=(0.25, 0, 0), count=4, turn_deg=90),)
    centres = [list(s.centre) for s in laid_out("wheel", spokes).solids]
    assert centres == [[0.25, 0, 0], [0, 0.25, 0], [-0.25, 0, 0], [0, -0.25, 0]]
    assert turned(rotation(deg_x=90), (0, 0, 1)) == (0, -1, 0)
    assert turned(rotation(90, 90, 0), (0, 0, 1)) == (0, -1, 0)  # first x, then y


def test_what_is_only_drawn_weighs_nothing():
    model, _ = compiled(LADDER, visual_only=True)
    assert not model.geom_contype.any() and model.body_mass[1] == 0

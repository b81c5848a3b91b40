"""Plants: limbs on springs that hold them as they are drawn, bend as their wood says, and carry leaves that catch the wind."""

import mujoco
import numpy as np
import pytest

from worldkit import plants, scene

STEP = 0.002


def grown(plant, wind=(0.0, 0.0, 0.0), seconds=1.0, **how):
    spec = scene.new("plant", time_step=STEP, setting="outdoor")
    spec.option.density, spec.option.wind = 1.2, wind
    plants.add(spec, plant, name="bough", pos=(1.0, 2.0, 3.0), **how)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    start = data.xpos.copy()
    for _ in range(round(seconds / STEP)):
        mujoco.mj_step(model, data)
    return model, data, start


@pytest.mark.parametrize("kind", [plants.Bough, plants.Tree, plants.Bush])
def test_a_plant_is_as_its_numbers_say_and_hangs_in_calm_air_as_it_is_drawn(kind):
    plant = kind(leaves=120)
    model, data, start = grown(plant, seconds=0.2, yaw_deg=30)
    assert [model.body(b).name for b in range(1, model.nbody)] == sorted(
        plant.bodies("bough"), key=lambda n: model.body(n).id
    )
    assert set(plant.joints("bough")) == {model.joint(j).name for j in range(model.njnt)}
    assert model.body_subtreemass[model.body("bough").id] == pytest.approx(plant.mass_kg, rel=1e-6)
    assert np.abs(data.xpos - start).max() < 1e-5
    assert data.body("bough").xpos == pytest.approx((1, 2, 3))
    assert sum(len(limb.leaves) for limb in plant.limbs) == 120


def test_it_sways_in_the_wind_the_way_that_it_blows_and_less_when_it_is_bare():
    leafy, data, start = grown(plants.Bough(), (6.0, 0.0, 0.0), yaw_deg=90)
    moved = (data.xpos - start)[leafy.body("bough_6").id]
    assert moved[0] > 0.01 and abs(moved[1]) < moved[0]
    bare, data, start = grown(plants.Bough(leaves=0), (6.0, 0.0, 0.0), yaw_deg=90)
    assert 0 < (data.xpos - start)[bare.body("bough_6").id][0] < 0.25 * moved[0]


def test_a_bare_straight_bough_bends_under_a_weight_as_a_beam_does():
    """Tip deflection of a tapered cantilever under F: the sum over its limbs of F (L - x)^2 l / (E I)."""
    plant = plants.Bough(leaves=0, twigs=1, parts=12)
    model, data, _ = grown(plant, seconds=0.0)
    model.opt.gravity[:] = 0
    model.jnt_stiffness[:], model.qpos_spring[:] = model.jnt_stiffness, 0
    tip, force = model.body("bough_12").id, 2.0
    data.xfrc_applied[tip, 2] = force
    before = data.xipos[tip].copy()
    for _ in range(3000):
        mujoco.mj_step(model, data)
    stems = [limb for limb in plant.limbs if limb.name.isdigit()]
    from worldkit.plants.rooted import stiffness

    feet = np.array([limb.foot for limb in stems])
    arm = np.linalg.norm((before - (1, 2, 3) - feet)[:, :2], axis=1)
    expected = sum(force * a**2 / stiffness(plant, limb) for a, limb in zip(arm, stems, strict=True))
    assert (data.xipos[tip] - before)[2] == pytest.approx(expected, rel=0.1)


def test_a_limb_with_one_leaf_shows_it_and_the_lightest_weighs_what_is_told():
    plant = plants.Bough(leaves=1, twigs=1, parts=1, length_m=0.2, diameter_m=0.001)
    model, _, _ = grown(plant, seconds=0.0)
    assert [model.geom(g).name for g in range(model.ngeom) if "foliage" in model.geom(g).name] == [
        "bough_twig1/foliage_young"
    ]
    assert model.body_subtreemass[model.body("bough").id] == pytest.approx(plant.mass_kg, rel=1e-6)


def test_hundreds_of_leaves_cost_no_degree_of_freedom():
    few, many = (grown(plants.Bough(leaves=n), seconds=0.0)[0] for n in (60, 900))
    assert few.nv == many.nv <= 40 and many.nmeshface > 5 * 900


def test_one_seed_grows_one_plant():
    assert plants.Tree().limbs == plants.Tree().limbs != plants.Tree(seed=2).limbs


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"leaves": 5000}, "leaves from 0 to 4000"),
        ({"diameter_m": 0.5}, "under a fifth"),
        ({"leaf_m": 0}, "leaf_m"),
        ({"parts": 0}, "parts from 1 to 120, not 0"),
        ({"parts": 10**9}, "parts from 1 to 120"),
        ({"twigs": 10**9}, "twigs from 1 to 120"),
        ({"twigs": 12.0}, "a whole number of twigs"),
        ({"seed": -1}, "seed from 0"),
        ({"leaves": float("nan")}, "a whole number of leaves"),
        ({"length_m": 1e300}, "length_m is a number from 0.02 to 120"),
        ({"length_m": float("nan")}, "length_m"),
        ({"rises_deg": float("nan")}, "rises_deg"),
        ({"diameter_m": 1e-300}, "diameter_m"),
        ({"damping_s": 1e300}, "damping_s"),
    ],
)
def test_numbers_with_which_none_grows_are_refused(wrong, says):
    with pytest.raises(ValueError, match=says):
        plants.Bough(**wrong)

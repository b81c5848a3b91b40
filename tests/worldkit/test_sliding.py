"""Sliding bodies stay down, stop where Coulomb says, and mix their surfaces as MuJoCo mixes them."""

import tracemalloc

import mujoco
import numpy as np
import pytest

from worldkit import bodies, contacts, motion, moved_shapes, parts, scene, sliding, world

STEP = 0.001


def crate(friction: float = 0.4, other: float = 0.4) -> mujoco.MjSpec:
    floor = contacts.surface(friction=other, restitution=0.2, time_constant=4 * STEP)
    own = contacts.surface(friction=friction, restitution=0.1, time_constant=4 * STEP)
    spec = scene.new("t", time_step=STEP, gravity=(0, 0, -9.81), setting="studio", floor_surface=floor)
    bodies.box(spec, "crate", size=(0.45, 0.35, 0.35), pos=(0, 0, 0.175), mass=12, surface=own)
    return spec


def slide(model: mujoco.MjModel, speed: float = 2.0) -> tuple[float, float, float]:
    """Highest lift in m, way in m, share of rows in contact while it moves."""
    data = mujoco.MjData(model)
    for _ in range(50):
        mujoco.mj_step(model, data)
    data.qvel[0], start, lift, touching = speed, data.qpos[0], 0.0, []
    for _ in range(1000):
        mujoco.mj_step(model, data)
        lift = max(lift, data.qpos[2] - 0.175)
        if abs(data.qvel[0]) > 0.05:
            touching.append(data.nefc > 0)
    return lift, data.qpos[0] - start, float(np.mean(touching or [0.0]))


def test_a_sliding_crate_stays_down_and_stops_where_coulomb_says():
    hops, _, seldom = slide(crate().compile())
    lift, way, often = slide(world.make(lambda: crate(), world.seeded(0)[0]))
    assert hops > 0.003, "the engine's own contact no longer throws it up: this module may go"
    assert lift < 0.0003 and often > 2 * seldom
    assert way == pytest.approx(2.0**2 / (2 * 0.4 * 9.81), rel=0.01)


@pytest.mark.parametrize("restitution", [None, 0.0])
def test_a_firm_contact_that_states_no_rebound_slides_as_well(restitution: float | None):
    def build() -> mujoco.MjSpec:
        floor = contacts.surface(friction=0.4, time_constant=4 * STEP)
        own = contacts.surface(friction=0.4, restitution=restitution, time_constant=4 * STEP)
        spec = scene.new("t", time_step=STEP, gravity=(0, 0, -9.81), setting="studio", floor_surface=floor)
        bodies.box(spec, "crate", size=(0.45, 0.35, 0.35), pos=(0, 0, 0.175), mass=12, surface=own)
        return spec

    hops, _, _ = slide(build().compile())
    lift, way, _ = slide(world.make(build, world.seeded(0)[0]))
    assert hops > 0.003 and lift < 0.0003
    assert way == pytest.approx(2.0**2 / (2 * 0.4 * 9.81), rel=0.01)


def test_it_does_not_creep_on_a_slope():
    def ramp() -> mujoco.MjSpec:
        spec = crate()
        spec.option.gravity = (9.81 * np.sin(np.radians(15)), 0, -9.81 * np.cos(np.radians(15)))
        return spec

    _, way, _ = slide(world.make(ramp, world.seeded(0)[0]), speed=0.0)
    assert way < 3e-4


@pytest.mark.parametrize("firm", [("crate",), ("floor",), ("crate", "floor")])
def test_a_pair_has_what_mujoco_would_have_mixed(firm: tuple[str, ...]):
    def build() -> mujoco.MjSpec:
        spec = crate(friction=0.3, other=0.6)
        for geom in spec.geoms:
            if ("floor" if geom.type == mujoco.mjtGeom.mjGEOM_PLANE else "crate") not in firm:
                geom.solref = (0.006, 1.0)
        return spec

    def touch(model: mujoco.MjModel) -> tuple:
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        one = data.contact[0]
        return tuple(np.concatenate([one.friction, one.solref, one.solimp, [one.dim, one.includemargin]]))

    assert touch(world.make(build, world.seeded(0)[0])) == pytest.approx(touch(build().compile()))


def test_filters_are_kept():
    def build() -> mujoco.MjSpec:
        spec = crate()
        spec.add_exclude(bodyname1="world", bodyname2="crate")
        return spec

    assert world.make(build, world.seeded(0)[0]).npair == 0
    assert sliding.add_pairs(build(), build().compile()) == 0


@pytest.mark.parametrize("surface", [None, contacts.surface(friction=0.4, restitution=0.9, time_constant=4 * STEP)])
def test_soft_and_bouncy_surfaces_are_left_alone(surface: dict | None):
    """The engine's default contact is soft; a bouncy one brakes slip too little to throw anything up."""

    def build() -> mujoco.MjSpec:
        own = {} if surface is None else {"surface": surface}
        spec = scene.new("t", time_step=STEP, gravity=(0, 0, -9.81), setting="studio", floor_surface=surface)
        bodies.sphere(spec, "ball", diameter=0.1, pos=(0, 0, 0.05), mass=1, **own)
        return spec

    assert world.make(build, world.seeded(0)[0]).npair == 0


def test_nameless_geoms_get_a_name():
    def build() -> mujoco.MjSpec:
        spec = crate()
        spec.geoms[-1].name = ""
        return spec

    model = world.make(build, world.seeded(0)[0])
    assert model.npair == 1 and model.pair_geom1[0] != model.pair_geom2[0]


def test_friction_on_the_peg_of_a_top_acts_with_all_its_strength():
    """Slow slip is the whole of its motion. The engine's own contact, at a quarter of the step and of the contact's time
    constant, has the lean pass 20 degrees at 4.16 s, and at 4.14 s with the same time constant."""
    rub = contacts.surface(friction=0.3, torsional=0.0015, rolling=0.0001, time_constant=0.002)

    def build() -> mujoco.MjSpec:
        spec = scene.new("t", time_step=0.0005, floor_surface=rub)
        made = (
            parts.Part("tip", "sphere", size=(0.015,) * 3, offset=(0, 0, 0.0075), mass=0.008, surface=rub),
            parts.Part("disc", "cylinder", size=(0.14, 0.14, 0.024), offset=(0, 0, 0.05), mass=0.255),
            parts.Part("peg", "cylinder", size=(0.015, 0.015, 0.0305), offset=(0, 0, 0.02275), mass=0.006),
            parts.Part("stem", "capsule", size=(0.012, 0.012, 0.066), offset=(0, 0, 0.089), mass=0.008),
            parts.Part(
                "weight", "cylinder", size=(0.016, 0.016, 0.0246), offset=(0.057, 0, 0.05), mass=0.034,
                count=8, turn_deg=45.0,
            ),
        )  # fmt: skip
        bodies.compound(spec, "top", parts=made, pos=(0, 0, 0.061), surface=rub)
        motion.launch(spec, {"top": motion.Launch(angular=(4.0, 0.0, 46.0))})
        return spec

    model = world.make(build, world.seeded(0)[0])
    data = world.start(model)
    top = model.body("top").id
    while data.time < 0.1 or (data.time < 6 and data.xmat[top, 8] > np.cos(np.radians(20))):
        mujoco.mj_step(model, data)
    assert data.time == pytest.approx(4.15, abs=0.06)


@pytest.mark.parametrize("spin", [0.0, 1e-6, 0.1, 1.0, 20.0])
def test_a_ball_that_turns_slowly_and_then_slides_is_not_thrown_up(spin: float):
    rub = contacts.surface(friction=0.4, time_constant=0.002)

    def build() -> mujoco.MjSpec:
        spec = scene.new("t", time_step=0.0005, floor_surface=rub)
        bodies.sphere(spec, "ball", diameter=0.2, mass=0.5, pos=(0, 0, 0.1), surface=rub)
        motion.launch(spec, {"ball": motion.Launch(angular=(0.0, 0.0, spin))})
        return spec

    model = world.make(build, world.seeded(0)[0])
    data = world.start(model)
    for _ in range(200):
        mujoco.mj_step(model, data)
    data.qvel[0] = 3.0  # as something hits it
    highest = 0.0
    for _ in range(1000):
        mujoco.mj_step(model, data)
        highest = max(highest, float(data.qpos[2]))
    assert highest - 0.1 < 0.001


def test_grains_that_are_only_drawn_cost_no_memory_of_their_pairs_and_a_crowd_none_at_all(
    monkeypatch: pytest.MonkeyPatch,
):
    def build() -> mujoco.MjSpec:
        spec = crate()
        moved_shapes.grains(spec, "snow", np.random.default_rng(0).uniform(1, 2, (6000, 3)), 0.01)
        return spec

    model = build().compile()
    tracemalloc.start()
    pairs = sliding._pairs(model)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert len(pairs) == 1 and peak < 20e6  # bytes; all pairs of 6,000 are 288 MB

    def row(count: int) -> mujoco.MjModel:
        spec = crate()
        for i in range(count):
            own = contacts.surface(friction=0.4, restitution=0.1, time_constant=4 * STEP)
            bodies.box(spec, f"b{i}", size=(0.1, 0.1, 0.1), pos=(i, 2, 0.05), mass=1, surface=own)
        return spec.compile()

    few = row(9)
    whole = sliding._pairs(few)
    monkeypatch.setattr(sliding, "MOST_AT_ONCE", 7)
    assert len(whole) == 55 and np.array_equal(whole, sliding._pairs(few))
    assert len(sliding._pairs(row(56))) == 0  # 1,653 are more than MOST

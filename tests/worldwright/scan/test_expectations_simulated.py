"""Expectations on real recordings: joints, tendons, constraints and flexes are found by the names of the program."""

import mujoco
import numpy as np
import pytest
from staged import World, box, empty

from worldkit import contacts, motion
from worldwright.scan.objectives.expecting import measure


def mechanism():
    """A pendulum, a block on a sprung slide, a brick hung up by its middle, and a rope between two of them."""
    spec = empty()
    arm = spec.worldbody.add_body(name="bob", pos=(0, 0, 2))
    arm.add_joint(name="pivot", type=mujoco.mjtJoint.mjJNT_HINGE, axis=(0, 1, 0))
    arm.add_geom(
        type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.02, 0, 0), pos=(0, 0, -0.5), mass=1, contype=0, conaffinity=0
    )
    block = spec.worldbody.add_body(name="block", pos=(2, 0, 1))
    slide = block.add_joint(name="rail", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(1, 0, 0))
    slide.stiffness[0], slide.damping[0] = 50.0, 0.6
    block.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.05, 0.05, 0.05), mass=0.5)
    box(spec, "brick", (-2, 0, 1.5), mass=2.0)
    bolt = spec.add_equality(name="bolt", type=mujoco.mjtEq.mjEQ_CONNECT, name1="brick")
    bolt.objtype, bolt.data[:3] = mujoco.mjtObj.mjOBJ_BODY, 0
    block.add_site(name="near")
    spec.worldbody.add_site(name="post", pos=(1, 0, 1))
    rope = spec.add_tendon(name="rope")
    rope.wrap_site("post")
    rope.wrap_site("near")
    return spec


def test_a_mechanism_does_what_theory_says(tmp_path):
    start = {"pivot": 0.2, "rail": 0.1}
    strength = 15.0

    def control(model, data):
        if data.time == 0:
            for name, value in start.items():
                data.qpos[model.joint(name).qposadr[0]] = value
            return
        mujoco.mj_forward(model, data)
        mine = data.efc_id[: data.ne] == model.equality("bolt").id
        if data.time > 0.4 and np.linalg.norm(data.efc_force[: data.ne][mine]) > strength:
            data.eq_active[model.equality("bolt").id] = 0

    recorded = World(mechanism, control, 4.0, ("bob",)).run(tmp_path)
    t = recorded.t
    after = [0.01, float(t[-1])]
    claims = [
        # A point mass on an arm of 0.5 m: T = 2 pi sqrt((m l^2 + I) / (m g l)).
        ("has_period", {"joint": "pivot", "period_s": 1.4203, "tolerance": 0.01, "window_s": after}),
        ("oscillates", {"joint": "pivot", "min_cycles": 2, "min_amplitude_deg": 11, "window_s": after}),
        # w = 10 rad/s, z = c / (2 m w) = 0.06.
        ("has_period", {"body": "block", "stiffness_n_m": 50, "tolerance": 0.01, "window_s": after}),
        ("rings_down", {"joint": "rail", "damping_ratio": 0.06, "tolerance": 0.05, "window_s": after}),
        ("joint_moves", {"joint": "rail", "min_m": 0.15, "window_s": after}),
        ("shortens", {"tendon": "rope", "min_strain": 0.12}),
        ("breaks", {"constraint": "bolt"}),
        ("breaks_at", {"constraint": "bolt", "load_n": 2 * 9.81, "tolerance": 0.02}),
        ("falls", {"body": "brick", "min_m": 1.2}),
        (
            "happens_before",
            {"first": {"breaks": {"constraint": "bolt"}}, "then": {"falls": {"body": "brick", "min_m": 0.5}}},
        ),
        ("lands_on", {"body": "brick", "support": "ground"}),
        ("spring_becomes_kinetic", {"body": "block", "tolerance": 0.2, "window_s": [0.01, 0.2]}),
    ]
    for name, arguments in claims:
        result = measure(recorded, name, arguments)
        assert result.status == "holds", f"{name}: {result.message}"
    intact = measure(recorded, "stays_intact", {"constraint": "bolt"})
    assert intact.status == "fails" and 0.05 < intact.measured < 0.2


JELLY = """
<mujoco><option timestep="0.002" integrator="discrete"/><worldbody><geom name="ground" type="plane" size="0 0 1"/>
<flexcomp name="jelly" type="grid" count="3 3 3" spacing=".1 .1 .1" pos="0 0 .3" dim="3" mass="5" radius=".01" dof="{dof}">
<elasticity young="2e4" poisson="0.1" damping="0.01"/><contact selfcollide="none"/></flexcomp></worldbody></mujoco>
"""


@pytest.mark.parametrize("dof", ["full", "trilinear"])
def test_a_jelly_is_found_by_its_name_and_returns_to_shape(tmp_path, dof):
    recorded = World(lambda: mujoco.MjSpec.from_string(JELLY.format(dof=dof)), None, 1.5, ("jelly",)).run(tmp_path)
    elastic = {"parts": "jelly", "min_strain": 0.04, "tolerance": 0.5, "for_s": 0.2}
    result = measure(recorded, "returns_to_shape", elastic)
    assert result.status == "holds", result.message
    plastic = measure(recorded, "keeps_new_shape", {"parts": "jelly", "min_strain": 0.1})
    assert plastic.status == "fails", plastic.message


SLOPE = np.radians(30)
TILTED = (np.cos(SLOPE / 2), 0, np.sin(SLOPE / 2), 0)


def playground():
    """Textbook situations side by side, far enough apart not to meet."""
    spec = empty()
    spec.option.timestep = 0.001
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICIT  # a fast top needs the gyroscopic terms
    spec.option.impratio = 10
    spec.geoms[0].condim = 6
    bouncy = contacts.surface(friction=0.3, restitution=0.8, time_constant=0.004)
    rough = contacts.surface(friction=0.3, rolling=1e-6)
    spec.geoms[0].friction[:] = (0.01, 0.001, 1e-6)

    def ball(name, pos, radius=0.05, mass=0.5, surface=rough):
        body = spec.worldbody.add_body(name=name, pos=pos)
        body.add_freejoint()
        body.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(radius, 0, 0), mass=mass, **surface)

    ball("thrown", (0, 0, 1.0))
    ball("rolling", (0, 2, 0.05))
    ball("dropped", (0, 4, 1.05), surface=bouncy)
    ball("cue", (0, 6, 0.5), surface=bouncy)
    ball("target", (0.5, 6, 0.5), surface=bouncy)
    for name in ("cue", "target"):
        spec.body(name).gravcomp = 1.0
    box(spec, "block", (0, 8, 0.05), (0.1, 0.1, 0.05), **rough)
    spec.worldbody.add_geom(
        name="ramp", type=mujoco.mjtGeom.mjGEOM_BOX, size=(2, 0.3, 0.05), pos=(0, 10, 1.5),
        quat=TILTED, friction=(0.2, 0.005, 0.0001),
    )  # fmt: skip
    way, up = np.array([np.cos(SLOPE), 0, -np.sin(SLOPE)]), np.array([np.sin(SLOPE), 0, np.cos(SLOPE)])
    sledge = box(
        spec, "sledge", np.array([0, 10, 1.5]) - 1.5 * way + 0.1 * up, (0.1, 0.1, 0.05), friction=(0.2, 0.005, 0.0001)
    )
    sledge.quat = TILTED
    for k in range(4):
        box(spec, f"domino_{k}", (0.1 * k, 12, 0.1), (0.01, 0.05, 0.1), mass=0.1, friction=(0.5, 0.005, 0.0001))
    top = spec.worldbody.add_body(name="top", pos=(0, 14, 1))
    top.quat = TILTED
    top.add_joint(name="tip", type=mujoco.mjtJoint.mjJNT_BALL)
    top.add_geom(
        type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.1, 0, 0), pos=(0, 0, 0.02), mass=1, contype=0, conaffinity=0
    )
    spin = 60 * np.array([np.sin(SLOPE), 0, np.cos(SLOPE)])
    motion.launch(
        spec,
        {
            "thrown": motion.Launch(linear=(1.0, 0, 3.0)),
            "rolling": motion.Launch(linear=(1.0, 0, 0), angular=(0, 20.0, 0)),
            "cue": motion.Launch(linear=(2.0, 0, 0)),
            "block": motion.Launch(linear=(2.0, 0, 0)),
            "domino_0": motion.Launch(linear=(0.15, 0, 0), angular=(0, 3.0, 0)),
            "tip": motion.Launch(angular=tuple(spin)),
        },
    )
    return spec


TEXTBOOK = [
    ("follows_parabola", {"body": "thrown", "window_s": [0, 0.6], "tolerance": 0.005}),
    ("rises", {"body": "thrown", "min_m": 0.45}),
    ("happens_at", {"event": {"touches": {"bodies": ["thrown", "ground"]}}, "at_s": 0.842, "tolerance_s": 0.005}),
    ("conserves", {"quantity": "energy", "body": "thrown", "window_s": [0, 0.8], "tolerance": 0.005}),
    ("height_becomes_kinetic", {"body": "thrown", "window_s": [0.35, 0.8], "tolerance": 0.01}),
    ("rolls_without_slipping", {"body": "rolling", "radius_m": 0.05, "tolerance": 0.02}),
    ("moves_straight", {"body": "rolling", "tolerance": 0.001, "min_m": 1}),
    ("keeps_speed", {"body": "rolling", "tolerance": 0.02}),
    ("rebounds", {"bodies": ["dropped", "ground"], "restitution": 0.8, "tolerance": 0.05}),
    ("bounces", {"body": "dropped", "min_count": 3, "decays": True}),
    ("dissipates", {"body": "dropped", "min_share": 0.5, "tolerance": 0.05}),
    ("lands_on", {"body": "dropped", "support": "ground"}),
    ("leaves", {"bodies": ["dropped", "ground"], "for_s": 0.5}),
    ("exchanges", {"body": "cue", "other": "target", "min_share": 0.75}),
    ("conserves", {"quantity": "momentum", "bodies": ["cue", "target"], "around_contact": ["cue", "target"], "tolerance": 0.01}),
    ("rebounds", {"bodies": ["cue", "target"], "restitution": 0.8, "tolerance": 0.05}),
    ("receives_impulse", {"body": "target", "other": "cue", "direction": [1, 0, 0], "min_n_s": 0.85, "max_n_s": 0.95}),
    ("slides_and_stops", {"body": "block", "friction": 0.3, "tolerance": 0.05}),
    ("slides", {"bodies": ["block", "ground"], "min_m": 0.6}),
    ("accelerates_at", {"body": "block", "m_s2": -0.3 * 9.81, "tolerance": 0.05, "window_s": [0.05, 0.6]}),
    ("accelerates_at", {"body": "sledge", "m_s2": 3.206, "tolerance": 0.05, "window_s": [0.3, 0.9]}),
    ("slides", {"bodies": ["sledge", "ramp"], "min_m": 1.0}),
    ("lands_on", {"body": "sledge", "support": "ramp", "window_s": [0, 0.9]}),
    ("never_touches", {"bodies": ["dropped", "ramp"]}),
    ("precesses", {"body": "top", "arm_m": 0.02, "tolerance": 0.03, "window_s": [0.2, 2.0], "min_turns": 0.2}),
    ("spins_at_constant_rate", {"body": "top", "tolerance": 0.02, "rate_rad_s": 60}),
    ("tips_over", {"body": "domino_3", "min_tilt_deg": 60}),
    (
        "happens_in_order",
        {"events": [{"tips_over": {"body": f"domino_{k}", "min_tilt_deg": 20}} for k in range(4)], "min_s": 0.01},
    ),
    ("slower_than", {"body": "block", "other": "thrown"}),
    ("pushes_with", {"bodies": ["block", "ground"], "of": "mean", "min_n": 9.3, "max_n": 10.3}),
]  # fmt: skip
FALSE = [
    ("follows_parabola", {"body": "thrown", "g_m_s2": 1.62, "window_s": [0, 0.6]}),
    ("rolls_without_slipping", {"body": "block", "radius_m": 0.05, "tolerance": 0.2, "window_s": [0, 0.5]}),
    ("rebounds", {"bodies": ["dropped", "ground"], "restitution": 0.5}),
    ("slides_and_stops", {"body": "rolling"}),
    ("slides_and_stops", {"body": "block", "friction": 0.2}),
    ("precesses", {"body": "top", "rate_rad_s": 10, "window_s": [0.2, 2.0]}),
    ("happens_before", {"first": {"tips_over": {"body": "domino_3", "min_tilt_deg": 20}}, "then": {"tips_over": {"body": "domino_1", "min_tilt_deg": 20}}}),
    ("touches", {"bodies": ["block", "ramp"]}),
    ("lands_on", {"body": "dropped", "support": "ramp"}),
    ("exchanges", {"body": "target", "other": "cue", "min_share": 0.5}),
    ("stays_upright", {"body": "domino_2", "max_tilt_deg": 20}),
    ("sticks", {"bodies": ["dropped", "ground"]}),
]  # fmt: skip


@pytest.fixture(scope="module")
def played(tmp_path_factory):
    return World(playground, None, 2.0, ("thrown",)).run(tmp_path_factory.mktemp("playground"))


@pytest.mark.parametrize(("name", "arguments"), TEXTBOOK, ids=[n for n, _ in TEXTBOOK])
def test_the_engine_agrees_with_the_textbook(played, name, arguments):
    result = measure(played, name, arguments)
    assert result.status == "holds", result.message


@pytest.mark.parametrize(("name", "arguments"), FALSE, ids=[n for n, _ in FALSE])
def test_what_the_engine_does_not_do_is_refuted(played, name, arguments):
    result = measure(played, name, arguments)
    assert result.status == "fails", result.message

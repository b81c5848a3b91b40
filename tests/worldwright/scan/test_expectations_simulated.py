"""Expectations on real recordings: joints, tendons, constraints and flexes are found by the names of the program."""

import mujoco
import numpy as np
import pytest
from staged import World, box, empty

from worldwright.scan.expecting import measure


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

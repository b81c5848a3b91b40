"""The last pin of a linkage holds, and the linkage moves as its geometry says."""

import mujoco
import numpy as np
import pytest

from worldkit import bodies, joints, loops, motion, portable

CRANK, COUPLER, ROCKER, GROUND = 0.1, 0.3, 0.25, 0.3
"""A crank-rocker by Grashof: shortest and longest link are together shorter than the other two."""


def closed_form(crank: float) -> tuple[np.ndarray, np.ndarray]:
    """Pins B (crank and coupler) and C (coupler and rocker), (x, z) m, for the angle of the crank, rad.

    Source: R. L. Norton, Design of Machinery, position analysis of four-bar linkages: C is where the circles of the coupler
    about B and of the rocker about D meet; the open branch is the upper one.
    """
    b, d = CRANK * np.array((np.cos(crank), np.sin(crank))), np.array((GROUND, 0.0))
    between = d - b
    distance = np.linalg.norm(between)
    along = (COUPLER**2 - ROCKER**2 + distance**2) / (2 * distance)
    up = np.sqrt(COUPLER**2 - along**2)
    return b, b + along * between / distance + up * np.array((-between[1], between[0])) / distance


def linkage(kind: str = "hinge", gravity: float = 0.0, crank: float = 1.0) -> mujoco.MjSpec:
    """Three bars in the plane y = 0, one metre up; the pin at C closes the loop."""
    spec = mujoco.MjSpec()
    spec.option.timestep = 0.0005
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.gravity = (0, 0, gravity)
    b, c = (np.array((p[0], 0, 1 + p[1])) for p in closed_form(crank))
    a, d = np.array((0, 0, 1)), np.array((GROUND, 0, 1))
    for name, start, end, parent in (("crank", a, b, None), ("coupler", b, c, "crank"), ("rocker", d, c, None)):
        middle, bar = (start + end) / 2, end - start
        pin = joints.Hinge(f"{name}_pin", anchor=tuple(start), axis=(0, -1, 0))
        body = bodies.box(spec, name, size=(0.01, 0.01, 0.01), pos=tuple(middle), mass=0.1, parent=parent, joint=pin)
        half = np.linalg.norm(bar) / 2
        turn = np.arctan2(bar[0], bar[2]) / 2
        body.geoms[0].size, body.geoms[0].quat = (0.005, 0.005, half), (np.cos(turn), 0, np.sin(turn), 0)
        body.geoms[0].contype = body.geoms[0].conaffinity = 0
    if kind == "hinge":
        loops.hinge(spec, "pin", child="rocker", parent="coupler", anchor=tuple(c), axis=(0, -1, 0))
    else:
        loops.ball(spec, "pin", child="rocker", parent="coupler", anchor=tuple(c))
    return spec


@pytest.mark.parametrize("kind", ["hinge", "ball"])
def test_a_four_bar_linkage_moves_as_its_coupler_geometry_says(kind):
    spec = linkage(kind)
    motor = spec.add_actuator(name="motor", target="crank_pin", trntype=mujoco.mjtTrn.mjTRN_JOINT)
    motor.set_to_velocity(kv=0.1)
    model = spec.compile()
    data = mujoco.MjData(model)
    data.ctrl[:] = 3.0
    worst, angles, swings = 0.0, [], []
    while data.time < 4.0:
        mujoco.mj_step(model, data)
        mujoco.mj_kinematics(model, data)
        crank = 1.0 + data.joint("crank_pin").qpos[0]
        _, c = closed_form(crank)
        rocker, half = data.geom("rocker"), model.geom("rocker").size[2]
        tip = rocker.xpos + half * rocker.xmat.reshape(3, 3)[:, 2]
        worst = max(worst, float(np.linalg.norm(tip - (c[0], 0, 1 + c[1]))))
        angles.append(crank)
        swings.append(np.arctan2(c[1], c[0] - GROUND))
    assert np.ptp(angles) > 2 * np.pi  # all the way round
    assert worst < 2e-5  # of links of 0.1 to 0.3 m
    assert 0.3 < np.ptp(swings) < 2  # the rocker rocks


def test_energy_is_kept_while_gravity_swings_the_linkage():
    model = linkage(gravity=-9.81, crank=0.3).compile()
    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    start, fastest = data.energy.sum(), 0.0
    while data.time < 1.0:
        mujoco.mj_step(model, data)
        fastest = max(fastest, data.energy[1])
    assert fastest > 0.05 and abs(data.energy.sum() - start) < 0.03 * fastest


def two(**of_second):
    spec = mujoco.MjSpec()
    bodies.box(spec, "post", size=(0.1, 0.1, 1), pos=(0, 0, 0.5), fixed=True)
    bodies.box(spec, "arm", size=(0.6, 0.1, 0.1), pos=(0.3, 0, 1.05), **of_second)
    return spec


def settled(spec, seconds=1.0):
    model = spec.compile()
    data = mujoco.MjData(model)
    start = data.body("arm").xpos.copy()
    mujoco.mj_kinematics(model, data)
    start = data.body("arm").xpos.copy()
    while data.time < seconds:
        mujoco.mj_step(model, data)
    return model, data, start


def test_a_weld_keeps_the_pose_and_a_hinge_lets_it_turn():
    spec = two()
    loops.weld(spec, "glue", child="arm", parent="post")
    _, data, start = settled(spec)
    assert np.allclose(data.body("arm").xpos, start, atol=1e-3) and data.body("arm").xmat[0] > 0.9999
    spec = two()
    loops.hinge(spec, "pin", child="arm", parent="post", anchor=(0, 0, 1.05), axis=(0, 1, 0))
    model, data, start = settled(spec, 0.4)
    assert (model.neq, model.nexclude) == (2, 1)
    assert [model.equality(e).name for e in range(2)] == ["pin", "pin_2"]
    assert np.hypot(*(data.body("arm").xpos - (0, 0, 1.05))[[0, 2]]) == pytest.approx(0.3, abs=1e-3)
    assert data.body("arm").xpos[2] < 0.9 and abs(data.body("arm").xpos[1]) < 1e-3
    assert abs(data.body("arm").xmat[4]) > 0.9999  # it turns about y alone


def test_a_loop_to_the_world_takes_a_body_turned_and_named():
    spec = two(yaw_deg=30)
    loops.ball(spec, "hang", child="arm", anchor=(0.3, 0, 1.05))
    model, data, start = settled(spec)
    assert np.allclose(data.body("arm").xpos, start, atol=1e-3) and model.nexclude == 0


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda s: loops.ball(s, "pin", child="amr"), "loop pin: there is no body 'amr'; known: post, arm"),
        (lambda s: loops.weld(s, "pin", child="arm", parent="pots"), "there is no body 'pots'"),
        (lambda s: loops.hinge(s, "pin", child="arm", axis=(0, 0, 0)), "its axis has no direction"),
    ],
)
def test_what_cannot_be_tied_is_said(call, says):
    with pytest.raises(ValueError, match=says):
        call(two())


def started(speed):
    spec = linkage()
    motion.launch(spec, {"crank_pin": motion.Launch(velocity=speed)})
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    mujoco.mj_forward(model, data)
    return model, data


def test_the_rest_of_a_linkage_starts_with_the_pin_that_is_given_a_speed():
    model, data = started(2.0)
    step = 1e-6
    ends = [closed_form(1.0 + s * step) for s in (-1, 1)]
    angle = [np.arctan2(c[1], c[0] - GROUND) for _, c in ends]
    tilt = [np.arctan2(*(c - b)[::-1]) for b, c in ends]
    rocker, coupler = (2.0 * (v[1] - v[0]) / (2 * step) for v in (angle, tilt))
    assert data.joint("crank_pin").qvel[0] == 2.0
    assert data.joint("rocker_pin").qvel[0] == pytest.approx(rocker, rel=1e-5)
    assert data.joint("coupler_pin").qvel[0] == pytest.approx(coupler - 2.0, rel=1e-5)
    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY)
    mujoco.mj_forward(model, data)
    before = data.energy[1]
    for _ in range(20):
        mujoco.mj_step(model, data)
    assert data.energy[1] == pytest.approx(before, rel=2e-3)  # no blow at the start


def test_without_a_loop_nothing_else_is_started():
    spec = two()
    bodies.box(spec, "bob", size=(0.1, 0.1, 0.1), pos=(2, 0, 1), joint=joints.Hinge("swing", axis=(0, 1, 0)))
    motion.launch(spec, {"swing": motion.Launch(velocity=1.0)})
    assert np.count_nonzero(spec.key("start").qvel) == 1
    spec = two()  # what is glued and thrown is started part by part
    bodies.sphere(spec, "ball", diameter=0.1, pos=(0.3, 0, 1.15))
    loops.weld(spec, "glue", child="ball", parent="arm")
    motion.launch(spec, {"arm": motion.Launch(linear=(1, 0, 0))})
    assert np.count_nonzero(spec.key("start").qvel) == 1


@pytest.mark.parametrize("kind", ["ball", "hinge", "weld"])
def test_a_loop_survives_being_written_as_one_file(kind, tmp_path):
    spec = mujoco.MjSpec()
    bodies.box(spec, "plank", size=(1, 0.1, 0.04), pos=(0, 0, 1), mass=2, joint=joints.Hinge("pin", axis=(0, 1, 0)))
    getattr(loops, kind)(spec, "end", child="plank")
    assert portable.write(spec, tmp_path / "world.mjz")["rounded"] == {}

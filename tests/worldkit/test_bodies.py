import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldkit import bodies, joints

extent = st.floats(0.02, 3.0)
angle = st.floats(-360, 360)
coordinate = st.floats(-5, 5)


def compiled(spec):
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


@given(st.tuples(extent, extent, extent), st.tuples(coordinate, coordinate, coordinate), angle)
@settings(max_examples=30, deadline=None)
def test_a_box_has_the_extents_centre_and_yaw_it_was_asked_for(size, pos, yaw):
    spec = mujoco.MjSpec()
    bodies.box(spec, "crate", size=size, pos=pos, yaw_deg=yaw, mass=2.5)
    model, data = compiled(spec)
    assert np.allclose(model.geom("crate").size * 2, size)
    assert np.allclose(data.body("crate").xpos, pos)
    rotation = data.body("crate").xmat.reshape(3, 3)
    assert np.allclose(rotation[:2, 0], [np.cos(np.radians(yaw)), np.sin(np.radians(yaw))], atol=1e-9)
    assert model.body("crate").mass == pytest.approx(2.5)


@given(angle, angle, st.tuples(coordinate, coordinate, coordinate))
@settings(max_examples=30, deadline=None)
def test_a_child_keeps_its_world_pose_whatever_its_parent_does(parent_yaw, yaw, pos):
    spec = mujoco.MjSpec()
    bodies.box(spec, "base", size=(1, 1, 1), pos=(1, -2, 0.5), yaw_deg=parent_yaw, fixed=True)
    bodies.sphere(spec, "knob", diameter=0.1, pos=pos, yaw_deg=yaw, parent="base")
    _, data = compiled(spec)
    assert np.allclose(data.body("knob").xpos, pos)
    rotation = data.body("knob").xmat.reshape(3, 3)
    assert np.allclose(rotation[:2, 0], [np.cos(np.radians(yaw)), np.sin(np.radians(yaw))], atol=1e-9)


def test_hinge_anchor_and_axis_are_given_in_the_world_frame():
    spec = mujoco.MjSpec()
    pivot = joints.Hinge("pivot", anchor=(0, 0, 2), axis=(0, 1, 0), damping=0.25, range_deg=(-90, 90))
    bodies.box(spec, "arm", size=(0.1, 0.1, 1), pos=(0, 0, 1.5), yaw_deg=90, joint=pivot)
    model, data = compiled(spec)
    assert np.allclose(data.joint("pivot").xanchor, [0, 0, 2])
    assert np.allclose(data.joint("pivot").xaxis, [0, 1, 0])
    assert model.dof_damping.ravel()[0] == pytest.approx(0.25)
    assert np.allclose(np.degrees(model.joint("pivot").range), [-90, 90])


def test_a_slide_spring_rests_where_it_says():
    spec = mujoco.MjSpec()
    spring = joints.Slide("spring", axis=(0, 0, 1), stiffness=100.0, damping=5.0, rest_m=0.0)
    bodies.box(spec, "bob", size=(0.1, 0.1, 0.1), pos=(0, 0, 1), mass=1.0, joint=spring)
    model, data = compiled(spec)
    for _ in range(5000):
        mujoco.mj_step(model, data)
    assert data.body("bob").xpos[2] == pytest.approx(1 - 9.81 / 100, abs=1e-3)


def test_container_is_hollow_and_has_the_outer_extents():
    spec = mujoco.MjSpec()
    bodies.container(spec, "tray", size=(1.0, 0.6, 0.2), wall=0.05, pos=(0, 0, 0.1), fixed=True, mass=3.0)
    bodies.sphere(spec, "pea", diameter=0.04, pos=(0, 0, 0.3))
    model, data = compiled(spec)
    boxes = [i for i in range(model.ngeom) if model.geom(i).name.startswith("tray")]
    low = min((data.geom_xpos[i] - model.geom_size[i])[0] for i in boxes)
    high = max((data.geom_xpos[i] + model.geom_size[i])[1] for i in boxes)
    assert (low, high) == pytest.approx((-0.5, 0.3))
    assert model.body("tray").mass == pytest.approx(3.0)
    for _ in range(1000):
        mujoco.mj_step(model, data)
    assert 0.05 < data.body("pea").xpos[2] < 0.08


def test_impossible_shapes_are_refused_by_name():
    spec = mujoco.MjSpec()
    with pytest.raises(ValueError, match="capsule pill"):
        bodies.capsule(spec, "pill", diameter=0.2, height=0.1, pos=(0, 0, 0))
    with pytest.raises(ValueError, match="container tub"):
        bodies.container(spec, "tub", size=(0.1, 0.1, 0.1), wall=0.2, pos=(0, 0, 0))
    with pytest.raises(ValueError, match=r"no_such.*known: none"):
        bodies.box(spec, "crate", size=(1, 1, 1), pos=(0, 0, 0), parent="no_such")


def test_visual_only_bodies_touch_nothing_and_weigh_nothing():
    spec = mujoco.MjSpec()
    bodies.sphere(spec, "ghost", diameter=0.3, pos=(0, 0, 1), visual_only=True)
    model, _ = compiled(spec)
    assert model.nv == 0
    assert model.geom("ghost").contype[0] == model.geom("ghost").conaffinity[0] == 0
    assert model.body("ghost").mass[0] == 0


@given(st.floats(-180, 180), angle)
@settings(max_examples=30, deadline=None)
def test_a_tilted_shape_is_turned_about_its_own_x_before_the_yaw(tilt, yaw):
    spec = mujoco.MjSpec()
    bodies.cylinder(spec, "log", diameter=0.2, height=1.0, pos=(1, 2, 3), yaw_deg=yaw, tilt_deg=tilt)
    _, data = compiled(spec)
    along = data.geom("log").xmat.reshape(3, 3)[:, 2]
    s, c = np.sin(np.radians(tilt)), np.cos(np.radians(tilt))
    yawed = np.radians(yaw)
    assert np.allclose(along, [s * np.sin(yawed), -s * np.cos(yawed), c], atol=1e-5)
    assert np.allclose(data.geom("log").xpos, (1, 2, 3))
    with pytest.raises(ValueError, match="cannot be tilted"):
        bodies.container(spec, "tub", size=(1, 1, 1), wall=0.1, pos=(0, 0, 0), tilt_deg=10)


@pytest.mark.parametrize("hollow", [False, True])
def test_a_hollow_ball_has_the_inertia_of_its_shell(hollow):
    spec = mujoco.MjSpec()
    bodies.sphere(spec, "ball", diameter=0.22, pos=(0, 0, 1), mass=0.43, hollow=hollow)
    model, _ = compiled(spec)
    assert model.body("ball").inertia == pytest.approx(np.full(3, (2 / 3 if hollow else 2 / 5) * 0.43 * 0.11**2))


def test_a_hollow_body_without_a_mass_is_refused():
    with pytest.raises(ValueError, match="a hollow body needs its mass"):
        bodies.sphere(mujoco.MjSpec(), "ball", diameter=0.22, pos=(0, 0, 1), density=65.0, hollow=True)

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldkit import cameras, moved_shapes

coordinate = st.floats(-4, 4)
SPHERE, BOX, PLANE = mujoco.mjtGeom.mjGEOM_SPHERE, mujoco.mjtGeom.mjGEOM_BOX, mujoco.mjtGeom.mjGEOM_PLANE


def add(spec, name, kind, size, pos, free=True):
    body = spec.worldbody.add_body(name=name, pos=pos)
    if free:
        body.add_freejoint()
    body.add_geom(name=name, type=kind, size=size)
    return body


def posed(model, positions=None):
    """Data with free bodies at `positions` and cameras up to date."""
    data = mujoco.MjData(model)
    for number, place in enumerate([] if positions is None else positions):
        joint = model.body_jntadr[number + 1]
        if joint >= 0:
            data.qpos[model.jnt_qposadr[joint] :][:3] = place
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_camlight(model, data)
    return data


def project(model, data, camera, points):
    """Normalised image coordinates (N, 2), -1 to 1 inside the frame, of a 16:9 picture."""
    number = model.camera(camera).id
    local = (points - data.cam_xpos[number]) @ data.cam_xmat[number].reshape(3, 3)
    slope = np.tan(np.radians(model.cam_fovy[number]) / 2)
    depth = -local[:, 2]
    assert (depth > 0).all()
    return np.column_stack([local[:, 0] / depth / slope / (16 / 9), local[:, 1] / depth / slope])


def corners(centres, half):
    signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
    return (np.asarray(centres)[:, None] + signs * half).reshape(-1, 3)


@pytest.mark.parametrize("view", cameras.VIEWS)
@given(
    path=st.lists(st.tuples(coordinate, coordinate, st.floats(0.1, 4)), min_size=1, max_size=6),
    radius=st.floats(0.03, 0.4),
    others=st.lists(st.tuples(coordinate, coordinate, st.floats(0.05, 0.5)), max_size=3),
)
@settings(max_examples=8, deadline=None)
def test_every_view_frames_its_subject_with_a_margin_from_above_the_ground(view, path, radius, others):
    path = np.add(path, (0, 0, radius))
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(type=PLANE, size=(0, 0, 1))
    add(spec, "ball", SPHERE, (radius, 0, 0), path[0])
    for number, (x, y, half) in enumerate(others):
        add(spec, f"crate{number}", BOX, (half, half, half), (x, y, half), free=False)
    cameras.add(spec, "eye", view=view, subjects=("ball",))
    model = spec.compile()
    positions = np.tile(posed(model).xpos[None, 1:], (len(path), 1, 1))
    positions[:, 0] = path
    cameras.aim(model, positions)
    seen = []
    for place in positions:
        data = posed(model, place)
        cameras.track(model, data)
        assert data.cam_xpos[0][2] > 0.02
        seen.append(project(model, data, "eye", corners(place[:1], 0.577 * radius)))
    assert np.abs(np.concatenate(seen)).max() < 0.97


def test_the_frame_is_filled_not_wasted():
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(type=PLANE, size=(0, 0, 1))
    add(spec, "ball", SPHERE, (0.1, 0, 0), (-1, 0, 0.1))
    cameras.add(spec, "eye", view="side_minus_y", subjects=("ball",))
    model = spec.compile()
    positions = np.array([[[-1.0, 0, 0.1]], [[1.0, 0, 0.1]]])
    cameras.aim(model, positions)
    assert np.abs(project(model, posed(model), "eye", positions[:, 0])[:, 0]).max() > 0.55


def test_a_long_way_is_seen_from_its_side_and_legibly():
    spec = mujoco.MjSpec()
    add(spec, "ball", SPHERE, (0.05, 0, 0), (0, 0, 0.05))
    cameras.add(spec, "eye", subjects=("ball",))
    model = spec.compile()
    positions = np.zeros((50, 1, 3))
    positions[:, 0, 0], positions[:, 0, 2] = np.linspace(0, 40, 50), 0.05
    cameras.aim(model, positions)
    for place in positions[::10]:
        data = posed(model, place)
        cameras.track(model, data)
        image = project(model, data, "eye", corners(place[:1], 0.05))
        assert np.ptp(image[:, 1]) / 2 > 0.05, "a ball that crosses 800 radii must stay readable"
        assert np.abs(image).max() < 0.9


def test_a_swinging_body_is_framed_by_its_orientation():
    spec = mujoco.MjSpec()
    arm = spec.worldbody.add_body(name="arm", pos=(0, 0, 2))
    arm.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=(0, 1, 0))
    arm.add_geom(type=SPHERE, size=(0.05, 0, 0), pos=(0, 0, -1))
    cameras.add(spec, "eye", view="side_minus_y", subjects=("arm",))
    model = spec.compile()
    angles = np.linspace(-0.4, 0.4, 9)
    positions = np.tile([[[0.0, 0, 2]]], (9, 1, 1))
    turns = np.stack([np.cos(angles / 2), 0 * angles, np.sin(angles / 2), 0 * angles], -1)[:, None]
    cameras.aim(model, positions)
    loose = model.camera("eye").pos.copy()
    cameras.aim(model, positions, orientations=turns)
    bobs = np.stack([-np.sin(angles), 0 * angles, 2 - np.cos(angles)], -1)
    assert np.abs(project(model, posed(model), "eye", corners(bobs, 0.03))).max() < 0.95
    assert -model.camera("eye").pos[1] < 0.6 * -loose[1]


def test_a_wall_in_the_way_turns_the_camera_aside():
    spec = mujoco.MjSpec()
    add(spec, "ball", SPHERE, (0.1, 0, 0), (0, 0, 0.1))
    add(spec, "wall", BOX, (0.3, 0.025, 0.4), (0, -0.3, 0.4), free=False)
    cameras.add(spec, "eye", view="side_minus_y", subjects=("ball",))
    model = spec.compile()
    cameras.aim(model)
    data = posed(model)
    place = data.cam_xpos[0].copy()
    ray = np.array([0, 0, 0.1]) - place
    number = np.zeros(1, np.int32)
    mujoco.mj_ray(model, data, place, ray / np.linalg.norm(ray), None, True, -1, number)
    assert model.geom(number[0]).name == "ball"


def test_a_table_is_shown_with_what_stands_on_it():
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(type=PLANE, size=(0, 0, 1))
    add(spec, "table", BOX, (0.6, 0.4, 0.02), (0, 0, 0.7), free=False)
    for number, (x, y) in enumerate([(-0.4, -0.2), (0.4, 0.2), (0.3, -0.25)]):
        add(spec, f"ball{number}", SPHERE, (0.06, 0, 0), (x, y, 0.78))
    cameras.add(spec, "eye")
    model = spec.compile()
    cameras.aim(model)
    assert np.abs(project(model, posed(model), "eye", corners([(0, 0, 0.7)], (0.6, 0.4, 0.02)))).max() < 1.0


def test_a_following_camera_keeps_its_subject_centred():
    spec = mujoco.MjSpec()
    add(spec, "ball", SPHERE, (0.1, 0, 0), (0, 0, 0.1))
    cameras.add(spec, "eye", view="side_minus_y", subjects=("ball",), follow=True)
    model = spec.compile()
    positions = np.array([[[x, 0, 0.1]] for x in np.linspace(0, 3, 20)])
    cameras.aim(model, positions)
    places = []
    for place in positions[[0, 19]]:
        data = posed(model, place)
        cameras.track(model, data)
        places.append(project(model, data, "eye", place)[0])
    assert np.allclose(places[0], places[1], atol=1e-6)


def test_explicit_cameras_stay_where_they_are_put():
    spec = mujoco.MjSpec()
    add(spec, "ball", SPHERE, (0.1, 0, 0), (1, 0, 0.1))
    cameras.add(spec, "eye", position=(0, -3, 2), target=(0, 0, 0))
    model = spec.compile()
    cameras.aim(model)
    assert np.allclose(model.camera("eye").pos, [0, -3, 2])
    assert np.allclose(project(model, posed(model), "eye", np.zeros((1, 3))), 0, atol=1e-9)


def test_aiming_twice_and_after_reloading_gives_the_same_camera():
    spec = mujoco.MjSpec()
    add(spec, "ball", SPHERE, (0.1, 0, 0), (1, 0, 0.1))
    cameras.add(spec, "eye", subjects=("ball",))
    model = spec.compile()
    positions = np.array([[[0.0, 0, 0.1]], [[2.0, 1, 0.5]]])
    cameras.aim(model, positions)
    first = model.cam_pos.copy()
    cameras.aim(model, positions)
    assert np.array_equal(first, model.cam_pos)
    again = mujoco.MjModel.from_xml_string(spec.to_xml())
    cameras.aim(again, positions)
    assert np.allclose(first, again.cam_pos)


def test_mistakes_list_what_is_known():
    spec = mujoco.MjSpec()
    add(spec, "ball", SPHERE, (0.1, 0, 0), (1, 0, 0.1))
    with pytest.raises(ValueError, match=r"no view 'sideways'.*perspective"):
        cameras.add(spec, "eye", view="sideways")
    with pytest.raises(ValueError, match=r"no body cube; known: ball"):
        cameras.add(spec, "eye", subjects=("cube",))
    with pytest.raises(ValueError, match="no position"):
        cameras.add(spec, "eye", target=(0, 0, 0))
    with pytest.raises(ValueError, match="its own target"):
        cameras.add(spec, "eye", position=(0, 0, 1), target=(0, 0, 1))
    cameras.add(spec, "eye")
    with pytest.raises(ValueError, match="exists already"):
        cameras.add(spec, "eye")
    with pytest.raises(ValueError, match="positions must be"):
        cameras.aim(spec.compile(), np.zeros((3, 5, 3)))


@pytest.mark.parametrize("others", [(), ("ball",)])
def test_what_a_law_moves_is_a_subject_though_no_body_carries_it(others):
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(type=PLANE, size=(0, 0, 1))
    add(spec, "ball", SPHERE, (0.1, 0, 0), (0.8, 0, 0.1))
    add(spec, "far", SPHERE, (0.1, 0, 0), (9, 0, 0.1))
    film = np.array([[-0.5, -0.4, 0.2], [0.5, -0.4, 0.2], [0.5, 0.4, 0.3], [-0.5, 0.4, 0.3]])
    moved_shapes.surface(spec, "film", film, [[0, 1, 2], [0, 2, 3]])
    cameras.add(spec, "shot", view="perspective", subjects=("film", *others))
    model = spec.compile()
    cameras.aim(model)
    shown = np.abs(project(model, posed(model), "shot", film))
    assert 0.5 < shown.max() < 1.0


def test_a_recording_with_nan_is_aimed_by_what_is_sound():
    spec = mujoco.MjSpec()
    add(spec, "ball", SPHERE, (0.1, 0, 0), (1, 0, 0.1))
    cameras.add(spec, "eye")
    model = spec.compile()
    cameras.aim(model, np.array([[[0.0, 0, 0.1]], [[np.nan, 0, 0]]]))
    assert np.isfinite(model.cam_pos).all()


def test_a_surface_can_be_framed_beside_a_body_and_a_name_of_neither_is_refused():
    """Water in a glass and a balloon are no bodies, and what a plan's camera looks at may be one."""
    from worldkit import moved_shapes
    from worldkit.skins import ball

    spec = mujoco.MjSpec()
    body = spec.worldbody.add_body(name="crate", pos=(0, 0, 0.6))
    body.add_freejoint()
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.05, 0.05, 0.05))
    moved_shapes.surface(spec, "balloon", *ball(0.4, (0.8, 0, 0.4), finer=1))
    for name, subjects in (("crate", ("crate",)), ("both", ("balloon", "crate")), ("alone", ("balloon",))):
        cameras.add(spec, name, view="side_minus_y", subjects=subjects)
    model = spec.compile()
    cameras.aim(model)
    near, both, alone = (model.cam_pos[model.camera(name).id] for name in ("crate", "both", "alone"))
    assert -both[1] > -2 * near[1] and both[0] > near[0] + 0.2
    assert np.isfinite(alone).all() and alone[0] > near[0] + 0.2
    with pytest.raises(ValueError, match="there is no body cloud"):
        cameras.add(spec, "other", subjects=("balloon", "cloud"))

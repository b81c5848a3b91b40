import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldkit import bodies, cameras

coordinate = st.floats(-4, 4)


def project(model, camera, points):
    """Normalised image coordinates (N, 2), -1 to 1 inside a 16:9 picture, of the ball at each of its places.

    A camera may follow a subject that is small for its path, so each place is looked at when the ball is there.
    """
    data, seen = mujoco.MjData(model), []
    number = model.camera(camera).id
    slope = np.tan(np.radians(model.cam_fovy[number]) / 2)
    for point in points:
        data.qpos[:3] = point
        mujoco.mj_kinematics(model, data)
        mujoco.mj_camlight(model, data)
        cameras.track(model, data)
        local = (point - data.cam_xpos[number]) @ data.cam_xmat[number].reshape(3, 3)
        assert local[2] < 0
        seen.append((local[0] / -local[2] / slope / (16 / 9), local[1] / -local[2] / slope))
    return np.array(seen)


def world(path, view, **options):
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=(0, 0, 1))
    bodies.sphere(spec, "ball", diameter=0.2, pos=tuple(path[0]))
    bodies.box(spec, "crate", size=(0.5, 0.5, 0.5), pos=(9, 9, 0.25), fixed=True)
    cameras.add(spec, "eye", view=view, subjects=("ball",), **options)
    model = spec.compile()
    positions = np.zeros((len(path), 2, 3))
    positions[:, 0], positions[:, 1] = path, (9, 9, 0.25)
    return model, positions


@pytest.mark.parametrize("view", cameras.VIEWS)
@given(st.lists(st.tuples(coordinate, coordinate, st.floats(0.1, 4)), min_size=1, max_size=6))
@settings(max_examples=8, deadline=None)
def test_every_view_frames_the_whole_path_from_above_the_ground(view, path):
    path = np.array(path)
    model, positions = world(path, view)
    cameras.aim(model, positions)
    seen = project(model, "eye", path)
    assert np.abs(seen).max() < 0.99
    assert model.camera("eye").pos[2] > 0.05


def test_the_frame_is_filled_not_wasted():
    model, positions = world(np.array([[-1.0, 0, 0.1], [1.0, 0, 0.1]]), "side_minus_y")
    cameras.aim(model, positions)
    assert np.abs(project(model, "eye", positions[:, 0])[:, 0]).max() > 0.55


def test_a_wall_in_the_way_turns_the_camera_aside():
    spec = mujoco.MjSpec()
    bodies.sphere(spec, "ball", diameter=0.2, pos=(0, 0, 0.1))
    bodies.box(spec, "wall", size=(0.6, 0.05, 0.8), pos=(0, -0.3, 0.4), fixed=True)
    cameras.add(spec, "eye", view="side_minus_y", subjects=("ball",))
    model = spec.compile()
    cameras.aim(model)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    place = model.camera("eye").pos
    ray = np.array([0, 0, 0.16]) - place
    number = np.zeros(1, np.int32)
    mujoco.mj_ray(model, data, place, ray / np.linalg.norm(ray), None, 1, -1, number, None)
    assert model.geom(number[0]).name == "ball"


def test_a_following_camera_keeps_its_subject_centred():
    model, positions = world(np.array([[0.0, 0, 1.0], [0, 0, 0.1]]), "close_up", follow=True)
    cameras.aim(model, positions)
    data = mujoco.MjData(model)
    data.qpos[2] = 0.1
    mujoco.mj_kinematics(model, data)
    mujoco.mj_camlight(model, data)
    before = data.cam_xpos[0].copy()
    cameras.track(model, data)
    assert np.allclose(data.cam_xpos[0] - before, [0, 0, -0.9])


def test_explicit_cameras_stay_where_they_are_put():
    spec = mujoco.MjSpec()
    bodies.sphere(spec, "ball", diameter=0.2, pos=(1, 0, 0.1))
    cameras.add(spec, "eye", position=(0, -3, 2), target=(0, 0, 0))
    model = spec.compile()
    cameras.aim(model)
    assert np.allclose(model.camera("eye").pos, [0, -3, 2])
    assert np.allclose(project(model, "eye", np.zeros((1, 3))), 0, atol=1e-9)


def test_unknown_views_and_subjects_list_the_known():
    spec = mujoco.MjSpec()
    bodies.sphere(spec, "ball", diameter=0.2, pos=(1, 0, 0.1))
    with pytest.raises(ValueError, match=r"sideways.*perspective"):
        cameras.add(spec, "eye", view="sideways")
    with pytest.raises(ValueError, match=r"cube.*ball"):
        cameras.add(spec, "eye", subjects=("cube",))

"""What is driven is seen from behind, whichever way it turns; pictures are drawn on a thread while somebody looks."""

import dataclasses
import threading

import cv2
import mujoco
import numpy as np
import pytest

from small_worlds import empty, floor
from worldengine.clock.state_frames import signature
from worldengine.film import renderers
from worldengine.given import Given
from worldkit import portable, vehicles
from worldwright.ends import chase_pictures
from worldwright.ends.chase_pictures import LiveView, PictureThread, followed
from worldwright.ends.live_source import LiveSource
from worldwright.model.errors import NotFoundError

SIZE = (160, 90)


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    """A car on a plane, never recorded."""
    folder = tmp_path_factory.mktemp("car")
    spec = empty(time_step=0.002)
    floor(spec)
    vehicles.add(spec, vehicles.Car(), name="car", look=None)
    spec.worldbody.add_camera(name="chase", pos=(0, 0, 30))
    portable.write(spec, folder / "world.mjz")
    given = Given(folder / "world.mjz", 1.0, 24, SIZE, (), (), 0, "", 10, 0, ())
    found = LiveSource(None, None, folder / "plan.md", folder / "world.mjz", folder, None, folder / "nothing")
    found.__dict__["given"] = given
    return found


def state(model, x=0.0, yaw_deg=0.0, time_s=0.0):
    data = mujoco.MjData(model)
    data.time, data.qpos[0] = time_s, x
    data.qpos[3:7] = np.cos(np.radians(yaw_deg) / 2), 0, 0, np.sin(np.radians(yaw_deg) / 2)
    found = np.zeros(mujoco.mj_stateSize(model, signature()))
    mujoco.mj_getState(model, data, found, signature())
    return found


@pytest.mark.gl
def test_it_follows_from_behind_and_turns_after_what_turns(source):
    view = LiveView(source, SIZE)
    try:
        assert view.chase == "chase_" and view.cameras == ("chase_", "chase") and view.followed == "car"
        for x, yaw, time_s in ((0.0, 0.0, 0.0), (40.0, 90.0, 10.0)):
            picture = view.draw(state(view._model, x, yaw, time_s))
            away = view._data.cam_xpos[view._model.camera("chase_").id] - view._data.subtree_com[1]
            ahead = view._data.xmat[1].reshape(3, 3)[:, 0]
            assert away @ ahead < -3.0 and away[2] > 1.0 and abs(np.cross(away, ahead)[2]) < 1.0
            seen = view._frames.segmentation(view._data, "chase_")
            car = np.isin(seen, [g for g in range(view._model.ngeom) if view._model.geom_bodyid[g] > 0])
            rows, columns = np.nonzero(car)
            assert picture.shape == (90, 160, 3) and 0.02 < car.mean() < 0.6
            assert abs(columns.mean() - 80) < 16 and abs(rows.mean() - 45) < 25
        with pytest.raises(NotFoundError, match="no camera top"):
            view.draw(state(view._model), "top")
    finally:
        view.close()


@pytest.mark.gl
def test_the_quick_look_is_bright_whatever_lights_the_world_has(source, tmp_path):
    spec = portable.spec(source.world)
    spec.visual.headlight.active = 0
    for n in range(3):
        spec.worldbody.add_light(name=f"lamp_{n}", pos=(n, 0, 3), castshadow=True)
    portable.write(spec, tmp_path / "world.mjz")
    dark = dataclasses.replace(source, world=tmp_path / "world.mjz")
    dark.__dict__["given"] = source.given
    for look, drawn_by in (("quick", "classic"), ("film", renderers.wanted())):
        view = LiveView(dark, SIZE, look=look)
        try:
            picture = view.draw(state(view._model))
            assert view._frames.renderer == drawn_by and view._model.vis.quality.offsamples == 4 * (look == "film")
            assert 60 < picture.mean() < 240 and picture[:20].mean() > 100, "the ground, and a sky above it"
        finally:
            view.close()


@pytest.mark.gl
def test_nothing_is_drawn_for_nobody_and_never_the_same_twice(source):
    newest = [({}, None)]
    thread = PictureThread(lambda: LiveView(source, SIZE), lambda: newest[0], fps=200)
    made = threading.Semaphore(0)
    thread.made.append(made.release)
    try:
        assert thread.ready.wait(60) and thread.problem == ""
        newest[0] = ({}, state(source.model))
        assert not made.acquire(timeout=0.3)
        thread.wanted = True
        assert made.acquire(timeout=60) and not made.acquire(timeout=0.3)
        newest[0] = ({}, state(source.model, 3.0))
        assert made.acquire(timeout=60)
        number, data = thread.jpeg
        assert number == 2 and cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR).shape == (90, 160, 3)
    finally:
        thread.close()


def test_a_driver_that_draws_nothing_is_told_and_ends_no_drive():
    def broken():
        raise RuntimeError("no graphics here")

    thread = PictureThread(broken, lambda: ({}, None))
    assert thread.ready.wait(10) and "no graphics here" in thread.problem
    thread.close()


def test_a_body_that_is_not_there_is_named_with_the_known_ones(source):
    with pytest.raises(NotFoundError, match="no body cart") as refused:
        followed(source.model, source, "cart")
    assert "car_fl_hub" in refused.value.next_move and chase_pictures.CHASE == "chase"


def test_what_is_followed_is_as_large_as_all_that_hangs_on_it():
    spec, parent = empty(), None
    for n in range(6):
        parent = (parent or spec.worldbody).add_body(name=f"link_{n}", pos=(0, 0, 1.0))
        parent.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE)
        parent.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.1, 0, 0))
    model = spec.compile()
    assert chase_pictures._size_m(model, model.body("link_0").id) == pytest.approx(5.2)
    assert chase_pictures._size_m(model, model.body("link_5").id) == pytest.approx(0.2)


def test_a_driver_that_fails_in_the_middle_is_told(source):
    class Failing:
        cameras = ("chase",)

        def draw(self, state, camera):
            raise RuntimeError("the context is lost")

        def close(self):
            pass

    thread = PictureThread(Failing, lambda: ({}, np.zeros(1)))
    thread.wanted = True
    thread._thread.join(60)
    assert "no more pictures" in thread.problem and "the context is lost" in thread.problem
    thread.close()

"""What is drawn of where things are carries pictures over to other moments."""

from dataclasses import replace
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor
from worldengine.film import between, carrying
from worldengine.film.carrying import Surfaces
from worldengine.film.fitting import uneven
from worldengine.film.renderers.preview.eye import View
from worldengine.film.treatment import Treatments
from worldkit import cameras, materials

SIZE = (192, 108)


def level(depth: float, place: float = 0.0, things: int = 0) -> Surfaces:
    """A wall that fills a picture, and the place of a thing in it."""
    poses = np.zeros((1, 3, 4))
    poses[0, :, :3], poses[0, :, 3] = np.eye(3), (place, 0.0, -2.0)
    flat = np.full((27, 48), depth, np.float32)
    return Surfaces(np.full(flat.shape, things, np.int32), flat, poses, View(np.zeros(3), np.eye(3), (0.9, 0.5)))


def test_wide_gaps_have_to_be_closer_where_things_go_far_or_bend():
    def lacking(*frames: Surfaces) -> bool:
        return between.Geometry(lambda frame, coarser: frames[frame // 4]).lacking(4, 0, 8)

    still = level(2.0)
    assert not lacking(still, still, still)
    assert not lacking(level(2.0, -0.02), level(2.0), level(2.0, 0.02)), "it goes a quarter of a pixel"
    assert lacking(level(2.0, -0.1), level(2.0), level(2.0, 0.1))
    assert lacking(level(2.0, things=-1), level(2.1, things=-1), level(2.2, things=-1)), "cloth"


@pytest.mark.parametrize(("degrees", "lacking", "misleads"), [(1, False, False), (12, True, False), (110, True, True)])
def test_what_spins_is_traced_and_never_carried_to_where_it_shows_another_side(degrees, lacking, misleads):
    def spun(frame: int) -> Surfaces:
        shown, turn = level(2.0), np.radians(degrees * frame)
        shown.poses[0, :2, :2] = [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
        return shown

    geometry = between.Geometry(lambda frame, coarser: spun(frame), lambda frame: (spun(frame).poses, spun(frame).view))
    assert geometry.lacking(4, 0, 8) is lacking
    assert geometry.misleads(7, [8]) is False or degrees == 110
    assert geometry.misleads(3, [0, 8]) is misleads


def test_what_shrinks_does_not_spin():
    def shrunk(frame: int) -> Surfaces:
        shown = level(2.0)
        shown.poses[0, :, :3] *= 0.97**frame
        return shown

    geometry = between.Geometry(
        lambda frame, coarser: level(2.0), lambda frame: (shrunk(frame).poses, shrunk(frame).view)
    )
    assert not geometry.lacking(4, 0, 8) and not geometry.misleads(3, [0, 8])


def test_neighbours_are_of_the_same_shot():
    drawn = [2.0, 0, 0, 2.0, 2.0, 0, 0, 0]
    assert between.neighbours(1, drawn, range(4)) == [0, 3]
    assert between.neighbours(6, drawn, range(4, 8)) == [4]
    assert between.neighbours(5, drawn, range(5, 8)) == []


@pytest.mark.parametrize("what", ["light", "focus"])
def test_what_changes_otherwise_than_evenly_within_a_gap_is_traced(what):
    told = [{"at_s": 0.0, "light_strength": 1.0}, {"at_s": 8.0, "light_strength": 3.0}]
    flash = [{"at_s": at, "light_strength": 3.0 if at == 2.0 else 1.0} for at in (0.0, 1.0, 2.0, 3.0)]
    focus = np.ones(9)
    if what == "focus":
        focus[2] = 2.0
    film = SimpleNamespace(
        treatments=Treatments(flash if what == "light" else told), arrays={"focus_m": focus, "aperture": np.zeros(9)}
    )
    assert uneven(film, 0, 4, 1.0)
    assert not uneven(film, 3, 8, 1.0)


@pytest.mark.gl
def test_a_rolling_ball_seen_by_a_moving_camera_is_where_it_would_be_drawn():
    from worldengine.film.renderers.preview.shaded import Shaded

    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 0.15), radius=0.15)
    cameras.add(spec, "eye", view="side_minus_y")
    model = spec.compile()
    data, camera = mujoco.MjData(model), model.camera("eye").id
    drawing = Shaded(model, *SIZE)
    moments = []
    try:
        for k in (-1, 0, 1):
            data.qpos[:3] = 0.08 * k, 0.0, 0.15
            mujoco.mj_forward(model, data)
            data.cam_xpos[camera] = 0.05 * k, -1.2, 0.4
            back = data.cam_xpos[camera] - (0.0, 0.0, 0.1)
            back /= np.linalg.norm(back)
            right = np.cross((0.0, 0.0, 1.0), back)
            right /= np.linalg.norm(right)
            data.cam_xmat[camera] = np.stack([right, np.cross(back, right), back], axis=1).ravel()
            moments.append((drawing.surfaces(data, camera), drawing.image(data, camera, "video")))
        coarse = drawing.surfaces(data, camera, 4)
    finally:
        drawing.close()
    assert coarse.depth.shape == (SIZE[1] // 4, SIZE[0] // 4)
    (before, first), (now, wanted), (after, last) = moments
    middle = now.depth[SIZE[1] // 2, SIZE[0] // 2]
    assert middle == pytest.approx(np.hypot(1.2, 0.3) - 0.15, abs=0.02), (
        "metres along the view axis to the ball's near side"
    )
    image, missing = carrying.between(now, [(before, first), (after, last)], 0.5)
    off, held = (np.abs(one.astype(int) - wanted.astype(int)).max(axis=-1) for one in (image, first))
    assert missing < 0.05  # outlines are wide in so small a picture
    assert off.mean() < 3 and off.mean() < held.mean() / 3


@pytest.mark.parametrize("told", [False, True], ids=["drawn", "by poses first"])
def test_a_thing_that_is_seen_only_within_a_gap_is_traced_there(told):
    def frame(k: int) -> Surfaces:
        """A ball that passes the picture within the frames 1 to 3 of 0 to 8; it takes 0.3 % of it."""
        wall = level(2.0)
        poses = np.repeat(wall.poses, 2, axis=0)
        poses[1, :, 3] = 2.0 * (k - 2), 0.0, -1.5
        things, depth = wall.things.copy(), wall.depth.copy()
        if k == 2:
            things[13:15, 23:25], depth[13:15, 23:25] = 1, 1.5
        return Surfaces(things, depth, poses, wall.view)

    drawn = []

    def surfaces(k: int, coarser: int) -> Surfaces:
        drawn.append(k)
        return frame(k)

    geometry = between.Geometry(surfaces, (lambda k: (frame(k).poses, frame(k).view)) if told else None)
    assert geometry.lacking(4, 0, 8)
    assert not told or drawn == [4, 0, 8, 2], "only what may come is drawn"
    assert geometry.lacking(2, 0, 4) and not geometry.lacking(6, 4, 8)
    black = np.zeros((27, 48, 3), np.uint8)
    assert between.reckoned(2, [0, 4], geometry, lambda k: black, 0.0) is None, "rather held than without it"
    assert between.reckoned(3, [0, 4], geometry, lambda k: black, 0.0) is not None


def glazed(ball: float, pane: float = 0.0) -> Surfaces:
    """A see-through pane, which fills the picture, and a ball behind it, each at a place."""
    wall = level(2.0)
    poses = np.repeat(wall.poses, 3, axis=0)
    poses[1, :, 3], poses[2, :, 3] = (ball, 0.0, -1.5), (pane, 0.0, -1.0)
    things, depth = wall.things.copy(), wall.depth.copy()
    things[10:16, 20:28], depth[10:16, 20:28] = 1, 1.5
    behind = Surfaces(things, depth, poses, wall.view, 0)
    return Surfaces(np.full_like(things, 2), np.ones_like(depth), poses, wall.view, 0, behind)


@pytest.mark.parametrize("after", [2, 8])
def test_what_goes_behind_glass_or_with_it_is_traced(after):
    def lacking(*frames: Surfaces) -> bool:
        geometry = between.Geometry(lambda frame, coarser: frames[min(2 * frame // after, 2)])
        return geometry.lacking(after // 2, 0, after)

    still = glazed(0.0)
    assert not lacking(still, still, still)
    assert not lacking(glazed(-0.002), still, glazed(0.002)), "a quarter of a pixel"
    assert lacking(glazed(-0.04), still, glazed(0.04)), "it would be seen at two places"
    assert lacking(glazed(0.0, -0.04), still, glazed(0.0, 0.04)), "the pane would take the ball along"


def test_what_was_not_traced_in_time_is_not_reckoned_where_it_would_mislead():
    """When the minutes end before the draft does: behind glass, or as it bends across a wide gap, the nearest is shown."""
    black = np.zeros((27, 48, 3), np.uint8)

    def reckoned(after: int, *frames: Surfaces) -> bool:
        def surfaces(frame: int, coarser: int) -> Surfaces:
            shown = frames[min(2 * frame // after, 2)]
            return shown if coarser > 1 else replace(shown, behind=None)

        return between.reckoned(1, [0, after], between.Geometry(surfaces), lambda k: black, 0.0) is not None

    assert reckoned(8, *[glazed(0.0)] * 3) and reckoned(8, *[level(2.0)] * 3)
    assert not reckoned(8, glazed(-0.04), glazed(0.0), glazed(0.04))
    cloth = [level(2.0 + 0.1 * k, things=-1) for k in range(3)]
    assert not reckoned(8, *cloth) and reckoned(2, *cloth), "a frame is short"


@pytest.mark.gl
def test_coarse_surfaces_also_tell_what_is_behind_glass_and_poses_need_no_drawing():
    from worldengine.film.renderers.preview.shaded import Shaded

    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 0.15), radius=0.15)
    pane = spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.5, 0.01, 0.5), pos=(0, -0.5, 0.5))
    materials.add(spec, "glass_clear")
    pane.material = "glass_clear"
    cameras.add(spec, "eye", view="side_minus_y")
    model = spec.compile()
    data, camera = mujoco.MjData(model), model.camera("eye").id
    mujoco.mj_forward(model, data)
    data.cam_xpos[camera], data.cam_xmat[camera] = (0.0, -2.0, 0.3), np.array([1.0, 0, 0, 0, 0, -1, 0, 1, 0])
    drawing = Shaded(model, *SIZE)
    try:
        coarse, fine = drawing.surfaces(data, camera, 4), drawing.surfaces(data, camera)
        poses, view = drawing.placed(data, camera)
    finally:
        drawing.close()
    assert fine.behind is None and coarse.behind is not None
    assert (coarse.things != coarse.behind.things).mean() > 0.01, "the pane"
    assert np.array_equal(poses, coarse.poses) and np.array_equal(view.eye, coarse.view.eye)

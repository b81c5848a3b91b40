"""What is drawn of where things are carries pictures over to other moments."""

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor
from worldengine.film import between, carrying
from worldengine.film.carrying import Surfaces
from worldengine.film.renderers.preview.eye import View
from worldkit import cameras

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


def test_neighbours_are_of_the_same_shot():
    drawn = [2.0, 0, 0, 2.0, 2.0, 0, 0, 0]
    assert between.neighbours(1, drawn, range(4)) == [0, 3]
    assert between.neighbours(6, drawn, range(4, 8)) == [4]
    assert between.neighbours(5, drawn, range(5, 8)) == []


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

"""Courses of bricks lie level on a wall, be it a box or a mesh of any turn, whose frame the simulator lays along its longest side."""

import mujoco
import numpy as np
import pytest

from small_worlds import slab
from worldengine.film.renderers.preview.things import Things
from worldkit import scene, turning

AXES = {2.0: 2, 3.0: 0, 4.0: 1}
"""By paint mode: the axis of the geom's own frame that is up in the picture of the paint."""


@pytest.mark.parametrize("size", [(2.0, 0.1, 1.0), (0.1, 2.0, 1.0), (0.5, 0.1, 3.0), (1.0, 0.9, 0.3)])
@pytest.mark.parametrize("look", ["brick", "tiles_white"])
@pytest.mark.parametrize("shape", ["mesh", "box"])
def test_up_in_the_paint_is_up_in_the_frame_that_the_wall_was_made_in(size, look: str, shape: str) -> None:
    spec = scene.new("wall", time_step=0.002, setting="studio")
    quat = np.array([0.9, 0.1, 0.2, 0.37]) / np.linalg.norm([0.9, 0.1, 0.2, 0.37])
    turn = turning.matrices(quat)
    body = spec.worldbody.add_body(name="wall", pos=(0, 0, 2), quat=quat)
    slab(spec, body, shape, size, look, radius=0.01)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    things = Things(model)
    things.update(data)
    row = things.rows[list(things.geoms).index(int(model.body("wall").geomadr[0]))]
    frame, mode = row[:12].reshape(3, 4)[:, :3], float(row[26])
    up = frame[:, AXES[mode]]
    assert abs(up @ turn[:, 2]) == pytest.approx(1.0, abs=1e-3)

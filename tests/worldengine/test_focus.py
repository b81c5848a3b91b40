"""What a lens leaves sharp costs few taps, and the picture is the same to the last bit as with all of them."""

import mujoco
import numpy as np
import pytest
from OpenGL import GL

from worldengine.film.renderers import preview
from worldengine.film.renderers.preview.focus import Focus
from worldengine.film.treatment import Treatment
from worldkit import bodies, cameras, scene

pytestmark = pytest.mark.gl
SIZE = (230, 134)
"""No whole number of blocks, either way."""


@pytest.fixture(scope="module")
def world():
    spec = scene.new("focus", time_step=0.002)
    for number, away in enumerate((0.0, 0.5, 2.0)):
        bodies.sphere(spec, f"ball{number}", diameter=0.3, pos=(0.3 * number - 0.3, away, 0.15))
    cameras.add(spec, "eye", subjects=("ball0", "ball1", "ball2"))
    model = spec.compile()
    cameras.aim(model)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    drawing = preview.take(model, *SIZE)
    yield drawing, data
    drawing.close()


@pytest.mark.parametrize(("focus_m", "aperture"), [(1.2, 0.4), (1.2, 2.0), (0.4, 1.0), (6.0, 1.0), (1.2, 16.0)])
def test_the_taps_that_are_left_out_weigh_nothing(world, monkeypatch, focus_m, aperture):
    drawing, data = world
    drawing.treat(Treatment(focus_m=focus_m, aperture=aperture))
    found = drawing.image(data, 0, "video")
    bounded = Focus._bound

    def unbounded(self, picture, widest):
        bounded(self, picture, widest)
        self._around.bind()
        GL.glClearColor(0.0, 1.0, 0.0, 0.0)  # from endless to the near plane: all taps
        GL.glClear(GL.GL_COLOR_BUFFER_BIT)

    monkeypatch.setattr(Focus, "_bound", unbounded)
    assert np.array_equal(drawing.image(data, 0, "video"), found)


def test_a_block_knows_all_that_may_spread_over_it_and_nothing_farther(world):
    drawing, data = world
    drawing.treat(Treatment(focus_m=1.2, aperture=1.0))
    drawing.image(data, 0, "video")
    stage = drawing._pipeline._stages["video"]
    GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, stage.picture.handle)
    depth = GL.glReadPixels(0, 0, *SIZE, GL.GL_DEPTH_COMPONENT, GL.GL_FLOAT).reshape(SIZE[::-1])
    around = stage.focus._around
    GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, around.handle)
    found = np.empty((around.height, around.width, 2), np.float32)
    GL.glReadPixels(0, 0, around.width, around.height, GL.GL_RG, GL.GL_FLOAT, found)
    for row in range(around.height):
        for column in range(around.width):
            part = depth[max(16 * row - 16, 0) : 16 * row + 32, max(16 * column - 16, 0) : 16 * column + 32]
            assert found[row, column] == pytest.approx((part.min(), part.max()))

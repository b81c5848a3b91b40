"""Bare metal mirrors what is around it, in the picture or not, at the price of none where there is no metal."""

import mujoco
import numpy as np
import pytest

from worldengine.film.renderers.preview.around_metal import AroundMetal
from worldengine.film.renderers.preview.things import Things
from worldkit import bodies, scene

pytestmark = pytest.mark.gl
SIZE = (96, 72)


def world(look: str, beside: bool = True, fixed: bool = False) -> mujoco.MjModel:
    """A ball before a camera, and a red box behind the camera that only the ball can show."""
    spec = scene.new("mirror", time_step=0.002, setting="studio")
    bodies.sphere(spec, "ball", diameter=0.2, pos=(0, 0, 0.1), mass=1.0, look=look)
    if beside:
        bodies.box(spec, "box", size=(0.4, 0.1, 0.4), pos=(0, -0.9, 0.2), mass=1.0, look="#d01010", fixed=fixed)
    spec.worldbody.add_camera(name="eye", pos=(0, -0.6, 0.15), xyaxes=(1, 0, 0, 0, 0.1, 1), fovy=30)
    return spec.compile()


def drawn(model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
    from worldengine.film.drawn_frames import Frames

    with Frames(model, *SIZE) as frames:
        return frames.image(data, "eye").astype(float)


def posed(model: mujoco.MjModel) -> mujoco.MjData:
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return data


@pytest.mark.parametrize("fixed", [False, True])
def test_a_ball_of_chrome_shows_what_is_behind_the_camera(fixed: bool) -> None:
    with_it = drawn(model := world("chrome", fixed=fixed), posed(model))
    without = drawn(model := world("chrome", beside=False), posed(model))
    redder = (with_it[..., 0] - with_it[..., 1]) - (without[..., 0] - without[..., 1])
    assert (redder > 40).sum() > 20


@pytest.mark.parametrize("look", ["chrome", "steel_polished", "brass"])
def test_polished_metal_has_light_and_dark_side_by_side(look: str) -> None:
    luma = drawn(model := world(look), posed(model)).mean(axis=2)[20:52, 32:64]
    steps = np.abs(np.diff(luma, axis=0))
    assert np.ptp(luma) > 90 and steps.max() > 35


def test_a_picture_does_not_depend_on_those_drawn_before_it() -> None:
    from worldengine.film.drawn_frames import Frames

    model = world("steel_polished")
    here, there = posed(model), mujoco.MjData(model)
    there.qpos[:3] = 0.3, 2.4, 0.1
    mujoco.mj_forward(model, there)
    with Frames(model, *SIZE) as frames:
        first = frames.image(here, "eye")
        frames.image(there, "eye")
        again = frames.image(here, "eye")
    assert np.array_equal(first, again)


@pytest.mark.parametrize(("look", "found"), [("steel_brushed", True), ("iron_rusty", False), ("ceramic_white", False)])
def test_only_bare_metal_that_is_not_dull_needs_its_surroundings(look: str, found: bool) -> None:
    model = world(look)
    things = Things(model)
    things.update(posed(model))
    assert AroundMetal(model, things, posed(model)).any is found

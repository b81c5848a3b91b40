"""What the instrument reads in pictures whose readings are known."""

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty
from worldengine.film import light_meter
from worldengine.film.drawn_frames import Frames
from worldkit import materials, moved_shapes, skins


def test_brightness_loss_contrast_and_colour_of_a_picture_in_four_quarters() -> None:
    image = np.zeros((40, 40, 3), np.uint8)
    image[:20, :20] = 255  # white; the quarter below it stays black
    image[:20, 20:] = (255, 0, 0)
    image[20:, 20:] = 128
    read = light_meter.read(image)
    assert read["blown"] == 0.25 and read["crushed"] == 0.25
    assert abs(read["luma"] - (1 + 0 + 0.2126 + 128 / 255) / 4) < 1e-3
    assert abs(read["saturation"] - 0.25) < 1e-3
    assert abs(read["contrast"] - np.std([1, 0, 0.2126, 128 / 255])) < 1e-3


def test_a_subject_is_a_body_with_all_that_hangs_on_it() -> None:
    spec = empty()
    hand = ball(spec, "arm", (0, 0, 1)).add_body(name="hand")
    hand.add_geom(name="finger", type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.1, 0, 0))
    ball(spec, "other", (0, 0, 2))
    model = spec.compile()
    geoms = np.full((10, 10), -1, np.int32)
    geoms[:3], geoms[3:5], geoms[5] = model.geom("arm").id, model.geom("finger").id, model.geom("other").id
    assert light_meter.subjects(model, geoms, ("arm", "other", "nobody")) == {"arm": 50, "other": 10}
    assert light_meter.subjects(model, np.full((4, 4), -1), ("arm",)) == {"arm": 0}


@pytest.mark.gl
@pytest.mark.parametrize("renderer", ["preview", "classic"])
def test_what_is_in_a_glass_is_counted_through_it(renderer) -> None:
    spec = mujoco.MjSpec()
    kinds = mujoco.mjtGeom
    for name, size, look in (("glass", 0.2, "glass_clear"), ("cork", 0.05, "cork")):
        body = spec.worldbody.add_body(name=name)
        body.add_geom(type=kinds.mjGEOM_BOX, size=(size,) * 3, material=materials.add(spec, look), mass=1)
    moved_shapes.surface(spec, "water", *skins.ball(0.15, finer=1), look="water_clear")
    spec.worldbody.add_camera(name="eye", pos=(0, -1, 0), xyaxes=(1, 0, 0, 0, 0, 1), fovy=40)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with Frames(model, 64, 48, renderer) as frames:
        layers, groups = frames.layers(data, "eye"), model.geom_group.copy()
        assert frames.renderer == renderer and (model.geom_group == groups).all()
    read = light_meter.reading(model, np.zeros((48, 64, 3), np.uint8), layers, iter(("cork", "glass")))
    assert read["subjects"]["glass"] > read["subjects"]["cork"] > 10
    assert light_meter.subjects(model, layers[0], ("cork",)) == {"cork": 0}

"""A closed skin of glass or acrylic is a thin wall with air inside: what is behind it stands where it is, and its rim is seen."""

import mujoco
import numpy as np
import pytest

from worldengine.film.drawn_frames import Frames
from worldengine.film.renderers.traced import variant
from worldkit import materials, moved_shapes, scene, skins


def picture(renderer: str, look: str = "") -> np.ndarray:
    """A red block behind the middle of a skin of this look; none where it is empty."""
    spec = scene.new("wall", time_step=0.002, setting="studio", floor="paper")
    outline = [(0, 0), (0.03, 0), (0.045, 0.01), (0.045, 0.05), (0.045, 0.09), (0.03, 0.1), (0, 0.1)]
    if look:
        moved_shapes.surface(spec, "wall", *skins.revolved(outline, 24, (0, 0, 0.002)), look=look)
    red = materials.add(spec, "plastic_red")
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.006, 0.02, 0.02), pos=(-0.2, 0, 0.06), material=red)
    spec.worldbody.add_camera(name="eye", pos=(0.6, 0, 0.06), xyaxes=(0, 1, 0, 0, 0, 1), fovy=12)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with Frames(model, 96, 72, renderer) as frames:
        found = frames.image(data, "eye", 8 if renderer == "traced" else "video").astype(float)
        assert frames.renderer == renderer, frames.reason
    return found


def red(found: np.ndarray) -> np.ndarray:
    return found[..., 0] > 1.15 * found[..., 1:].max(axis=-1)


@pytest.mark.gl
@pytest.mark.parametrize("renderer", ["preview", "traced"])
def test_what_is_behind_a_wall_of_acrylic_stands_where_it_is(renderer: str) -> None:
    if renderer == "traced":
        assert variant.choose() != variant.PLAIN, "it needs LLVM 17 or newer"
    bare, wall = picture(renderer), picture(renderer, "acrylic_clear")
    known = red(bare)
    assert known.sum() > 100
    assert (red(wall) & known).sum() > 0.9 * (red(wall) | known).sum()
    row = np.abs(wall - bare).mean(axis=-1)[28:44].mean(axis=0)  # through its straight part, 52 of 96 pixels wide
    assert max(row[20:26].max(), row[70:76].max()) > 12, row.round(1)

"""What stands in a liquid keeps its outline in the preview: bent, and not smeared over the liquid beside it."""

import mujoco
import numpy as np
import pytest

from worldengine.film.drawn_frames import Frames
from worldkit import materials, moved_shapes, scene, skins


@pytest.mark.gl
def test_a_block_in_water_is_no_wider_at_one_side_than_water_makes_it() -> None:
    spec = scene.new("vessel", time_step=0.002, setting="studio", floor="paper")
    outline = [(0, 0), (0.02, 0), (0.037, 0), (0.037, 0.02), (0.037, 0.04), (0.037, 0.062), (0.02, 0.062), (0, 0.062)]
    moved_shapes.surface(spec, "water", *skins.revolved(outline, 48, (0, 0, 0.005)), look="water_clear")
    half, place = 0.011, np.array([0.004, 0.0, 0.05])
    red = materials.add(spec, "plastic_red")
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(half,) * 3, pos=place, material=red)
    eye = np.array([0.06, -0.42, 0.19])
    back = eye - (0, 0, 0.045)
    back /= np.linalg.norm(back)
    right = np.cross((0, 0, 1), back)
    right /= np.linalg.norm(right)
    spec.worldbody.add_camera(name="eye", pos=eye, xyaxes=(*right, *np.cross(back, right)), fovy=16)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with Frames(model, 160, 120, "preview") as frames:
        picture = frames.image(data, "eye").astype(float)
        assert frames.renderer == "preview", frames.reason
    seen = picture[..., 0] > 1.6 * picture[..., 1:].max(axis=-1)
    across = seen.any(axis=0).nonzero()[0]
    # The block with its near corners, 1.33 times as wide where water is a lens around it; in air it would be this wide:
    corners = place + half * np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) - eye
    flat = (corners @ right) / -(corners @ back)
    wide = np.ptp(flat) / np.tan(np.radians(8)) * 60
    assert 0.9 * wide < np.ptp(across) < 1.6 * wide, (wide, across)
    rows = seen.sum(axis=1)
    assert rows.max() < 1.6 * wide

"""A pane of glass: its cut edges shine, its faces show what is behind, be it a box or a mesh."""

import mujoco
import numpy as np
import pytest

from small_worlds import slab
from worldengine.film.drawn_frames import Frames
from worldengine.film.renderers.preview.things import PANE, Things
from worldkit import scene

SIZE = (0.4, 0.4, 0.01)


def lying(shape: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """A pane that lies a hand's breadth over dark ground, seen from the side."""
    spec = scene.new("pane", time_step=0.002, setting="studio")
    body = spec.worldbody.add_body(name="pane", pos=(0, 0, 0.1))
    slab(spec, body, shape, SIZE, "clear #7fd0a8 6mm", radius=0.0005)
    spec.worldbody.add_camera(name="eye", pos=(0, -0.9, 0.3), xyaxes=(1, 0, 0, 0, 0.2, 0.9), fovy=28)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def picture(shape: str) -> tuple[np.ndarray, np.ndarray]:
    """The picture, and where the pane is in it."""
    model, data = lying(shape)
    with Frames(model, 240, 180) as frames:
        image = frames.image(data, "eye").astype(float)
        seen = frames.segmentation(data, "eye") == int(model.body("pane").geomadr[0])
    return image, seen


@pytest.mark.gl
@pytest.mark.parametrize("shape", ["box", "mesh"])
def test_the_cut_edge_of_a_pane_is_brighter_and_greener_than_its_face(shape: str) -> None:
    image, seen = picture(shape)
    rows = np.flatnonzero(seen.any(axis=1))
    columns = slice(100, 140)
    edge, face = image[rows[-2], columns].mean(axis=0), image[rows[len(rows) // 2], columns].mean(axis=0)
    assert edge[1] > edge[0] + 15, "glass is green along its edge"
    assert (edge[1] - edge[0]) > 1.3 * (face[1] - face[0])
    assert edge.mean() > face.mean() + 20, "it shines, and is not looked through as through deep glass"


@pytest.mark.parametrize(("shape", "kind"), [("box", 2.0), ("mesh", PANE)])
def test_a_mesh_tells_the_axis_across_it(shape: str, kind: float) -> None:
    model, data = lying(shape)
    things = Things(model)
    things.update(data)
    geom = int(model.body("pane").geomadr[0])
    told = float(things.rows[list(things.geoms).index(geom), 39])
    assert told == (kind if shape == "box" else kind + int(model.geom_aabb[geom, 3:].argmin()))

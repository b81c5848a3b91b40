"""What is a little seen through reflects as its size says, whatever it is made of."""

import mujoco
import numpy as np
import pytest

from worldengine.film import renderers
from worldkit import cameras, scene

CORNERS = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)


def pictured(box: bool) -> np.ndarray:
    """A metal cube of 2 m that hides nine tenths of what lies behind, as a box or as a mesh, from above its front."""
    spec = scene.new("cube", time_step=0.002, setting="studio")
    spec.add_material(name="thin metal", rgba=(0.8, 0.8, 0.8, 0.9), metallic=1.0, roughness=0.1)
    cube = spec.add_mesh(name="cube", uservert=CORNERS.ravel(), inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX)
    kinds = mujoco.mjtGeom
    body = spec.worldbody.add_body(name="cube", pos=(0, 0, 1))
    body.add_freejoint()
    body.add_geom(
        type=kinds.mjGEOM_BOX if box else kinds.mjGEOM_MESH, size=(1, 1, 1), meshname="" if box else cube.name,
        material="thin metal",
    )  # fmt: skip
    cameras.add(spec, "eye", position=(0, -5, 3), target=(0, 0, 1), fovy=40)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    drawing = renderers.SEAM.find("preview").take(model, 160, 120)
    found = drawing.image(data, 0, "still").astype(int)
    drawing.close()
    return found


@pytest.mark.gl
def test_a_box_reflects_the_floor_before_it_as_the_same_mesh_does():
    box, mesh = pictured(True), pictured(False)
    front = np.s_[70:102, 60:100]
    assert box[front][0].mean() > box[front][-1].mean() + 20, (
        "the cube is in the way of what lights the floor before it"
    )
    assert np.abs(box[front] - mesh[front]).max() <= 3

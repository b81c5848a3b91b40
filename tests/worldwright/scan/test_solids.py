"""The surface of a soft body from a recording's own words, against the engine's vertices."""

from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from worldengine.recording.describing import describe
from worldkit.naming import names
from worldwright.scan.measuring.measured import UnknowableError
from worldwright.scan.measuring.solids import skin, volume


def jelly(dof: str, dim: int = 3, count: tuple[int, int, int] = (5, 4, 7)):
    """A block, or a sheet, that falls on the ground and is squashed there; the model and its state after half a second."""
    spec = mujoco.MjSpec()
    spec.option.integrator, spec.option.timestep = mujoco.mjtIntegrator.mjINT_DISCRETE, 0.002
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=(2, 2, 0.1))
    more = {"cellcount": (2, 1, 3)} if dof == "trilinear" else {}
    flex = spec.worldbody.make_flex(
        "jelly", type="grid", dim=dim, count=count, spacing=(0.05,) * 3, pos=(0, 0, 0.2), radius=0.004, mass=1.0,
        dof=dof, **more,
    )  # fmt: skip
    flex.young, flex.poisson, flex.damping = 2e4, 0.3, 0.01
    model = spec.compile()
    data = mujoco.MjData(model)
    for _ in range(250):
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    return model, data


def recorded(model, data):
    """One row, as scan reads it."""
    return SimpleNamespace(
        meta=describe(model), names=tuple(names(model, "body", model.nbody))[1:], pos=data.xpos[None, 1:].copy()
    )


@pytest.mark.parametrize("dof", ["trilinear", "full"])
def test_the_surface_is_where_the_engine_puts_it_and_encloses_the_cells(dof):
    model, data = jelly(dof)
    vertices, triangles = skin(recorded(model, data), "jelly", np.array([0]))
    assert np.abs(vertices[0] - data.flexvert_xpos).max() < 1e-9
    tetrahedra = model.flex_elem.reshape(-1, 4)
    a, b, c, d = (data.flexvert_xpos[tetrahedra[:, k]] for k in range(4))
    cells = np.abs(np.einsum("ei,ei->e", b - a, np.cross(c - a, d - a))).sum() / 6
    assert volume(vertices, triangles)[0] == pytest.approx(cells, rel=1e-6)
    assert cells != pytest.approx(0.2 * 0.15 * 0.3, rel=1e-4)  # it was squashed


def test_a_cloth_has_no_volume_and_says_so():
    model, data = jelly("full", dim=2, count=(4, 4, 1))
    with pytest.raises(UnknowableError, match="cloth"):
        skin(recorded(model, data), "jelly", np.array([0]))

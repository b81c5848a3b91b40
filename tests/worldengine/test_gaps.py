"""Distances to height fields are those of their surfaces, of other geoms the engine's own; drops end where things touch."""

import mujoco
import numpy as np
import pytest

from small_worlds import empty, record
from worldengine.recording import drawn_overlaps
from worldengine.recording.batch import true_distances
from worldengine.recording.gaps import distance, drop
from worldwright.lint.compiled import measure

SLOPE = 0.25


def hill(spec, **properties):
    """A field that rises along x with `SLOPE`: z = 0 at x = -5, over a base of 1 m."""
    rising = np.tile(np.linspace(0, 1, 21), (21, 1))
    spec.add_hfield(name="hill", nrow=21, ncol=21, size=(5, 5, 10 * SLOPE, 1), userdata=rising.ravel())
    spec.worldbody.add_geom(name="hill", type=mujoco.mjtGeom.mjGEOM_HFIELD, hfieldname="hill", **properties)
    return spec


def stone(spec, kind, height, x=1.0):
    body = spec.worldbody.add_body(name="stone", pos=(x, 0.3, SLOPE * (x + 5) + height))
    body.add_freejoint()
    if kind == "mesh":
        spec.add_mesh(
            name="stone", uservert=[v for s in (-0.2, 0.2) for t in (-0.2, 0.2) for u in (-0.2, 0.2) for v in (s, t, u)]
        )
        body.add_geom(name="stone", type=mujoco.mjtGeom.mjGEOM_MESH, meshname="stone")
    else:
        kinds = {"sphere": mujoco.mjtGeom.mjGEOM_SPHERE, "box": mujoco.mjtGeom.mjGEOM_BOX}
        body.add_geom(name="stone", type=kinds[kind], size=(0.2, 0.2, 0.2))
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data, model.geom("hill").id, model.geom("stone").id


@pytest.mark.parametrize("height", [0.6, 0.3, 0.22, 0.1, -0.3])
def test_a_ball_is_as_far_from_a_slope_as_geometry_says(height):
    model, data, field, ball = stone(hill(empty()), "sphere", height)
    truth = height / np.hypot(1, SLOPE) - 0.2
    assert distance(model, data, ball, field, 10.0) == pytest.approx(truth, abs=2e-3)
    assert distance(model, data, field, ball, 10.0) == pytest.approx(truth, abs=2e-3)
    assert (data.ncon > 0) == (truth < 0)
    assert mujoco.mj_geomDistance(model, data, ball, field, 10.0, None) != pytest.approx(truth, abs=0.1)


@pytest.mark.parametrize("kind", ["box", "mesh"])
@pytest.mark.parametrize("clear", [0.005, 0.4, -0.05])
def test_what_has_corners_is_held_against_the_field_by_them(kind, clear):
    model, data, field, geom = stone(hill(empty()), kind, 0.2 + 0.2 * SLOPE + clear)
    assert distance(model, data, geom, field, 10.0) == pytest.approx(clear / np.hypot(1, SLOPE), abs=1e-4)
    assert drop(model, data, geom, [field], 10.0) == pytest.approx(max(clear, 0), abs=1e-4)


def test_beside_a_field_there_is_nothing_to_meet():
    model, data, field, geom = stone(hill(empty()), "sphere", 0.3, x=9.0)
    assert distance(model, data, geom, field, 3.0) == 3.0
    assert drop(model, data, geom, [field], 3.0) == 3.0


@pytest.mark.parametrize("kind", ["sphere", "box", "mesh"])
def test_a_drop_onto_a_leaning_solid_ends_where_it_is_met(kind):
    spec = empty()
    wedge = [-5, -5, 0, -5, 5, 0, 5, -5, 0, 5, 5, 0, 5, -5, 10 * SLOPE, 5, 5, 10 * SLOPE]
    spec.add_mesh(name="hill", uservert=wedge)
    body = spec.worldbody.add_body(name="hill")
    body.add_geom(name="hill", type=mujoco.mjtGeom.mjGEOM_MESH, meshname="hill")
    model, data, ground, geom = stone(spec, kind, 1.0)
    before = data.geom_xpos.copy()
    reach = 0.2 * np.hypot(1, SLOPE) if kind == "sphere" else 0.2 + 0.2 * SLOPE
    assert drop(model, data, geom, [ground], 10.0) == pytest.approx(1.0 - reach, abs=1e-3)
    assert (data.geom_xpos == before).all()


def test_a_ball_that_sinks_through_a_drawn_hill_is_seen_and_one_on_it_is_not(tmp_path):
    def found(folder, **properties):
        spec = hill(empty(), **properties)
        model, _, _, _ = stone(spec, "sphere", 0.22)
        return drawn_overlaps.find(model, record(model, tmp_path / folder, 300))

    (pair,) = found("through", contype=0, conaffinity=0)
    assert set(pair["bodies"]) == {"stone", "world"} and pair["depth_m"] > 0.05
    assert found("on") == []


def test_a_contact_with_a_field_keeps_its_depth_where_speculative_ones_are_measured_again():
    spec = hill(empty())
    spec.option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)
    model, data, _, _ = stone(spec, "sphere", 0.15)
    data.qvel[2] = -500.0
    mujoco.mj_forward(model, data)
    assert data.ncon
    assert true_distances(model, data, data.contact) == pytest.approx(data.contact.dist)


def test_lint_measures_a_field_by_the_box_around_its_surface_and_base():
    spec = empty()
    spec.add_hfield(name="hill", nrow=2, ncol=2, size=(5, 4, 2, 1), userdata=[0, 1, 0, 1])
    spec.worldbody.add_body(name="hill", pos=(0, 0, 1)).add_geom(type=mujoco.mjtGeom.mjGEOM_HFIELD, hfieldname="hill")
    arrays, _ = measure.facts(spec.compile())
    assert arrays["body_low"][1] == pytest.approx((-5, -4, -1)) and arrays["body_high"][1] == pytest.approx((5, 4, 2))

"""Visible geoms that pass through each other without a collision are found; honest neighbours are not."""

import tracemalloc

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor, record
from worldengine.recording import drawn_overlaps


def dropped(**properties):
    """A ball that falls onto a floor."""
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 0.3), **properties)
    return spec


def found(spec, folder, steps=400):
    model = spec.compile()
    return drawn_overlaps.find(spec.compile(), record(model, folder, steps))


def test_a_ball_that_rests_on_the_floor_overlaps_nothing(tmp_path):
    assert found(dropped(), tmp_path / "t") == []


@pytest.mark.parametrize("why", ["mask", "exclude", "bits", "flag", "flag constraint"])
def test_a_ball_that_sinks_through_the_floor_is_seen(why, tmp_path):
    spec = dropped(**{"mask": {"contype": 0, "conaffinity": 0}, "bits": {"contype": 2, "conaffinity": 2}}.get(why, {}))
    if why == "exclude":
        board = spec.worldbody.add_body(name="board", pos=(0, 0, 0.01))
        board.add_geom(name="board", type=mujoco.mjtGeom.mjGEOM_BOX, size=(1, 1, 0.01))
        spec.geom("ground").contype = spec.geom("ground").conaffinity = 0
        spec.geom("ground").group = 4  # not drawn
        spec.add_exclude(bodyname1="ball", bodyname2="board")
    if why == "flag":
        spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    if why == "flag constraint":
        spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
    (pair,) = found(spec, tmp_path / "t")
    assert set(pair["bodies"]) == {"ball", "board" if why == "exclude" else "world"}
    assert pair["depth_m"] > 0.01 and pair["time_s"] > 0.1
    words = {"mask": "ball has contype", "exclude": "exclusion", "bits": "do not match"}
    assert words.get(why, "contacts are disabled") in pair["why"]


def test_what_is_not_drawn_or_tied_or_one_mechanism_is_left_out(tmp_path):
    hidden = dropped(contype=0, conaffinity=0, group=3)
    assert found(hidden, tmp_path / "hidden") == []
    clear = dropped(contype=0, conaffinity=0, rgba=(1, 1, 1, 0))
    assert found(clear, tmp_path / "clear") == []
    tied = empty(gravity=0)
    ball(tied, "a", (0, 0, 1), contype=0, conaffinity=0)
    ball(tied, "b", (0.05, 0, 1), contype=0, conaffinity=0)
    apart = found(tied.copy(), tmp_path / "apart", 10)
    assert len(apart) == 1 and apart[0]["depth_m"] == pytest.approx(0.15, abs=0.01)
    weld = tied.add_equality(name="hold", type=mujoco.mjtEq.mjEQ_WELD, name1="a", name2="b")
    weld.objtype = mujoco.mjtObj.mjOBJ_BODY
    assert found(tied, tmp_path / "tied", 10) == []


@pytest.mark.parametrize("kind", ["BOX", "CAPSULE", "CYLINDER", "ELLIPSOID", "SPHERE"])
def test_the_lowest_point_over_a_plane(kind, tmp_path):
    spec = empty()
    floor(spec)
    body = spec.worldbody.add_body(name="b", pos=(0, 0, 0.5), euler=(40, 20, 10))
    body.add_freejoint()
    body.add_geom(type=getattr(mujoco.mjtGeom, f"mjGEOM_{kind}"), size=(0.1, 0.2, 0.15))
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    distance = drawn_overlaps._distance(model, data, 1, 0)
    data.qpos[2] -= distance + 1e-4  # a tenth of a millimetre deep
    mujoco.mj_forward(model, data)
    assert data.ncon
    assert data.contact.dist.min() == pytest.approx(-1e-4, abs=2e-5)


@pytest.mark.parametrize(("joint", "left_out"), [("hinge", True), ("slide", False)])
def test_a_link_may_overlap_the_fixed_base_it_turns_on(joint, left_out, tmp_path):
    spec = empty(gravity=0)
    base = spec.worldbody.add_body(name="base", pos=(0, 0, 1))
    base.add_geom(name="base", type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 0.1, 0.1))
    link = base.add_body(name="link", pos=(0, 0, 0.1))
    link.add_joint(type=getattr(mujoco.mjtJoint, f"mjJNT_{joint.upper()}"), axis=(0, 1, 0))
    link.add_geom(name="link", type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=(0.05, 0.1, 0))
    spec.add_exclude(bodyname1="base", bodyname2="link")
    assert (found(spec, tmp_path / "t", 10) == []) == left_out


def test_the_grains_of_a_law_are_not_held_against_one_another():
    """17,361 of them are 150 million pairs: that was 5.3 GB, and the end of a recording that was whole."""
    spec = empty()
    floor(spec)
    shown = spec.worldbody.add_body(name="snow")
    for n in range(4000):
        shown.add_geom(size=[0.01, 0, 0], pos=(0, 0, 0.02 * n), contype=0, conaffinity=0)
    ball(spec, "ball", (0, 0, 1))
    model = spec.compile()
    tracemalloc.start()
    pairs = drawn_overlaps._candidates(model)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert len(pairs) == 4000 and most < 20e6


@pytest.mark.parametrize("at_once", [3, 1 << 18])
def test_pairs_of_trees_come_in_order_however_many_at_once(at_once, monkeypatch):
    monkeypatch.setattr(drawn_overlaps, "AT_ONCE", at_once)
    tree = np.array([-1, 0, -1, 1, 1, -1, 0])
    found = [
        pair for one, other in drawn_overlaps._apart(tree) for pair in zip(one.tolist(), other.tolist(), strict=True)
    ]
    assert found == [(i, j) for i in range(7) for j in range(i + 1, 7) if tree[i] != tree[j]]
    assert list(drawn_overlaps._apart(np.full(4, -1))) == []

"""What a file beside the program sculpts becomes one thing of a world, with the planned mass, under planned names."""

import sys

import mujoco
import numpy as np
import pytest

from worldkit import joints, kept_shapes, scene, sculpt
from worldkit.errors import ProgramError
from worldkit.sculpt import from_files, made_ahead, minting, showing

FILE = """\
from tints import RED
from worldkit import joints, sculpt

MAKE = {"cells": 20, "hulls": "convex"}
BALL = sculpt.sphere(0.1)
TOY = (
    sculpt.Part("body", sculpt.sphere(0.1), look=RED, density=500, make=MAKE),
    sculpt.Part(
        "arm", sculpt.box((0.1, 0.02, 0.02)).translate(0.09), parent="body", density=1000, make=MAKE,
        joint=joints.Hinge("elbow", anchor=(0.05, 0, 0), axis=(0, 1, 0)),
    ),
)
LOOSE = (sculpt.Part("a", BALL), sculpt.Part("b", BALL))
"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDKIT_SCULPT_CACHE", str(tmp_path / "kept"))
    monkeypatch.syspath_prepend(str(tmp_path))
    minting._memory.clear()
    from_files._held.cache_clear()
    from_files._parts.cache_clear()
    (tmp_path / "sculpt").mkdir()
    (tmp_path / "sculpt/tints.py").write_text('RED = "#cc2222"\n')
    (tmp_path / "sculpt/toy.py").write_text(FILE)
    return tmp_path


def test_the_planned_mass_is_shared_out_and_the_whole_box_lies_where_it_is_put():
    spec = scene.new("bench", time_step=0.002)
    sculpt.from_file(spec, "sculpt/toy.py", of="TOY", name="toy", pos=(1, 2, 0.5), yaw_deg=90, mass=2.0)
    model = spec.compile()
    assert model.body("toy").subtreemass[0] == pytest.approx(2.0)
    own = minting.made(sculpt.sphere(0.1), cells=20, hulls="convex").volume * 500
    hand = minting.made(sculpt.box((0.1, 0.02, 0.02)).translate(0.09), cells=20, hulls="convex").volume * 1000
    assert model.body("toy_arm").mass[0] == pytest.approx(2 * hand / (own + hand))
    assert model.joint("toy_elbow").bodyid[0] == model.body("toy_arm").id and model.joint("toy").type[0] == 0
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    # Its box reaches from -0.05 to 0.14 along its own x, which points along +y.
    assert data.body("toy").xpos == pytest.approx((1, 2 - 0.045, 0.5), abs=2e-3)
    assert data.joint("toy_elbow").xanchor == pytest.approx((1, 2 + 0.005, 0.5), abs=2e-3)


def test_two_of_one_file_have_names_and_surfaces_of_their_own_and_its_joints_move_on_a_fixed_one():
    spec = scene.new("bench", time_step=0.002)
    grip = {"friction": (0.9, 0.005, 0.0001), "density": 100.0}
    sculpt.from_file(spec, "sculpt/toy.py", of="TOY", name="left", pos=(0, 0, 1), surface=grip, fixed=True)
    hinge = joints.Hinge("swing", anchor=(3, 0, 2), axis=(0, 1, 0))
    sculpt.from_file(spec, "sculpt/toy.py", of="BALL", name="right", pos=(3, 0, 1), joint=hinge)
    model = spec.compile()
    assert model.geom("left_arm").friction[0] == 0.9
    assert model.body("left").mass[0] == pytest.approx(100 * np.pi / 6 * 0.001, rel=0.02)
    assert {model.joint(j).name for j in range(model.njnt)} == {"left_elbow", "swing"}


@pytest.mark.parametrize(
    ("file", "of", "said"),
    [
        ("sculpt/gone.py", "", "no such file"),
        ("/etc/passwd.py", "", "beside the program"),
        ("sculpt/toy.py", "HARE", "no 'HARE' in it"),
        ("sculpt/tints.py", "", "nothing sculpted"),
    ],
)
def test_what_is_not_there_is_told_by_its_name(file, of, said):
    with pytest.raises(ProgramError, match=said), from_files.sculpted(file, of):
        pass


def test_one_part_stands_by_itself():
    with pytest.raises(ValueError, match="a, b"):
        sculpt.from_file(scene.new("bench", time_step=0.002), "sculpt/toy.py", of="LOOSE", name="two", pos=(0, 0, 1))


LAZY = """\
from worldkit import sculpt

CALLS = []


def figure():
    import late_shapes

    CALLS.append(1)
    return sculpt.Part("one", late_shapes.BALL, paint=paint, make={"cells": 16, "texels": 64})


def paint(points, normals):
    import late_tints

    return points * 0 + late_tints.GREY
"""


def test_what_a_function_or_a_paint_imports_lies_beside_the_file_in_every_process(folder, monkeypatch):
    (folder / "sculpt/lazy.py").write_text(LAZY)
    (folder / "sculpt/late_shapes.py").write_text("from worldkit import sculpt\nBALL = sculpt.sphere(0.1)\n")
    (folder / "sculpt/late_tints.py").write_text("GREY = 0.5\n")

    def forget():
        minting._memory.clear()
        for name in ("late_shapes", "late_tints"):
            sys.modules.pop(name, None)

    before = list(sys.path)
    spec = scene.new("bench", time_step=0.002)
    for name in ("first", "second"):
        forget()
        sculpt.from_file(spec, "sculpt/lazy.py", of="figure", name=name, pos=(0, 0, 1))
    assert sys.path == before
    calls = from_files._held(str(folder / "sculpt/lazy.py"))["CALLS"]
    assert len(calls) == 1  # once a process, however many bodies
    for begin, words in (
        (made_ahead.main, [str(folder), "sculpt/lazy.py", str(folder / "out"), "figure"]),
        (showing.main, [str(folder / "sculpt/lazy.py"), "--name", "figure", "--out", str(folder / "out")]),
    ):
        monkeypatch.setenv("WORLDKIT_SCULPT_CACHE", str(folder / begin.__module__))
        forget()
        assert begin(words) == 0
        monkeypatch.setattr(sys, "path", list(before))


@pytest.mark.parametrize("damage", ["cut", "changed", "doubled"])
def test_a_kept_shape_that_is_broken_is_made_anew(folder, monkeypatch, damage):
    first = minting.made(sculpt.sphere(0.1), cells=16)
    (entry,) = (folder / "kept").glob("*.npz")
    good = entry.read_bytes()
    bad = good[:-40] if damage == "cut" else good[:300] + b"?" + good[301:]
    if damage == "doubled":  # each has the hash of its name, and they cannot both be right
        entry.with_name(kept_shapes.name_of(first.signature, bad)).write_bytes(bad)
    else:
        entry.write_bytes(bad)
    builds = []
    make = minting._made
    monkeypatch.setattr(minting, "_made", lambda *given: builds.append(given[0]) or make(*given))
    for count in (1, 1):  # once anew, and then it is kept again
        minting._memory.clear()
        again = minting.made(sculpt.sphere(0.1), cells=16)
        assert len(builds) == count and np.array_equal(again.vertices, first.vertices)
    assert [path.name for path in (folder / "kept").glob("*.npz")] == [entry.name]

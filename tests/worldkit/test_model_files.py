"""A model's files are found from one root, whatever names them; what is missing, elsewhere or without end is said by a code."""

from pathlib import Path

import mujoco
import numpy as np
import pytest
import trimesh

from worldkit import model_files, model_references, models

URDF = """<robot name="pan">
  <material name="steel"><color rgba="0.2 0.3 0.9 1"/><texture filename="nowhere.jpg"/></material>
  <link name="base"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry><mesh filename="package://pan/meshes/seen.dae"/></geometry><material name="steel"/></visual>
    <collision><geometry><mesh filename="package://pan/meshes/base.stl" scale="0.001 0.001 0.001"/></geometry></collision></link>
</robot>"""
DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="24">{points}</float_array><technique_common>
<accessor source="#a" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>{faces}</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="w"><node><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#w"/></scene></COLLADA>"""
MAIN = """<mujoco><compiler meshdir="assets"/><include file="parts/links.xml"/>
<asset><mesh name="block" file="block.stl" scale="0.001 0.001 0.001"/></asset></mujoco>"""
LINKS = """<mujocoinclude><worldbody><body name="a"><freejoint/><geom type="mesh" mesh="block"/></body></worldbody>
<include file="parts/more.xml"/></mujocoinclude>"""


def box(*size: float) -> trimesh.Trimesh:
    return trimesh.creation.box(size)


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A package as ROS lays it out, its meshes beside the folder of the URDF."""
    for name in ("urdf", "meshes"):
        (tmp_path / "pan" / name).mkdir(parents=True)
    box(200, 200, 100).export(tmp_path / "pan/meshes/base.stl")
    mesh = box(20, 20, 30)
    points, faces = (" ".join(f"{v:g}" for v in rows.ravel()) for rows in (mesh.vertices, mesh.faces))
    (tmp_path / "pan/meshes/seen.dae").write_text(DAE.format(points=points, faces=faces))
    (tmp_path / "pan/urdf/pan.urdf").write_text(URDF)
    return tmp_path


@pytest.fixture
def parted(tmp_path: Path) -> Path:
    """An MJCF in three files, with a mesh in its assets."""
    for name in ("parts", "assets"):
        (tmp_path / "arm" / name).mkdir(parents=True)
    box(100, 100, 100).export(tmp_path / "arm/assets/block.stl")
    (tmp_path / "arm/arm.xml").write_text(MAIN)
    (tmp_path / "arm/parts/links.xml").write_text(LINKS)
    (tmp_path / "arm/parts/more.xml").write_text("<mujocoinclude><custom/></mujocoinclude>")
    return tmp_path


def test_a_package_is_found_and_what_is_seen_is_apart_from_what_is_touched(package: Path, monkeypatch) -> None:
    made = model_files.whole(package / "pan/urdf/pan.urdf", package)
    assert sorted(made.files) == ["pan/meshes/base.stl", "pan/meshes/seen.dae"]
    monkeypatch.syspath_prepend(str(package))
    spec = mujoco.MjSpec()
    models.attach(spec, made.text, name="pan", pos=(0, 0, 1), files=made.files)
    model = spec.compile()
    seen, touched = (model.geom(g) for g in range(2))
    assert (seen.group[0], seen.contype[0], touched.group[0], touched.contype[0]) == (1, 0, 3, 1)
    assert seen.rgba == pytest.approx((0.2, 0.3, 0.9, 1))
    sizes = [
        np.ptp(model.mesh_vert[a : a + n], axis=0) for a, n in zip(model.mesh_vertadr, model.mesh_vertnum, strict=True)
    ]
    assert sorted(np.round(size.max(), 4) for size in sizes) == [0.2, 0.3], (
        "COLLADA's unit is honoured, and a scale in the URDF"
    )
    facts = models.facts(made.text, "pan", files=made.files, root=str(package))
    assert facts["extents"] == pytest.approx([0.2, 0.2, 0.3], abs=1e-6)
    with pytest.raises(ValueError, match="not among its `files`"):
        models.attach(mujoco.MjSpec(), made.text, name="pan", pos=(0, 0, 1))


def test_includes_become_one_text(parted: Path, monkeypatch) -> None:
    made = model_files.whole(parted / "arm/arm.xml", parted)
    assert "<include" not in made.text and made.files == ("arm/assets/block.stl",) and len(made.sources) == 3
    monkeypatch.syspath_prepend(str(parted))
    spec = mujoco.MjSpec()
    models.attach(spec, made.text, name="arm", pos=(0, 0, 1), files=made.files)
    assert spec.compile().body("arm").mass[0] == pytest.approx(1.0)
    assert [path.name for path in model_files.models_in(parted)] == ["arm.xml"]


def test_a_model_without_files_stays_as_it_is_written(tmp_path: Path) -> None:
    text = "<!-- a ball -->\n<mujoco><worldbody><body><geom size='.1'/></body></worldbody></mujoco>\n"
    (tmp_path / "ball.xml").write_text(text)
    assert model_files.whole(tmp_path / "ball.xml", tmp_path) == model_files.Whole(text, (), (tmp_path / "ball.xml",))


def test_a_model_in_another_encoding_is_read_as_it_declares(tmp_path: Path) -> None:
    text = (
        '<?xml version="1.0" encoding="ISO-8859-1"?><robot name="r"><!-- Gr\xf6\xdfe --><link name="\xfcber"/></robot>'
    )
    (tmp_path / "a.urdf").write_text(text, encoding="latin-1")
    made = model_files.whole(tmp_path / "a.urdf", tmp_path)
    assert 'link name="\xfcber"' in made.text and "encoding" not in made.text and made.files == ()


def refused(path: Path, root: Path) -> model_files.ModelFileError:
    with pytest.raises(model_files.ModelFileError) as told:
        model_files.whole(path, root)
    assert told.value.place and told.value.next_move
    return told.value


def test_meshes_that_are_missing_are_named_together(package: Path) -> None:
    for path in (package / "pan/meshes").iterdir():
        path.unlink()
    told = refused(package / "pan/urdf/pan.urdf", package)
    assert told.code == "missing" and "seen.dae" in told.cause and "base.stl" in told.cause


@pytest.mark.parametrize("name", ["/home/me/meshes/base.stl", "file:///home/me/base.stl", "C:/meshes/base.stl"])
def test_a_place_on_one_machine_is_refused_and_the_file_of_its_name_is_shown(package: Path, name: str) -> None:
    path = package / "pan/urdf/pan.urdf"
    (path.parent / "base.stl").write_bytes((package / "pan/meshes/base.stl").read_bytes())
    path.write_text(URDF.replace("package://pan/meshes/base.stl", name))
    told = refused(path, package)
    assert told.code == "absolute" and name in told.cause and told.next_move.endswith("folder: base.stl")


def test_what_lies_outside_and_what_a_mesh_may_not_be_are_refused(package: Path) -> None:
    path = package / "pan/urdf/pan.urdf"
    assert refused(path, package / "pan/urdf").code == "missing", "a package is not looked for above the root"
    path.write_text(URDF.replace("package://pan/meshes", "../meshes"))
    assert refused(path, package / "pan/urdf").code == "climbs_out"
    (package / "pan/meshes/base.step").write_text("")
    path.write_text(URDF.replace("base.stl", "base.step"))
    assert refused(path, package).code == "unknown_format"
    (package / "pan/meshes/link.stl").symlink_to("/etc/passwd")
    path.write_text(URDF.replace("base.stl", "link.stl"))
    assert refused(path, package).code == "climbs_out"


@pytest.mark.parametrize(
    ("text", "code", "said"),
    [
        (
            '<mujocoinclude><include file="parts/links.xml"/></mujocoinclude>',
            "cyclic",
            "links.xml -> more.xml -> links.xml",
        ),
        ('<mujocoinclude><include file="arm.xml"/></mujocoinclude>', "cyclic", "itself"),
        ('<mujocoinclude><include file="none.xml"/></mujocoinclude>', "missing", "none.xml"),
        ('<mujocoinclude><include file="/etc/x.xml"/></mujocoinclude>', "absolute", "/etc/x.xml"),
        ("<mujocoinclude>", "unreadable", "not XML"),
        ('<!DOCTYPE a [<!ENTITY b "c">]><mujocoinclude/>', "unreadable", "entities"),
        (" " * (model_files.MOST_BYTES + 1), "too_large", "2 MB"),
    ],
)
def test_an_include_that_is_none_is_refused(parted: Path, text: str, code: str, said: str) -> None:
    (parted / "arm/parts/more.xml").write_text(text)
    told = refused(parted / "arm/arm.xml", parted)
    assert told.code == code and said in told.cause


def test_a_document_type_is_what_no_model_may_have() -> None:
    """Its entities stand for whatever they say, a file among it."""
    text = '<!DOCTYPE a [<!ENTITY b SYSTEM "/etc/hostname">]>\n<mujoco><worldbody/></mujoco>'
    assert list(model_references.outside(text)) == [(1, "<!DOCTYPE a>")]

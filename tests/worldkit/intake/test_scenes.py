"""COLLADA and USD: the same crate in other units and axes, with its colours and pictures; what is no scene is refused."""

import zipfile
from io import BytesIO
from pathlib import Path

import cv2
import numpy as np
import pytest
import trimesh
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade

from worldkit.errors import IntakeError
from worldkit.intake import declared_sizes, drawn_pieces, taken_in, told_frames, unpacked

OAK = {"name": "oak", "density": 690.0, "friction": 0.4, "restitution": 0.4, "source": "a table"}
ASKED = {
    "key": "crate", "category": "crate", "description": "a crate", "licence": "CC0-1.0", "creator": "somebody", "source": "a test",
    "material": OAK,
}  # fmt: skip
RED = np.full((4, 4, 3), (0, 0, 255), np.uint8)


SAMPLER = """<newparam sid="s"><surface type="2D"><init_from>p</init_from></surface></newparam>
<newparam sid="t"><sampler2D><source>s</source></sampler2D></newparam>"""


def collada(
    path: Path, *, up: str = "Z_UP", meter: str = "0.01", diffuse: str = "", library: str = "", wedge: bool = False
) -> Path:
    """A crate 60 along the front's axis, 40 wide, 30 high; or a wedge that is lower in front."""
    size = {"Z_UP": (40, 60, 30), "Y_UP": (40, 30, 60), "X_UP": (30, 40, 60)}[up]
    box = trimesh.creation.box(size)
    if wedge:
        high, ahead = {
            "Z_UP": (2, -box.vertices[:, 1]),
            "Y_UP": (1, box.vertices[:, 2]),
            "X_UP": (0, box.vertices[:, 2]),
        }[up]
        box.vertices[(ahead > 0) & (box.vertices[:, high] > 0), high] = -5
    points = " ".join(f"{value:g}" for value in box.vertices.ravel())
    uv = "0 0 1 0 1 1"
    corners = " ".join(f"{corner} {k}" for face in box.faces for k, corner in enumerate(face))
    path.write_text(f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="u" meter="{meter}"/><up_axis>{up}</up_axis></asset>
{library}
<library_effects><effect id="e"><profile_COMMON>
{SAMPLER if library else ""}<technique sid="c"><phong><diffuse>{diffuse or "<color>0.2 0.4 0.6 1</color>"}</diffuse></phong></technique>
</profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="pos"><float_array id="pa" count="24">{points}</float_array><technique_common>
<accessor source="#pa" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<source id="uv"><float_array id="ua" count="6">{uv}</float_array><technique_common>
<accessor source="#ua" count="3" stride="2"><param name="S" type="float"/><param name="T" type="float"/></accessor>
</technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#pos"/></vertices>
<triangles count="12" material="sym"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#uv" offset="1"/><p>{corners}</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="w"><node id="n"><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="sym" target="#m"/></technique_common></bind_material></instance_geometry></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#w"/></scene></COLLADA>""")
    return path


PICTURED = {
    "diffuse": '<texture texture="t" texcoord="UV"/>',
    "library": '<library_images><image id="p"><init_from>file:///C:/crate/my%20grain.png</init_from></image></library_images>',
}


def usd(path: Path, *, up: str = "Z", meter: float | None = 0.01, picture: str = "") -> Path:
    """The same crate, scaled by its parent, of quads whose picture lies on each of them."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, up)
    if meter:
        UsdGeom.SetStageMetersPerUnit(stage, meter)
    UsdGeom.Xform.Define(stage, "/crate").AddScaleOp().Set((10, 10, 10))
    mesh = UsdGeom.Mesh.Define(stage, "/crate/skin")
    x, y, z = (6, 4, 3) if up == "Z" else (4, 3, 6)
    points = [(a * x / 2, b * y / 2, c * z / 2) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    mesh.GetPointsAttr().Set([Gf.Vec3f(*p) for p in points])
    mesh.GetFaceVertexCountsAttr().Set([4] * 6)
    mesh.GetFaceVertexIndicesAttr().Set([corner for quad in quads for corner in quad])
    mesh.GetSubdivisionSchemeAttr().Set("none")
    st = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, "faceVarying")
    st.Set([(0, 0), (1, 0), (1, 1), (0, 1)] * 6)
    material = UsdShade.Material.Define(stage, "/looks/paint")
    shader = UsdShade.Shader.Define(stage, "/looks/paint/surface")
    shader.CreateIdAttr("UsdPreviewSurface")
    colour = shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f)
    shader.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(0.25)
    if picture:
        texture = UsdShade.Shader.Define(stage, "/looks/paint/texture")
        texture.CreateIdAttr("UsdUVTexture")
        texture.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(picture)
        colour.ConnectToSource(texture.ConnectableAPI(), "rgb")
    else:
        colour.Set((0.5, 0.0, 1.0))
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(material)
    stage.Save()
    return path


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (collada, {"up": "Z_UP"}),
        (collada, {"up": "Y_UP"}),
        (collada, {"up": "X_UP"}),
        (usd, {"up": "Z"}),
        (usd, {"up": "Y"}),
    ],
)
def test_the_unit_and_the_axes_that_a_file_tells_are_taken(made, words: dict, tmp_path: Path) -> None:
    path = made(tmp_path / ("crate.dae" if made is collada else "crate.usda"), **words)
    _, facts = taken_in.take_in(path, ASKED)
    assert facts["native_extents"] == pytest.approx([0.6, 0.4, 0.3], abs=1e-5)
    assert "its unit is 0.01 m" in facts["metric_height_source"] and facts["assumed"] == []
    assert facts["measured"]["closed"] and facts["solid_volume"] == pytest.approx(0.072)


@pytest.mark.parametrize("up", ["X_UP", "Y_UP", "Z_UP"])
def test_the_front_of_a_collada_is_towards_who_looks_at_it(up: str, tmp_path: Path) -> None:
    files, facts = taken_in.take_in(collada(tmp_path / "crate.dae", up=up, wedge=True), ASKED)
    seen = trimesh.load(BytesIO(files[facts["visual"][0]["mesh"]]), file_type="obj")
    in_front = seen.vertices[:, 0] > 0
    assert np.ptp(seen.vertices[in_front, 2]) == pytest.approx(0.10, abs=1e-4)
    assert np.ptp(seen.vertices[~in_front, 2]) == pytest.approx(0.30, abs=1e-4)


def test_what_a_file_does_not_tell_is_asked_for(tmp_path: Path) -> None:
    path = usd(tmp_path / "crate.usdc", meter=None)
    assert told_frames.of(path).unit_m == 0
    with pytest.raises(IntakeError, match="tell no unit"):
        taken_in.take_in(path, ASKED)


def test_the_colours_of_a_scene_are_those_that_are_seen(tmp_path: Path) -> None:
    (of_collada,), _ = drawn_pieces.read(collada(tmp_path / "crate.dae"))
    assert of_collada.rgba == pytest.approx((0.2, 0.4, 0.6, 1), abs=0.01), "COLLADA's are sRGB as they stand"
    (of_usd,), _ = drawn_pieces.read(usd(tmp_path / "crate.usda"))
    assert of_usd.rgba == pytest.approx((0.5 ** (1 / 2.2), 0, 1, 1), abs=0.01), "USD's are of light"
    assert of_usd.roughness == 0.25


def test_pictures_come_along_by_the_name_that_another_machine_gave_them(tmp_path: Path) -> None:
    (tmp_path / "textures").mkdir()
    cv2.imwrite(str(tmp_path / "textures" / "my grain.png"), RED)
    (piece,), said = drawn_pieces.read(collada(tmp_path / "crate.dae", **PICTURED))
    assert piece.picture is not None and piece.picture[0, 0].tolist() == [255, 0, 0] and said == []
    (piece,), said = drawn_pieces.read(usd(tmp_path / "crate.usda", picture="./textures/my grain.png"))
    assert piece.picture is not None and piece.picture[0, 0].tolist() == [255, 0, 0] and said == []
    assert piece.uv is not None and len(piece.vertices) == 24, (
        "each corner of a quad has a place of its own on the picture"
    )
    (_,), said = drawn_pieces.read(usd(tmp_path / "bare.usda", picture="./none.png"))
    assert len(said) == 1 and "none.png" in said[0]


def test_a_usdz_is_unpacked_and_its_first_layer_is_the_scene(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "a.png"), RED)
    usd(tmp_path / "crate.usdc", picture="a.png")
    with zipfile.ZipFile(tmp_path / "crate.usdz", "w") as made:
        for name in ("crate.usdc", "a.png"):
            made.write(tmp_path / name, f"0/{name}")
    scene = unpacked.unpack(tmp_path / "crate.usdz", tmp_path / "out")
    (piece,), said = drawn_pieces.read(scene)
    assert piece.picture is not None and said == []


def test_a_mirrored_mesh_is_turned_outside_out_and_what_is_hidden_is_left_out(tmp_path: Path) -> None:
    path = usd(tmp_path / "crate.usda")
    stage = Usd.Stage.Open(str(path))
    UsdGeom.Xform(stage.GetPrimAtPath("/crate")).GetOrderedXformOps()[0].Set((10, -10, 10))
    UsdGeom.Sphere.Define(stage, "/guide").CreatePurposeAttr("guide")
    UsdGeom.Sphere.Define(stage, "/gone").MakeInvisible()
    UsdGeom.Cylinder.Define(stage, "/pin").CreateAxisAttr("X")
    stage.Save()
    pieces, _ = drawn_pieces.read(path)
    assert len(pieces) == 2
    volume = trimesh.Trimesh(pieces[0].vertices, pieces[0].faces, process=False).volume
    assert volume == pytest.approx(72_000)
    assert np.ptp(pieces[1].vertices, axis=0) == pytest.approx((2, 2, 2), abs=0.01)


def test_of_what_moves_the_first_moment_is_taken(tmp_path: Path) -> None:
    """Values by time alone: where things are, what they are of, what is seen of them, and their colours."""
    path = tmp_path / "moving.usda"
    stage = Usd.Stage.CreateNew(str(path))
    for number, name in enumerate(("one", "other")):
        place = UsdGeom.Xform.Define(stage, f"/{name}")
        way = place.AddTranslateOp()
        box = trimesh.creation.box((1, 1, 1))
        mesh = UsdGeom.Mesh.Define(stage, f"/{name}/mesh")
        for time in (10, 20):
            way.Set((10 * number + time, 0, 0), time)
            mesh.GetPointsAttr().Set([Gf.Vec3f(*(float(v) * time for v in p)) for p in box.vertices], time)
            mesh.GetDisplayColorAttr().Set([(1, 0, 0) if time == 10 else (0, 1, 0)], time)
        mesh.GetFaceVertexCountsAttr().Set([3] * 12, 10)
        mesh.GetFaceVertexIndicesAttr().Set(box.faces.ravel().tolist(), 10)
        mesh.GetSubdivisionSchemeAttr().Set("none")
    ball = UsdGeom.Sphere.Define(stage, "/ball")
    ball.GetRadiusAttr().Set(3.0, 10)
    hidden = UsdGeom.Cube.Define(stage, "/hidden").GetVisibilityAttr()
    for time, seen in ((10, "invisible"), (20, "inherited")):
        hidden.Set(seen, time)
    stage.Save()
    pieces, said = drawn_pieces.read(path)
    assert said == ["it changes with time: its first moment was taken"]
    assert sorted(float(np.ptp(piece.vertices[:, 0])) for piece in pieces) == pytest.approx([6, 10, 10], abs=0.05)
    middles = sorted(float(np.mean(piece.vertices[:, 0])) for piece in pieces)
    assert middles == pytest.approx([0, 10, 20], abs=0.05)
    assert sum(piece.rgba[:2] == (1, 0) for piece in pieces) == 2
    assert "moment" not in " ".join(drawn_pieces.read(usd(tmp_path / "still.usda"))[1])


BOMB = """<?xml version="1.0"?><!DOCTYPE COLLADA [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;">]><COLLADA>&b;</COLLADA>"""

OUT_OF_RANGE = """#usda 1.0
def Mesh "a" {
  int[] faceVertexCounts = [3]
  int[] faceVertexIndices = [0, 1, 9]
  point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
}
"""


def drawing(count: int, nodes: str, faces: int = 300_000) -> str:
    """A COLLADA of one geometry of so many faces, which a scene draws so many times."""
    library = f'<library_geometries><geometry id="g"><mesh><triangles count="{faces}"/></mesh></geometry></library_geometries>'
    scene = f'<visual_scene id="w">{count * nodes}</visual_scene>'
    return f"<COLLADA>{library}<library_visual_scenes>{scene}</library_visual_scenes>LIBRARY</COLLADA>"


DRAWN = '<node><node><instance_geometry url="#g"/></node></node>'
LAUGHS = "".join(
    f'<node id="n{k}"><instance_node url="#n{k + 1}"/><instance_node url="#n{k + 1}"/></node>' for k in range(60)
)
LAUGHS = f'<library_nodes>{LAUGHS}<node id="n60"><instance_geometry url="#g"/><instance_node url="#n0"/></node></library_nodes>'


def read(path: Path) -> None:
    declared_sizes.check(path)
    drawn_pieces.read(path)


@pytest.mark.parametrize(
    ("name", "text", "code", "said"),
    [
        ("a.dae", BOMB, "unreadable", "entities"),
        ("a.dae", "<COLLADA>" + "<node>" * 400, "unreadable", "nested"),
        ("a.dae", "<COLLADA><library>", "truncated", "whole"),
        ("a.dae", "<svg></svg>", "no_mesh", "svg"),
        ("a.dae", '<COLLADA><triangles count="9000000"/></COLLADA>', "too_many_faces", "9,000,000"),
        ("a.dae", drawing(9, DRAWN), "too_many_faces", "2,700,000"),
        ("a.dae", drawing(1, '<node><instance_node url="#n0"/></node>').replace("LIBRARY", LAUGHS), "too_many_faces", "1,000,000,000,000"),
        ("a.usda", "#usda 1.0\ndef Mesh {{{", "unreadable", "read: a.usda:2:1: parse error"),
        ("a.usdc", "PXR-USDC" + 80 * "\0", "unreadable", "read: Cannot read asset @a.usdc@ with obsolete version"),
        ("a.usda", OUT_OF_RANGE.replace("[3]", "[0]").replace("0, 1, 9", ""), "no_mesh", "triangle"),
        ("a.usda", "PK\x03\x04", "no_mesh", "begin"),
        ("a.usdc", "PXR-USDC", "truncated", "header"),
        ("a.usda", '#usda 1.0\ndef Xform "a" {}\n', "no_mesh", "triangle"),
        (
            "a.usda",
            OUT_OF_RANGE,
            "truncated",
            "corners",
        ),
    ],
)  # fmt: skip
def test_what_is_no_scene_is_refused_by_a_code(name: str, text: str, code: str, said: str, tmp_path: Path) -> None:
    (folder := tmp_path / "my scenes").mkdir()
    path = folder / name
    path.write_text(text)
    with pytest.raises(IntakeError, match=said) as told:
        read(path)
    assert told.value.code == code and told.value.place.startswith(name) and told.value.next_move


def test_a_stage_reads_no_layer_outside_of_its_folder(tmp_path: Path) -> None:
    usd(tmp_path / "secret.usda")
    (tmp_path / "in").mkdir()
    path = tmp_path / "in" / "a.usda"
    path.write_text('#usda 1.0\n(subLayers = [@../secret.usda@])\ndef Xform "a" {}\n')
    with pytest.raises(IntakeError, match="outside") as told:
        drawn_pieces.read(path)
    assert told.value.code == "climbs_out"


def test_a_picture_that_is_too_large_is_refused_before_it_is_decoded(tmp_path: Path) -> None:
    head = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR" + (30_000).to_bytes(4, "big") * 2 + b"\x08\x02\0\0\0"
    (tmp_path / "my grain.png").write_bytes(head)
    with pytest.raises(IntakeError, match="30,000") as told:
        declared_sizes.check(collada(tmp_path / "a.dae", **PICTURED))
    assert told.value.code == "picture_too_large"
    with pytest.raises(IntakeError, match="30,000"):
        drawn_pieces.read(usd(tmp_path / "a.usda", picture="my grain.png"))


def test_a_geometry_counts_as_often_as_it_is_drawn_whatever_the_format(tmp_path: Path, monkeypatch) -> None:
    scene = trimesh.Scene()
    ball = trimesh.creation.icosphere(2)
    for number in range(3):
        scene.add_geometry(ball, geom_name="ball", transform=trimesh.transformations.translation_matrix((number, 0, 0)))
    scene.export(tmp_path / "a.glb")
    assert sum(len(piece.faces) for piece in drawn_pieces.read(tmp_path / "a.glb")[0]) == 960
    monkeypatch.setattr(declared_sizes, "MOST_FACES", 900)
    monkeypatch.setattr(trimesh.Scene, "dump", None)
    with pytest.raises(IntakeError, match="960 faces"):
        drawn_pieces.read(tmp_path / "a.glb")
    (tmp_path / "b.dae").write_text(drawing(3, DRAWN, 200))
    assert declared_sizes.check(tmp_path / "b.dae") == 600

"""A glTF whose parts lie beside it, and what a printer is given, become one GLB: of the same size, standing, in their colours."""

import base64
import json
import zipfile
from pathlib import Path

import cv2
import numpy as np
import pytest
import trimesh

from worldkit.errors import IntakeError
from worldkit.intake import as_glb, declared_sizes, drawn_pieces, unpacked

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
MESH = (
    "<mesh><vertices>" + "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in ((0, 0, 0), (20, 0, 0), (0, 30, 0), (0, 0, 50)))
    + "</vertices><triangles>" + "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"{more}/>' for a, b, c, more in (
        (0, 2, 1, ""), (0, 1, 3, ""), (1, 2, 3, ' pid="7" p1="1"'), (2, 0, 3, ' pid="7" p1="1"'))) + "</triangles></mesh>"
)  # fmt: skip
COLOURS = '<basematerials id="7"><base name="a" displaycolor="#FF0000"/><base name="b" displaycolor="#0000FFFF"/></basematerials>'


def printed(path: Path, resources: str, build: str, unit: str = "millimeter", **parts: str) -> Path:
    """A 3MF package."""
    text = f'<model unit="{unit}" xmlns="{CORE}"><resources>{resources}</resources><build>{build}</build></model>'
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as held:
        held.writestr("3D/3dmodel.model", text)
        for name, content in parts.items():
            held.writestr(f"3D/Objects/{name}.model", content)
    return path


def taken(path: Path, folder: Path) -> tuple[list[drawn_pieces.Drawn], np.ndarray]:
    """The pieces of what it becomes, and its extents, m."""
    glb, _ = as_glb.written(path, folder)
    declared_sizes.check(glb)
    pieces, _ = drawn_pieces.read(glb)
    return pieces, np.ptp(np.concatenate([piece.vertices for piece in pieces]), axis=0)


def spread(path: Path, *, embedded: bool = False) -> Path:
    """A textured box as glTF, with its buffer and its picture beside it or within it."""
    box = trimesh.creation.box((0.2, 0.3, 0.4))
    image = np.zeros((8, 8, 3), np.uint8)
    image[:, :, 0] = 250  # blue, as cv2 orders colours
    png = cv2.imencode(".png", image)[1].tobytes()
    data = box.vertices.astype("<f4").tobytes() + np.zeros((8, 2), "<f4").tobytes() + box.faces.astype("<u4").tobytes()
    (path.parent / "my box.bin").write_bytes(data)
    (path.parent / "blue.png").write_bytes(png)
    low, high = box.bounds.tolist()
    scene = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
        "images": [{"uri": "blue.png"}], "buffers": [{"uri": "my%20box.bin", "byteLength": len(data)}],
        "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 64},
                        {"buffer": 0, "byteOffset": 160, "byteLength": 144}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": low, "max": high},
                      {"bufferView": 1, "componentType": 5126, "count": 8, "type": "VEC2"},
                      {"bufferView": 2, "componentType": 5125, "count": 36, "type": "SCALAR"}],
    }  # fmt: skip
    if embedded:
        scene["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
        scene["images"][0]["uri"] = "data:image/png;base64," + base64.b64encode(png).decode()
    path.write_text(json.dumps(scene), encoding="utf-8")
    return path


@pytest.mark.parametrize("embedded", [False, True])
def test_a_gltf_brings_its_buffer_and_its_picture(embedded: bool, tmp_path: Path) -> None:
    pieces, extents = taken(spread(tmp_path / "box.gltf", embedded=embedded), tmp_path / "out")
    assert np.allclose(extents, (0.2, 0.3, 0.4))
    assert pieces[0].picture is not None and pieces[0].picture[0, 0].tolist() == [0, 0, 250]


def test_a_picture_that_is_not_there_is_left_out_and_a_buffer_is_asked_for(tmp_path: Path) -> None:
    path = spread(tmp_path / "box.gltf")
    (tmp_path / "blue.png").unlink()
    glb, said = as_glb.written(path, tmp_path / "out")
    assert "blue.png" in said[0] and drawn_pieces.read(glb)[0][0].picture is not None
    (tmp_path / "my box.bin").unlink()
    with pytest.raises(IntakeError, match="not beside it") as told:
        as_glb.written(path, tmp_path / "out")
    assert told.value.code == "truncated" and "beside it" in told.value.next_move


def test_an_archive_of_a_gltf_comes_out_with_its_buffer(tmp_path: Path) -> None:
    path = spread(tmp_path / "box.gltf")
    with zipfile.ZipFile(tmp_path / "box.zip", "w") as held:
        for name in ("box.gltf", "my box.bin", "blue.png"):
            held.write(tmp_path / name, f"source/{name}")
    found = unpacked.unpack(tmp_path / "box.zip", tmp_path / "unpacked")
    glb, said = as_glb.written(found, tmp_path / "out")
    assert found.name == path.name and not said and np.allclose(taken(glb, tmp_path)[1], (0.2, 0.3, 0.4))


def test_a_gltf_reads_nothing_from_outside_of_its_folder(tmp_path: Path) -> None:
    (tmp_path / "inner").mkdir()
    path = spread(tmp_path / "inner" / "box.gltf")
    (tmp_path / "inner" / "my box.bin").rename(tmp_path / "my box.bin")
    path.write_text(path.read_text(encoding="utf-8").replace("my%20box.bin", "../my%20box.bin"), encoding="utf-8")
    with pytest.raises(IntakeError, match="not beside it"):
        as_glb.written(path, tmp_path / "out")


@pytest.mark.parametrize(
    ("old", "new", "code"),
    [
        ('"version": "2.0"', '"version": "1.0"', "unknown_format"),
        ('"buffer": 0', '"buffer": 9', "unreadable"),
        ('"buffer": 0', '"buffer": "x"', "unreadable"),
        ('"bufferViews": [', '"bufferViews": [7, ', "unreadable"),
        ("{", "", "no_mesh"),
    ],
)
def test_what_is_wrong_with_a_gltf_is_named(old: str, new: str, code: str, tmp_path: Path) -> None:
    path = spread(tmp_path / "box.gltf")
    path.write_text(path.read_text(encoding="utf-8").replace(old, new, 1), encoding="utf-8")
    with pytest.raises(IntakeError) as told:
        as_glb.written(path, tmp_path / "out")
    assert told.value.code == code and told.value.next_move


def test_what_is_printed_has_its_units_its_place_and_its_colours(tmp_path: Path) -> None:
    turned = 'transform="0 1 0 -1 0 0 0 0 1 100 0 0"'  # a quarter about z
    resources = COLOURS + f'<object id="1" pid="7" pindex="0">{MESH}</object>'
    pieces, extents = taken(printed(tmp_path / "a.3mf", resources, f'<item objectid="1" {turned}/>'), tmp_path / "out")
    assert np.allclose(extents, (0.030, 0.020, 0.050))
    assert sorted(tuple(np.round(piece.rgba, 2)) for piece in pieces) == [(0, 0, 1, 1), (1, 0, 0, 1)]
    _, inches = taken(printed(tmp_path / "b.3mf", resources, '<item objectid="1"/>', "inch"), tmp_path / "out")
    assert np.allclose(inches, 0.0254 * np.array((20, 30, 50)))


def test_it_stands_as_its_format_has_it_unless_another_side_is_asked_for() -> None:
    path = Path("a.3mf")
    assert as_glb.axes(path, {"key": "a"}) == {"key": "a", "up": "+z", "front": "-y"}
    assert as_glb.axes(path, {"front": "+x"}) == {"up": "+z", "front": "+x"}
    assert as_glb.axes(path, {"up": "-y"}) == {"up": "-y"} and as_glb.axes(Path("a.glb"), {}) == {}


def test_objects_of_objects_in_other_parts_are_placed(tmp_path: Path) -> None:
    other = f'<model xmlns="{CORE}"><resources><object id="5">{MESH}</object></resources></model>'
    held = '<object id="1"><components>' + "".join(
        f'<component p:path="/3D/Objects/leg.model" objectid="5" transform="1 0 0 0 1 0 0 0 1 {x} 0 0"/>' for x in (0, 80)
    ) + "</components></object>"  # fmt: skip
    held = held.replace("<object", '<object xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06"')
    pieces, extents = taken(printed(tmp_path / "a.3mf", held, '<item objectid="1"/>', leg=other), tmp_path / "out")
    assert len(pieces) == 2 and np.allclose(extents, (0.100, 0.030, 0.050))


@pytest.mark.parametrize(
    ("resources", "code"),
    [
        ('<object id="1"><components><component objectid="1"/></components></object>', "too_large"),
        ('<object id="1"><components><component objectid="9"/></components></object>', "truncated"),
        ('<object id="1"><mesh><vertices/><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object>', "truncated"),
        ('<object id="1"/>', "no_mesh"),
        ('<object id="1">', "truncated"),
        ('<object id="1"><mesh><vertices><vertex x="a" y="0" z="0"/></vertices></mesh></object>', "truncated"),
        (
            "".join(
                f'<object id="{n}"><components>{f"<component objectid={chr(34)}{n + 1}{chr(34)}/>" * 9}</components></object>'
                for n in range(1, 30)
            )
            + f'<object id="30">{MESH}</object>',
            "too_large",
        ),
    ],
    ids=["itself", "absent", "no corner", "nothing", "cut", "no number", "nine of nine"],
)  # fmt: skip
def test_what_is_wrong_with_a_package_is_named(resources: str, code: str, tmp_path: Path) -> None:
    with pytest.raises(IntakeError) as told:
        as_glb.written(printed(tmp_path / "a.3mf", resources, '<item objectid="1"/>'), tmp_path / "out")
    assert told.value.code == code and told.value.next_move


def test_a_package_that_is_none_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.3mf").write_bytes(b"no archive")
    with pytest.raises(IntakeError) as told:
        as_glb.written(tmp_path / "a.3mf", tmp_path / "out")
    assert told.value.code == "truncated"

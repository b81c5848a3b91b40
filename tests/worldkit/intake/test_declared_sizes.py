"""A file's claims are looked at before it is read: too much, cut off, or no mesh at all is told with cause, place and next move."""

import json
import struct
import zlib
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldkit.errors import IntakeError
from worldkit.intake import declared_sizes

TEN_MILLION = 10_000_000
TRIANGLE = struct.pack("<12fH", *range(12), 0)
PLY = b"ply\nformat %s 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n"


def glb(scene: dict, data: bytes = b"", length: int | None = None) -> bytes:
    text = json.dumps({"asset": {"version": "2.0"}, **scene}).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<II", len(text), 0x4E4F534A) + text
    if data:
        body += struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<4sII", b"glTF", 2, length or 12 + len(body)) + body


def triangles(count: int, view: int | None = None, **more: object) -> dict:
    row: dict = {"count": count, "componentType": 5125, "type": "SCALAR"} | (
        {} if view is None else {"bufferView": view}
    )
    return {
        "accessors": [row], "meshes": [{"primitives": [{"indices": 0, "attributes": {"POSITION": 0}}]}],
        "nodes": [{"mesh": 0}], **more,
    }  # fmt: skip


def png(width: int, height: int) -> bytes:
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + b"IHDR" + head + struct.pack(">I", zlib.crc32(b"IHDR" + head))


BAD = {
    "empty.stl": (b"", "truncated"),
    "ten million.stl": (b"\0" * 80 + struct.pack("<I", TEN_MILLION) + TRIANGLE, "too_many_faces"),
    "cut.stl": (b"\0" * 80 + struct.pack("<I", 3) + 2 * TRIANGLE, "truncated"),
    "cut text.stl": (b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "truncated"),
    "ten million.ply": (PLY % (b"binary_little_endian", 9, TEN_MILLION), "too_many_faces"),
    "cut.ply": (PLY % (b"binary_little_endian", 100, 100) + b"\0" * 50, "truncated"),
    "cut text.ply": (PLY % (b"ascii", 100, 100) + b"0 0 0\n", "truncated"),
    "no end.ply": (b"ply\nformat ascii 1.0\nelement face 3\n", "truncated"),
    "points.ply": (PLY % (b"ascii", 1, 0) + b"0 0 0\n", "no_mesh"),
    "ten million.off": (b"OFF\n12 10000000 0\n", "too_many_faces"),
    "cut.off": (b"OFF\n1000 2000 0\n0 0 0\n", "truncated"),
    "cut.obj": (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 2 3 4\n", "truncated"),
    "no number.obj": (b"v 0 0 0\nf 1 2 x\n", "truncated"),
    "lines.obj": (b"v 0 0 0\nl 1 2\n", "no_mesh"),
    "ten million.glb": (glb(triangles(3 * TEN_MILLION)), "too_many_faces"),
    "many copies.glb": (glb(triangles(300_000) | {"nodes": [{"mesh": 0}] * 30}), "too_many_faces"),
    "cut.glb": (glb(triangles(3), length=4000), "truncated"),
    "beyond.glb": (glb(triangles(30, 0, bufferViews=[{"byteLength": 120}]), b"\0" * 12), "truncated"),
    "no view.glb": (glb(triangles(30, 5, bufferViews=[]), b"\0" * 12), "truncated"),
    "packed.glb": (glb(triangles(3) | {"extensionsRequired": ["KHR_draco_mesh_compression"]}), "unknown_format"),
    "no json.glb": (struct.pack("<4sIIII", b"glTF", 2, 24, 4, 0x4E4F534A) + b"{{{{", "no_mesh"),
    "text.glb": (b"hello, this is no mesh at all", "no_mesh"),
    "model.blend": (b"BLENDER", "unknown_format"),
    "30,000 pixels.glb": (
        glb(
            triangles(3) | {"images": [{"bufferView": 0}], "bufferViews": [{"byteLength": 33}]},
            png(30_000, 30_000) + b"\0\0\0",
        ),
        "picture_too_large",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_a_file_that_claims_too_much_or_is_not_whole_is_refused(name: str, tmp_path: Path) -> None:
    content, code = BAD[name]
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(IntakeError) as told:
        declared_sizes.check(path)
    assert told.value.code == code
    assert told.value.cause and told.value.place.startswith(name[:6]) and told.value.next_move


def test_a_picture_beside_an_obj_is_looked_at_and_none_outside_its_folder(tmp_path: Path) -> None:
    folder = tmp_path / "here"
    folder.mkdir()
    obj = folder / "a.obj"
    obj.write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (folder / "a.mtl").write_text("newmtl m\nmap_Kd big.png\n")
    (folder / "big.png").write_bytes(png(30_000, 4))
    with pytest.raises(IntakeError, match="30,000 x 4 pixels") as told:
        declared_sizes.check(obj)
    assert (told.value.code, told.value.place) == ("picture_too_large", "big.png")
    (folder / "a.mtl").write_text("newmtl m\nmap_Kd ../big.png\n")
    (tmp_path / "big.png").write_bytes(png(30_000, 4))
    assert declared_sizes.check(obj) == 1


@settings(max_examples=40)
@given(st.integers(0, 1999), st.integers(0, 3))
def test_counts_are_what_the_file_has(count: int, format_: int) -> None:
    import tempfile

    texts = {
        "a.stl": b"\0" * 80 + struct.pack("<I", count) + count * TRIANGLE,
        "a.ply": PLY % (b"binary_little_endian", 3, count) + b"\0" * 36 + count * (b"\3" + b"\0" * 12),
        "a.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\n" + count * b"f 1 2 3\n",
        "a.off": b"OFF\n3 %d 0\n" % count + 3 * b"0 0 0\n" + count * b"3 0 1 2\n",
    }
    name = sorted(texts)[format_]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / name
        path.write_bytes(texts[name])
        if count or name in ("a.stl", "a.off"):
            assert declared_sizes.check(path) == count
        else:
            with pytest.raises(IntakeError, match="no face"):
                declared_sizes.check(path)


@settings(max_examples=40)
@given(st.binary(max_size=400), st.sampled_from(declared_sizes.SUFFIXES), st.sampled_from(sorted(BAD)))
def test_whatever_the_bytes_are_the_answer_is_a_count_or_an_intake_error(noise: bytes, suffix: str, name: str) -> None:
    import tempfile

    whole = BAD[name][0]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"a{suffix}"
        path.write_bytes(whole[: len(noise)] + noise)
        try:
            assert 0 <= declared_sizes.check(path) <= declared_sizes.MOST_FACES
        except IntakeError as told:
            assert told.code and told.next_move

"""The drawn world with its motion, as other programs read it: what glTF and USD hold is what was recorded."""

import io
import json
import re
import struct
from pathlib import Path

import mujoco
import numpy as np
import pytest
import trimesh

from small_worlds import ball, empty, floor, record
from worldengine.film import carried_scene, usd_text
from worldkit.turning import matrices
from worldwright import report

SHADERS = Path(report.__file__).parent / "templates" / "replay.js"


@pytest.fixture(scope="module")
def carried(tmp_path_factory):
    spec = empty()
    floor(spec)
    ball(spec, "first", (0, 0, 0.6), rgba=(0.8, 0.1, 0.1, 1))
    ball(spec, "second", (0.5, 0, 0.4), rgba=(0.1, 0.1, 0.8, 0.3))
    spec.worldbody.add_body(name="post", pos=(2, 1, 0)).add_geom(
        type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 0.2, 0.5), pos=(0, 0, 0.5), euler=(0, 0, 0.5)
    )
    recording = record(spec, tmp_path_factory.mktemp("carried") / "trajectory", 400)
    model = spec.compile()
    names = [model.body(k).name for k in range(model.nbody)]
    return model, recording, names, carried_scene.parts(model), *carried_scene.motion(recording, model)


def told(data: bytes) -> tuple[dict, bytes]:
    assert data[:4] == b"glTF" and struct.unpack_from("<I", data, 8)[0] == len(data)
    long = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20 : 20 + long]), data[28 + long :]


def read(facts: dict, blob: bytes, number: int) -> np.ndarray:
    accessor = facts["accessors"][number]
    view = facts["bufferViews"][accessor["bufferView"]]
    size = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
    kind = "<u4" if accessor["componentType"] == carried_scene.UINT else "<f4"
    return np.frombuffer(blob, kind, accessor["count"] * size, view["byteOffset"]).reshape(-1, size)


def test_another_program_reads_the_bodies_where_they_stand_and_as_large_as_they_are(carried):
    _, recording, names, parts, times, places, turns = carried
    data = carried_scene.glb(names, parts, times, places, turns, recording.sha256)
    scene = trimesh.load(io.BytesIO(data), file_type="glb")
    found = {name: scene.graph.get(name)[0] for name in scene.graph.nodes_geometry}
    post = next(matrix for name, matrix in found.items() if name.startswith("post"))
    assert post[:3, 3] == pytest.approx([2, 0, -1], abs=1e-6), "y is up in glTF"
    size = np.sort(scene.geometry[next(n for n in scene.geometry if n.startswith("second"))].extents)
    assert size == pytest.approx([0.2, 0.2, 0.2], rel=0.01)
    facts, _ = told(data)
    assert facts["asset"]["extras"] == {"recording_sha256": recording.sha256}
    clear = [material for material in facts["materials"] if material.get("alphaMode") == "BLEND"]
    assert len(clear) == 1 and clear[0]["pbrMetallicRoughness"]["baseColorFactor"][3] == pytest.approx(0.3)


def test_what_moved_is_animated_as_it_was_recorded_and_nothing_else(carried):
    _, recording, names, parts, times, places, turns = carried
    facts, blob = told(carried_scene.glb(names, parts, times, places, turns, recording.sha256))
    (animation,) = facts["animations"]
    moved = {facts["nodes"][channel["target"]["node"]]["name"] for channel in animation["channels"]}
    assert moved == {"first", "second"}
    for channel in animation["channels"]:
        if channel["target"]["path"] != "translation":
            continue
        sampler = animation["samplers"][channel["sampler"]]
        name = facts["nodes"][channel["target"]["node"]]["name"]
        at, to = read(facts, blob, sampler["input"])[:, 0], read(facts, blob, sampler["output"])
        rows = np.abs(np.asarray(recording.time)[:, None] - recording.time[0] - at).argmin(axis=0)
        assert to == pytest.approx(recording.pos[rows, list(recording.names).index(name)], abs=1e-5)
        assert at[0] == 0.0 and at[-1] >= recording.time[-1] - recording.time[0] - 1.1 / carried_scene.RATE_HZ


def test_usd_says_the_same(carried):
    _, _, names, parts, times, places, turns = carried
    text = usd_text.written(names, parts, times, places, turns)
    assert text.startswith("#usda 1.0") and 'upAxis = "Z"' in text and text.count("{") == text.count("}")
    assert len(re.findall(r"def Mesh ", text)) == len(parts)
    body = names.index("first")
    block = text[text.index(usd_text.named("first", body)) :]
    samples = re.findall(r"([\d.e-]+): \(([^)]*)\)", block[: block.index("orient")])
    assert len(samples) == len(times)
    last = np.array([float(v) for v in samples[-1][1].split(",")])
    assert last == pytest.approx(places[-1, body], abs=1e-4)
    first = text[text.index("point3f[] points = [") + 20 :]
    assert np.isfinite([float(v) for v in re.findall(r"-?[\d.]+(?:e-?\d+)?", first[: first.index("]")])]).all()
    assert usd_text.named("a b/ü", 3) == "_3_a_b__"


def test_shapes_lie_in_their_bodys_frame(carried):
    model, _, names, parts, _, _, _ = carried
    (post,) = [part for part in parts if names[part.body] == "post"]
    turn = matrices(np.asarray(model.geom_quat[model.ngeom - 1])[None])[0]
    half = np.abs(turn) @ [0.1, 0.2, 0.5]
    assert np.abs(post.points - [0, 0, 0.5]).max(axis=0) == pytest.approx(half, abs=0.01)
    assert np.linalg.norm(post.normals, axis=1) == pytest.approx(1.0, abs=1e-5)


@pytest.mark.gl
def test_the_reports_shaders_compile():
    from OpenGL import GL

    context = mujoco.GLContext(16, 16)
    context.make_current()
    try:
        texts = re.findall(r"`((?:in|uniform)[^`]*)`", SHADERS.read_text())
        texts += re.findall(r'"((?:in|out) [^"]*main\(\)[^"]*)"', SHADERS.read_text())
        assert len(texts) == 4
        for text in texts:
            shader = GL.glCreateShader(GL.GL_VERTEX_SHADER if "gl_Position" in text else GL.GL_FRAGMENT_SHADER)
            GL.glShaderSource(shader, "#version 300 es\nprecision highp float;\n" + text)
            GL.glCompileShader(shader)
            assert GL.glGetShaderiv(shader, GL.GL_COMPILE_STATUS), GL.glGetShaderInfoLog(shader)
    finally:
        context.free()

"""The drawn world with its recorded motion as plain data that other programs read: `scene.glb` (glTF 2.0) or `scene.usda`.

Lengths are metres; the world's z axis is up in USD, and turned to glTF's y by the root node.
"""

import argparse
import json
import struct
import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from worldkit.files import write_atomic, write_json

from . import usd_text

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..given import Given
    from ..recording.stored import Recording

NAME = "scene"
RATE_HZ = 30.0
MOST_TRIANGLES = 400_000
GROUND_M = 40.0
"""An endless ground is carried out as a square of this side."""
FLOAT, UINT = 5126, 5125
UPRIGHT = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]
"""The turn (x, y, z, w) that makes z-up y-up."""


@dataclass(frozen=True)
class Part:
    """Shapes of one body and one look, in the body's frame."""

    body: int
    look: str
    rgba: tuple[float, float, float, float]
    """Linear."""
    roughness: float
    metallic: float
    points: "np.ndarray"
    normals: "np.ndarray"
    faces: "np.ndarray"


def run(given: "Given", options: argparse.Namespace) -> None:
    """Write the recording `options.recording` into `options.out` in `options.format`.

    Raises:
        WorldkitError: the recording is of another world, or cannot be read.
    """
    from ..recording import stored

    recording, model = stored.open(options.recording), given.model()
    found = parts(model)
    times, places, turns = motion(recording, model)
    names = [model.body(body).name or f"body{body}" for body in range(model.nbody)]
    if options.format == "usd":
        path = options.out / f"{NAME}.usda"
        write_atomic(path, usd_text.written(names, found, times, places, turns).encode())
    else:
        path = options.out / f"{NAME}.glb"
        write_atomic(path, glb(names, found, times, places, turns, recording.sha256))
    triangles = sum(len(part.faces) for part in found)
    write_json(options.out / "result.json", {"ok": True, "pass": NAME, "file": path.name, "triangles": triangles})
    sys.stdout.write(f"{path}: {triangles} triangles, {len(times)} moments\n")


def parts(model: "mujoco.MjModel") -> list[Part]:
    """Everything of a model that is drawn and rigid, grouped by body and look; skins as rigid pieces (`carried_skins`)."""
    import mujoco
    import numpy as np

    from . import carried_skins
    from .renderers.preview.things import Things
    from .renderers.traced import figures, rounded
    from .renderers.traced.rounded import Mesh

    rest = mujoco.MjData(model)
    mujoco.mj_kinematics(model, rest)
    things = Things(model)
    things.update(rest)
    groups: dict[Any, list[Mesh]] = {}
    looks: dict[Any, tuple[str, tuple[float, float, float, float], float, float]] = {}
    for batch in things.batches:
        for row in batch.rows:
            numbers, geom = things.rows[row], int(things.geoms[row])
            if batch.shape[0] == "disc":
                mesh = rounded.sheet(GROUND_M / 2, GROUND_M / 2)
            else:
                mesh = figures.shape_of(model, batch, numbers, geom)
            entry = batch.finish.look
            mean = np.asarray(batch.finish.mean if batch.finish.texture >= 0 or entry.paint else (1.0, 1.0, 1.0))
            alpha = min(float(numbers[19]), 0.35 if entry.clear > 0 else 1.0)
            rgba = (*(float(v) for v in np.round(np.clip(numbers[16:19] * mean, 0, 1), 4)), round(alpha, 3))
            body = int(model.geom_bodyid[geom])
            key = (body, rgba, round(entry.roughness, 3), round(entry.metallic, 3))
            looks[key] = (entry.description or "look", rgba, *key[2:])  # type: ignore[assignment]
            turn = rest.geom_xmat[geom].reshape(3, 3)
            whole = rest.xmat[body].reshape(3, 3)
            points = (mesh.points @ turn.T + rest.geom_xpos[geom] - rest.xpos[body]) @ whole
            groups.setdefault(key, []).append(mesh._replace(points=points, normals=mesh.normals @ turn.T @ whole))
    for body, finish, points, normals, faces in carried_skins.pieces(model):
        entry = finish.look
        tint = (*(float(v) for v in np.round(finish.mean, 4)), round(float(entry.rgba[3]), 3))
        key = (body, tint, round(entry.roughness, 3), round(entry.metallic, 3))
        looks[key] = (entry.description or "look", tint, *key[2:])  # type: ignore[assignment]
        groups.setdefault(key, []).append(Mesh(points, normals, faces, None))
    found, budget = [], MOST_TRIANGLES
    for key, meshes in sorted(groups.items(), key=lambda item: sum(len(mesh.faces) for mesh in item[1])):
        starts = np.cumsum([0, *(len(mesh.points) for mesh in meshes)])
        faces = np.concatenate([mesh.faces + start for mesh, start in zip(meshes, starts, strict=False)])
        budget -= len(faces)
        if budget < 0:  # the heaviest are left out before anything else
            break
        points = np.concatenate([mesh.points for mesh in meshes])
        normals = np.concatenate([mesh.normals for mesh in meshes])
        found.append(Part(key[0], *looks[key], points, normals, faces))
    return found


def motion(recording: "Recording", model: "mujoco.MjModel") -> "tuple[np.ndarray, np.ndarray, np.ndarray]":
    """Times (T,), s, from 0; places (T, B, 3), m, and turns (T, B, 4), w first, of all bodies, at most 30 a second."""
    import numpy as np

    from ..recording.replay import Replay

    time = np.asarray(recording.time) - recording.time[0]
    wanted = np.arange(int(time[-1] * RATE_HZ) + 1) / RATE_HZ
    rows = np.unique(np.clip(np.searchsorted(time, wanted), 0, len(time) - 1))
    replay = Replay(model, recording)
    places, turns = np.zeros((len(rows), model.nbody, 3)), np.zeros((len(rows), model.nbody, 4))
    for k, row in enumerate(rows):
        data = replay.show(int(row))
        places[k], turns[k] = data.xpos, data.xquat
    for k in range(1, len(rows)):  # a quaternion and its negative are one turn; between them nothing spins round
        turns[k] *= np.where((turns[k] * turns[k - 1]).sum(-1) < 0, -1.0, 1.0)[:, None]
    return time[rows], places, turns


def glb(
    names: list[str], found: list[Part], times: "np.ndarray", places: "np.ndarray", turns: "np.ndarray", recording: str
) -> bytes:
    """The scene as one binary glTF file, which tells the SHA-256 of the recording."""
    import numpy as np

    blob, views, accessors = bytearray(), [], []

    def put(array: "np.ndarray", kind: str, component: int, bounds: bool = False) -> int:
        data = np.ascontiguousarray(array, dtype="<f4" if component == FLOAT else "<u4")
        views.append({"buffer": 0, "byteOffset": len(blob), "byteLength": data.nbytes})
        blob.extend(data.tobytes())
        rows = data.reshape(len(data), -1)
        told = {"bufferView": len(views) - 1, "componentType": component, "count": len(data), "type": kind}
        if kind == "SCALAR" and component == UINT:
            told["count"] = data.size
        if bounds:
            told |= {"min": rows.min(0).tolist(), "max": rows.max(0).tolist()}
        accessors.append(told)
        return len(accessors) - 1

    materials: list[dict[str, Any]] = []
    meshes: list[dict[str, Any]] = []
    of_body: dict[int, int] = {}
    for part in found:
        clear = part.rgba[3] < 1
        materials.append(
            {"name": part.look[:60], "pbrMetallicRoughness": {
                "baseColorFactor": list(part.rgba), "roughnessFactor": part.roughness, "metallicFactor": part.metallic},
             **({"alphaMode": "BLEND"} if clear else {}), "doubleSided": clear}
        )  # fmt: skip
        attributes = {"POSITION": put(part.points, "VEC3", FLOAT, True), "NORMAL": put(part.normals, "VEC3", FLOAT)}
        indices = put(part.faces.reshape(-1, 1), "SCALAR", UINT)
        primitive = {"attributes": attributes, "indices": indices, "material": len(materials) - 1}
        if part.body not in of_body:
            of_body[part.body] = len(meshes)
            meshes.append({"name": names[part.body], "primitives": []})
        meshes[of_body[part.body]]["primitives"].append(primitive)
    nodes: list[dict[str, Any]] = [{"name": "world, z up", "rotation": UPRIGHT, "children": []}]
    channels, samplers = [], []
    clock = put(times, "SCALAR", FLOAT, True)
    accessors[clock] |= {"min": [float(np.float32(times.min()))], "max": [float(np.float32(times.max()))]}
    for body, mesh in sorted(of_body.items()):
        node = {"name": names[body], "mesh": mesh, "translation": places[0, body].tolist()}
        node["rotation"] = turns[0, body, [1, 2, 3, 0]].tolist()
        nodes.append(node)
        nodes[0]["children"].append(len(nodes) - 1)
        if np.ptp(places[:, body], axis=0).max() + np.ptp(turns[:, body], axis=0).max() < 1e-6:
            continue
        for path, kind, values in (
            ("translation", "VEC3", places[:, body]), ("rotation", "VEC4", turns[:, body][:, [1, 2, 3, 0]]),
        ):  # fmt: skip
            samplers.append({"input": clock, "output": put(values, kind, FLOAT), "interpolation": "LINEAR"})
            target = {"node": len(nodes) - 1, "path": path}
            channels.append({"sampler": len(samplers) - 1, "target": target})
    told: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "Worldwright", "extras": {"recording_sha256": recording}}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": nodes,
        "meshes": meshes, "materials": materials, "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": len(blob)}],
    }  # fmt: skip
    if channels:
        told["animations"] = [{"name": "recording", "channels": channels, "samplers": samplers}]
    text = json.dumps(told, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    blob += b"\0" * (-len(blob) % 4)
    whole = 12 + 8 + len(text) + 8 + len(blob)
    head = struct.pack("<4sII", b"glTF", 2, whole) + struct.pack("<I4s", len(text), b"JSON")
    return head + text + struct.pack("<I4s", len(blob), b"BIN\0") + bytes(blob)

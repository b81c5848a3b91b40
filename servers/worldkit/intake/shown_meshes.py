"""What is drawn of a thing, as files: OBJ meshes of a bounded number of triangles, PNG pictures, and their materials."""

from typing import Any

import numpy as np

from .drawn_pieces import Array, Drawn
from .touchable import thinned

TRIANGLES = 60_000
"""That are drawn of a thing."""
NEAR = 6
"""Old faces that are looked at for the picture's place at a new corner."""
CREASE_DEG = 40.0
"""Faces that meet at a sharper angle show an edge."""


def files(pieces: list[Drawn]) -> tuple[dict[str, bytes], list[dict[str, str]], dict[str, dict[str, Any]], list[str]]:
    """The files of a thing's look by name, its rows of `visual`, its `materials`, and what is worth saying."""
    import cv2

    total = sum(len(piece.faces) for piece in pieces)
    said = [f"{total:,} triangles drawn as about {TRIANGLES:,}"] if total > TRIANGLES else []
    made: dict[str, bytes] = {}
    visual: list[dict[str, str]] = []
    materials: dict[str, dict[str, Any]] = {}
    known: dict[bytes, str] = {}
    for number, piece in enumerate(pieces):
        mesh = f"look_{number:02d}.obj"
        made[mesh] = _obj(_fewer(piece, total)).encode()
        values: dict[str, Any] = {"rgba": [round(value, 4) for value in piece.rgba]}
        values |= {"roughness": round(piece.roughness, 3), "metallic": round(piece.metallic, 3)}
        if piece.picture is not None:
            ok, data = cv2.imencode(".png", piece.picture[..., ::-1], [cv2.IMWRITE_PNG_COMPRESSION, 9])
            name = known.setdefault(data.tobytes(), f"picture_{len(known):02d}.png") if ok else None
            if name:
                made[name], values["texture"] = data.tobytes(), name
        material = next((one for one, other in materials.items() if other == values), f"material_{len(materials):02d}")
        materials[material] = values
        visual.append({"mesh": mesh, "material": material})
    return made, visual, materials, said


def _fewer(piece: Drawn, total: int) -> Drawn:
    """A piece with its share of `TRIANGLES`; each new corner's place on the picture is that of the old face it lies nearest to."""
    most = max(200, round(TRIANGLES * len(piece.faces) / total))
    if total <= TRIANGLES or len(piece.faces) <= most:
        return piece
    keys = np.round(piece.vertices / max(float(np.ptp(piece.vertices, axis=0).max()), 1e-12) / 1e-6).astype(np.int64)
    _, first, where = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    points, faces = thinned(piece.vertices[first], where.ravel()[piece.faces], most)
    if piece.uv is None:
        return Drawn(points, faces, None, None, piece.rgba, piece.roughness, piece.metallic)
    from scipy.spatial import cKDTree

    corners, island = points[faces], _islands(piece)
    tree = cKDTree(piece.vertices[piece.faces].mean(axis=1))
    centre = tree.query(corners.mean(axis=1))[1]
    uv = np.empty((len(faces), 3, 2))
    for k in range(3):  # of the old faces near a corner, the first of the island in which the new face's middle lies
        near = tree.query(corners[:, k], k=min(NEAR, len(piece.faces)))[1].reshape(len(faces), -1)
        same = island[near] == island[centre][:, None]
        chosen = np.where(same.any(axis=1), near[np.arange(len(near)), same.argmax(axis=1)], centre)
        uv[:, k] = _carried(piece, chosen, corners[:, k])
    index = np.arange(3 * len(faces)).reshape(-1, 3)
    return Drawn(
        corners.reshape(-1, 3), index, uv.reshape(-1, 2), piece.picture, piece.rgba, piece.roughness, piece.metallic
    )


def _islands(piece: Drawn) -> Array:
    """The number, (F,), of the island of its picture in which each face lies: faces that share corners."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    a, b = piece.faces[:, [0, 1]].ravel(), piece.faces[:, [1, 2]].ravel()
    size = len(piece.vertices)
    label = connected_components(coo_array((np.ones(len(a), bool), (a, b)), shape=(size, size)), directed=False)[1]
    return np.asarray(label[piece.faces[:, 0]])


def _carried(piece: Drawn, near: Array, points: Array) -> Array:
    """uv (N, 2) of points, from the planes of faces of a piece."""
    assert piece.uv is not None
    a, b, c = (piece.vertices[piece.faces[near, k]] for k in range(3))
    p, q, r = (piece.uv[piece.faces[near, k]] for k in range(3))
    u, v, w = b - a, c - a, points - a
    uu, uv, vv = (np.einsum("ni,ni->n", x, y) for x, y in ((u, u), (u, v), (v, v)))
    wu, wv = (np.einsum("ni,ni->n", w, y) for y in (u, v))
    area = np.maximum(uu * vv - uv**2, 1e-300)
    s, t = (np.clip(one / area, -3.0, 4.0)[:, None] for one in (vv * wu - uv * wv, uu * wv - uv * wu))
    return p + s * (q - p) + t * (r - p)


def _obj(piece: Drawn) -> str:
    """OBJ text with normals that keep creases sharp."""
    rows = [f"v {x:.7g} {y:.7g} {z:.7g}" for x, y, z in piece.vertices]
    normals, where = _normals(piece)
    rows += [f"vn {x:.4f} {y:.4f} {z:.4f}" for x, y, z in normals]
    if piece.uv is None:
        rows += [
            "f " + " ".join(f"{v + 1}//{n + 1}" for v, n in zip(f, g, strict=True))
            for f, g in zip(piece.faces, where, strict=True)
        ]
    else:
        rows += [f"vt {u:.6g} {v:.6g}" for u, v in piece.uv]
        rows += [
            "f " + " ".join(f"{v + 1}/{v + 1}/{n + 1}" for v, n in zip(f, g, strict=True))
            for f, g in zip(piece.faces, where, strict=True)
        ]
    return "\n".join(rows) + "\n"


def _normals(piece: Drawn) -> tuple[Array, Array]:
    """Unit normals (N, 3), and for each corner of a face the number of its own (F, 3).

    At a place where faces meet, each takes the mean of those that lean from it by less than the crease, by area.
    """
    keys = np.round(piece.vertices / max(float(np.ptp(piece.vertices, axis=0).max()), 1e-12) / 1e-6).astype(np.int64)
    _, where = np.unique(keys, axis=0, return_inverse=True)
    a, b, c = (piece.vertices[piece.faces[:, k]] for k in range(3))
    area = np.cross(b - a, c - a)
    flat = area / np.maximum(np.linalg.norm(area, axis=1, keepdims=True), 1e-300)
    place = where.ravel()[piece.faces].ravel()
    face = np.repeat(np.arange(len(piece.faces)), 3)
    smooth = np.zeros((int(place.max()) + 1, 3))
    np.add.at(smooth, place, area[face])
    smooth /= np.maximum(np.linalg.norm(smooth, axis=1, keepdims=True), 1e-300)
    own = smooth[place]
    sharp = np.einsum("ni,ni->n", own, flat[face]) < np.cos(np.radians(CREASE_DEG))
    own[sharp] = flat[face[sharp]]
    normals, number = np.unique(np.round(own, 4), axis=0, return_inverse=True)
    return normals, number.ravel().reshape(-1, 3)

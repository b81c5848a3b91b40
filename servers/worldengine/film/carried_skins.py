"""A skin over several bodies as rigid pieces, one for each body: what other programs get of it.

Where it bends, pieces overlap: a triangle goes with each body that holds at least `SHARED` of it, so that no gap opens.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..recording.seen import visible_skins
from .renderers.preview.finish import Finish, of_material, plain
from .renderers.preview.soft_shapes import bodies_of, held_by, triangles_of

if TYPE_CHECKING:
    import mujoco
    import numpy as np

SHARED = 0.2
Piece = tuple[int, Finish, "np.ndarray", "np.ndarray", "np.ndarray"]
"""Body, finish, points (V, 3) and normals (V, 3) in the body's frame, faces (F, 3)."""


def pieces(model: "mujoco.MjModel") -> Iterator[Piece]:
    """All pieces of the skins of a model that are drawn."""
    import numpy as np

    from worldkit.turning import matrices

    for skin in map(int, np.flatnonzero(visible_skins(model))):
        material = int(model.skin_matid[skin])
        finish = of_material(model, material) if material >= 0 else plain(model.skin_rgba[skin])
        first, bone = int(model.skin_vertadr[skin]), int(model.skin_boneadr[skin])
        points = np.asarray(model.skin_vert[first : first + int(model.skin_vertnum[skin])], dtype=float)
        faces = triangles_of(model, skin)
        normals = _normals(points, faces)
        share = held_by(model, skin)[faces].mean(axis=1)
        for column, body in enumerate(bodies_of(model, skin)):
            mine = faces[(share[:, column] >= SHARED) | (share.argmax(axis=1) == column)]
            if not len(mine):
                continue
            used, index = np.unique(mine, return_inverse=True)
            turn = matrices(model.skin_bonebindquat[bone + column].astype(float)[None])[0]
            place = model.skin_bonebindpos[bone + column]
            yield int(body), finish, (points[used] - place) @ turn, normals[used] @ turn, index.reshape(-1, 3)


def _normals(points: "np.ndarray", faces: "np.ndarray") -> "np.ndarray":
    """(V, 3) of corners, the same where corners lie in one place."""
    import numpy as np

    place = np.unique(points, axis=0, return_inverse=True)[1].reshape(-1)
    a, b, c = (points[faces[:, k]] for k in range(3))
    found = np.zeros_like(points)
    for k in range(3):
        np.add.at(found, place[faces[:, k]], np.cross(b - a, c - a))
    return np.asarray((found / np.maximum(np.linalg.norm(found, axis=1, keepdims=True), 1e-12))[place])

"""An atlas: every triangle of a skin gets its place in one square picture, and every texel the point that it shows.

The skin is cut into charts that look along one of six axes each and lie flat without covering themselves, so that paint by
position has no visible seams, and neighbours in the picture are neighbours on the skin.
"""

from dataclasses import dataclass

import numpy as np

from .marching import Skin
from .signed import Array

GUTTER = 3
"""Texels between charts."""
SPREAD = 3
"""Texels around a chart that are painted, too; the rest of the picture takes the colour of the nearest one."""
ROUNDS = 5
"""How often charts that cover themselves are cut further."""


@dataclass(frozen=True)
class Atlas:
    """A skin laid out flat."""

    source: Array
    """(U,) the skin's vertex of each of its corners, which are cut along charts."""
    uv: Array
    """(U, 2) place of each corner in the picture: 0 to 1, along and down its rows."""
    faces: Array
    """(F, 3) corners of the triangles."""
    texels: Array
    """(T, 2) rows and columns of the picture that show the skin."""
    points: Array
    """(T, 3) m, what they show."""
    normals: Array
    """(T, 3) of the skin there."""
    pixels: int

    def picture(self, rgb: Array) -> Array:
        """The picture, uint8 (pixels, pixels, 3), of colours (T, 3), 0 to 1, of its texels."""
        import cv2

        free = np.ones((self.pixels, self.pixels), np.uint8)
        free[self.texels[:, 0], self.texels[:, 1]] = 0
        _, nearest = cv2.distanceTransformWithLabels(free, cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)
        colours = np.zeros((int(nearest.max()) + 1, 3), np.uint8)
        colours[nearest[self.texels[:, 0], self.texels[:, 1]]] = np.round(np.clip(rgb, 0.0, 1.0) * 255)
        return np.asarray(colours[nearest])


def unwrapped(skin: Skin, pixels: int) -> Atlas:
    """Lay a skin out in a picture of `pixels` x `pixels`."""
    corners = skin.vertices[skin.faces]
    label = _labels(skin, corners)
    for attempt in range(ROUNDS):
        chart = _charts(skin.faces, label)
        flat, scale = _packed(corners, label % 6, chart, pixels)
        owner = _drawn(flat, pixels)
        covered = _covered(flat, owner, corners, 4.0 / scale)
        if not covered.any() or attempt == ROUNDS - 1:
            break
        label = np.where(covered, label + 6, label)
    texels, face = _spread(owner)
    points, normals = _shown(skin, flat, texels, face)
    key = skin.faces.astype(np.int64) * (chart.max() + 1) + chart[:, None]
    _, first, corner = np.unique(key, return_index=True, return_inverse=True)
    return Atlas(
        skin.faces.ravel()[first], flat.reshape(-1, 2)[first] / pixels, corner.reshape(-1, 3), texels, points, normals, pixels
    )  # fmt: skip


def _labels(skin: Skin, corners: Array) -> Array:
    """(F,) the axis that each face looks along: 0 to 5 for +x, +y, +z, -x, -y, -z."""
    crossed = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    own = crossed / np.maximum(np.linalg.norm(crossed, axis=1, keepdims=True), 1e-300)
    smooth = skin.normals[skin.faces].mean(axis=1)
    axis = np.abs(smooth).argmax(axis=1)
    label = axis + 3 * (smooth[np.arange(len(axis)), axis] < 0)
    sign = np.where(label < 3, 1.0, -1.0)
    turned_away = own[np.arange(len(axis)), axis] * sign < 0.2
    axis = np.abs(own).argmax(axis=1)
    return np.where(turned_away, axis + 3 * (own[np.arange(len(axis)), axis] < 0), label)


def _charts(faces: Array, label: Array) -> Array:
    """(F,) number of the chart of each face: connected faces of one label."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    owner = np.repeat(np.arange(len(faces)), 3)
    order = np.lexsort(edges.T)
    edges, owner = edges[order], owner[order]
    same = (edges[1:] == edges[:-1]).all(axis=1) & (label[owner[1:]] == label[owner[:-1]])
    a, b = owner[:-1][same], owner[1:][same]
    graph = coo_array((np.ones(len(a), dtype=bool), (a, b)), shape=(len(faces), len(faces)))
    return np.asarray(connected_components(graph, directed=False)[1])


def _packed(corners: Array, axis: Array, chart: Array, pixels: int) -> tuple[Array, float]:
    """(F, 3, 2) texels of the corners, the charts packed on shelves; and texels a metre."""
    k = axis % 3
    i, j = (k + 1) % 3, (k + 2) % 3
    rows = np.arange(len(corners))[:, None], np.arange(3)[None, :]
    flat = np.stack([corners[(*rows, i[:, None])], corners[(*rows, j[:, None])]], axis=-1)
    flat[axis >= 3, :, 0] *= -1  # seen from outside, nothing is drawn as in a mirror
    count = int(chart.max()) + 1
    low, high = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    np.minimum.at(low, chart, flat.min(axis=1))
    np.maximum.at(high, chart, flat.max(axis=1))
    size = high - low
    upright = size[:, 1] > size[:, 0]
    size = np.where(upright[:, None], size[:, ::-1], size)
    order = np.argsort(-size[:, 1], kind="stable")
    scale = 0.95 * pixels / max(float(np.sqrt((size[:, 0] * size[:, 1]).sum())), float(size.max()), 1e-12)
    while (at := _shelves(size[order] * scale, pixels)) is None:
        scale *= 0.93
        if scale * size.max() < 1e-3:
            raise ValueError("the shape has more separate bits than a picture can hold: fewer cells, or less noise")
    place = np.zeros_like(low)
    place[order] = at
    moved = flat - low[chart][:, None]
    moved = np.where(upright[chart][:, None, None], moved[..., ::-1], moved)
    return moved * scale + place[chart][:, None], scale


def _shelves(sizes: Array, pixels: int) -> Array | None:
    """(C, 2) corners of rectangles sorted by height, packed row after row; None if they do not fit."""
    found, x, y, tall = np.zeros((len(sizes), 2)), GUTTER, GUTTER, 0.0
    for n, (width, height) in enumerate(sizes):
        if x + width + GUTTER > pixels:
            x, y, tall = GUTTER, y + int(np.ceil(tall)) + GUTTER, 0.0
        if x + width + GUTTER > pixels or y + height + GUTTER > pixels:
            return None
        found[n] = x, y
        x += int(np.ceil(width)) + GUTTER
        tall = max(tall, height)
    return found


def _drawn(flat: Array, pixels: int) -> Array:
    """(pixels, pixels) number of the face that each texel shows, -1 where none is."""
    import cv2

    owner = np.full((pixels, pixels), -1, dtype=np.int32)
    # cv2 counts from the middle of a pixel, in 1/16 here.
    fixed = np.round((flat - 0.5) * 16).astype(np.int32)
    for number, corners in enumerate(fixed):
        cv2.fillConvexPoly(owner, corners, number, lineType=cv2.LINE_8, shift=4)
    return owner


def _covered(flat: Array, owner: Array, corners: Array, far: float) -> Array:
    """(F,) whether another face, which is not near it in space (m), is drawn in the middle of each face."""
    middle = flat.mean(axis=1).astype(int)
    there = owner[middle[:, 1], middle[:, 0]]
    centre = corners.mean(axis=1)
    reach = far + 2 * np.linalg.norm(corners - centre[:, None], axis=2).max(axis=1)
    apart = np.linalg.norm(centre - centre[there], axis=1)
    return (there >= 0) & (apart > reach + reach[there])


def _spread(owner: Array) -> tuple[Array, Array]:
    """Texels (T, 2) on charts and some around them, and the face (T,) that each one shows, or is nearest to."""
    import cv2

    away, nearest = cv2.distanceTransformWithLabels(
        (owner < 0).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    face_of = np.zeros(int(nearest.max()) + 1, dtype=np.int64)
    drawn = owner >= 0
    face_of[nearest[drawn]] = owner[drawn]
    texels = np.argwhere(away <= SPREAD)
    return texels, face_of[nearest[texels[:, 0], texels[:, 1]]]


def _shown(skin: Skin, flat: Array, texels: Array, face: Array) -> tuple[Array, Array]:
    """Points and normals (T, 3) that texels show, in their faces' planes, a little beyond an edge where they lie so."""
    a, b, c = (flat[:, k] for k in range(3))
    ab, ac = b - a, c - a
    twice = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
    twice = np.where(np.abs(twice) < 1e-9, 1e-9, twice)[face]
    w = texels[:, ::-1] + 0.5 - a[face]
    v = np.clip((w[:, 0] * ac[face, 1] - w[:, 1] * ac[face, 0]) / twice, -2.0, 3.0)
    u = np.clip((ab[face, 0] * w[:, 1] - ab[face, 1] * w[:, 0]) / twice, -2.0, 3.0)
    share = np.stack([1 - v - u, v, u], axis=1)
    corner = skin.faces[face]
    points = np.einsum("tk,tki->ti", share, skin.vertices[corner])
    normals = np.einsum("tk,tki->ti", np.clip(share, 0, 1), skin.normals[corner])
    return points, normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)

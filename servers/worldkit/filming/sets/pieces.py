"""Parts that sets are made of: meshes as one piece, patterns as pictures."""

from collections.abc import Iterable

import numpy as np

from ... import forms
from ..drawn_only import Surface
from ..trees import Mesh


def placed(mesh: Mesh, at: tuple[float, float, float], yaw_deg: float = 0.0, scale: float = 1.0) -> Mesh:
    """A mesh turned about z, scaled, and moved."""
    c, s = np.cos(np.radians(yaw_deg)), np.sin(np.radians(yaw_deg))
    return scale * mesh[0] @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + np.array(at), mesh[1]


def block(x: float, y: float, z: float, at: tuple[float, float, float] = (0, 0, 0), radius: float = 0.0) -> Mesh:
    """A box with rounded edges, full extents and the middle of its underside `at`, m."""
    form = forms.rounded_box(size=(x, y, z), radius=radius or min(0.012, 0.2 * min(x, y, z)))
    return form.vertices + np.array([at[0], at[1], at[2] + z / 2]), form.faces


def boxes(rows: Iterable[tuple[float, float, float, tuple[float, float, float]]]) -> Mesh:
    """Plain boxes as one mesh: of each its full extents and the middle of its underside, m. Each has edges of its own, which are sharp."""
    told = np.array([(x, y, z, *at) for x, y, z, at in rows], dtype=float).reshape(-1, 1, 6)
    signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    sides = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
    corners = 0.5 * signs[sides.ravel()] * told[..., :3] + told[..., 3:] + told[..., 2:3] * np.array([0, 0, 0.5])
    quads = 4 * np.arange(6 * len(told))[:, None]
    return corners.reshape(-1, 3), np.concatenate([quads + np.array(one) for one in ((0, 1, 2), (0, 2, 3))])


def turned(profile: list[tuple[float, float]], at: tuple[float, float, float] = (0, 0, 0), smooth: int = 3) -> Mesh:
    """A thing of revolution by (radius, height), m, from the ground up; its foot stands `at`."""
    form = forms.lathe(profile=profile, smooth=smooth)
    return form.vertices - np.array([0, 0, form.vertices[:, 2].min()]) + np.array(at), form.faces


def rock(size: float, random: np.random.Generator, flat: float = 0.7) -> Mesh:
    """A stone about `size` m across: a ball with facets knocked off and a rough skin, its middle at the origin."""
    vertices, faces = ball(3)
    for _ in range(14):  # planes that cut it, as breaks do
        normal = random.normal(size=3)
        normal /= np.linalg.norm(normal)
        over = vertices @ normal - random.uniform(0.62, 0.9)
        vertices = vertices - np.maximum(over, 0.0)[:, None] * normal
    for waves in (3.0, 7.0, 15.0):
        turn, shift = random.normal(size=(3, 3)), random.uniform(0, 7, 3)
        vertices = vertices * (1 + 0.10 / waves * np.sin(waves * vertices @ turn + shift).sum(axis=1, keepdims=True))
    return 0.5 * size * vertices * np.array([1.0, random.uniform(0.7, 1.0), flat * random.uniform(0.8, 1.1)]), faces


def ball(times: int) -> Mesh:
    """A round ball of radius 1 of 20 * 4^times triangles."""
    g = (1 + 5**0.5) / 2
    points = [(0, s, t * g) for s in (-1, 1) for t in (-1, 1)]
    vertices = np.array([np.roll(p, k) for k in range(3) for p in points], float)
    vertices /= np.linalg.norm(vertices, axis=1, keepdims=True)
    apart = np.linalg.norm(vertices[:, None] - vertices[None], axis=-1)
    side = apart[apart > 0.1].min() * 1.01
    near = apart < side
    faces = [
        (a, b, c) if np.dot(np.cross(vertices[b] - vertices[a], vertices[c] - vertices[a]), vertices[a]) > 0 else (a, c, b)
        for a in range(12) for b in range(a + 1, 12) for c in range(b + 1, 12)
        if near[a, b] and near[b, c] and near[a, c]
    ]  # fmt: skip
    triangles = np.array(faces)
    for _ in range(times):
        edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
        unique, back = np.unique(edges, axis=0, return_inverse=True)
        middles = vertices[unique].sum(axis=1)
        middles /= np.linalg.norm(middles, axis=1, keepdims=True)
        ab, bc, ca = back.reshape(3, -1) + len(vertices)
        a, b, c = triangles.T
        vertices = np.concatenate([vertices, middles])
        triangles = np.concatenate([np.stack(t, 1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return vertices, triangles


def noise(x: np.ndarray, y: np.ndarray, random: np.random.Generator, octaves: int = 5) -> np.ndarray:
    """Gentle hills between about -1 and 1 over arrays x and y of one shape, 1 across."""
    total, weight = np.zeros(np.shape(x)), 0.0
    for octave in range(octaves):
        for _ in range(4):
            angle, shift = random.uniform(0, 2 * np.pi), random.uniform(0, 2 * np.pi)
            wave = 2 * np.pi * 1.9**octave * random.uniform(0.7, 1.3)
            total += 0.55**octave * np.sin(wave * (x * np.cos(angle) + y * np.sin(angle)) + shift)
        weight += 0.55**octave
    return total / (2 * weight)


def wooded(colour: str, random: np.random.Generator) -> Surface:
    """A hillside from afar as a picture, its foot below: fields with hedges between them, and above them woods of many crowns."""
    from ..drawn_only import rgb

    high, wide = 128, 1024
    up, along = np.meshgrid(np.linspace(1, 0, high), np.linspace(0, 1, wide), indexing="ij")
    broad, crown = noise(7 * along, 2.5 * up, random, 4), noise(90 * along, 14 * up, random, 2)
    crowns = 1.0 + 0.35 * crown + 0.18 * random.normal(size=up.shape)
    dark = np.array(rgb(colour)) * 0.62
    woods = dark * crowns[..., None]
    strips = (np.floor(11 * along + 1.3 * broad + 2 * up) * 0.618) % 1.0
    field = np.array(rgb(colour)) * 0.55 + np.array([0.62, 0.6, 0.36]) * 0.45
    fields = field * (0.82 + 0.36 * strips)[..., None] * (1.0 + 0.04 * random.normal(size=up.shape))[..., None]
    share = np.clip(2.2 * (up - 0.42) + 1.1 * broad + 0.5 * crown, 0.0, 1.0)[..., None]
    hedge = (np.abs((11 * along + 1.3 * broad + 2 * up) % 1.0 - 0.5) > 0.47)[..., None]
    picture = np.where(hedge & (share < 0.5), woods, share * woods + (1 - share) * fields)
    return Surface(picture=(255 * np.clip(picture, 0, 1)).astype(np.uint8), roughness=0.95)

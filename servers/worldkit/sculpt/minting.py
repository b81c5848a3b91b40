"""A shape made: what is drawn, its picture, what collides, and what it weighs like. Made once, and kept by its content."""

import random
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, fields, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import kept_shapes
from ..forms.bulk import Form
from .marching import CELLS, TRIANGLES, Skin, decimated, surface
from .signatures import signature
from .signed import Array, Shape

if TYPE_CHECKING:
    from .brushes import Paint
    from .crisp import Solid

TEXELS = 512
LEVELS = 0.1
"""Painted roughness is drawn in steps of this."""
_memory: dict[str, "Made"] = {}


@dataclass(frozen=True)
class Made:
    """A solid in the coordinates it was made in."""

    vertices: Array
    """(V, 3) m, of what is drawn."""
    normals: Array
    """(V, 3)."""
    uv: Array
    """(V, 2) places in the picture, 0 to 1, along and down its rows; (0, 2) without paint."""
    faces: Array
    """(F, 3)."""
    picture: Array
    """uint8 (P, P, 3) sRGB; (0, 0, 3) without paint."""
    roughness: Array
    """(F,) of each face, in steps; (0,) without paint, or where the paint tells none."""
    hulls: tuple[Array, ...]
    """Corners (N, 3), m, of the convex pieces that collide."""
    volume: float
    """m^3, of the watertight surface at full resolution."""
    centre_of_mass: Array
    """(3,) m."""
    inertia: Array
    """(3, 3) about it, m^2: times the mass."""
    bits: int
    """Pieces that do not hang together: more than one is seldom meant."""
    signature: str

    @property
    def low(self) -> Array:
        """(3,) lowest corner of the box around it, m."""
        return self.vertices.min(axis=0)

    @property
    def high(self) -> Array:
        """(3,) highest corner of the box around it, m."""
        return self.vertices.max(axis=0)


def made(
    shape: "Shape | Solid",
    *,
    cells: int = CELLS,
    triangles: int = TRIANGLES,
    paint: "Paint | None" = None,
    texels: int = TEXELS,
    hulls: str | int | Sequence[Shape] = "auto",
) -> Made:
    """Make a shape, or take it from what is kept of an earlier call with the same shape, paint and settings.

    A paint is made anew at each call where nobody can tell what it is made of or what depends on it: it holds an iterator or a
    generator of random numbers, it changes something, or it reads a file or imports a module of yours when it is called. Do
    that at the top of your file, and give the paint what came of it.

    Args:
        shape: distance function, or exact solid (for which `cells` has no meaning).
        cells: along its longest side.
        triangles: that are drawn, at most.
        paint: see `worldkit.sculpt.brushes`.
        texels: along a side of its picture.
        hulls: see `worldkit.sculpt.hulls`.

    Raises:
        ValueError: the shape has no surface, the paint gives other than colours, or a setting is out of bounds.
    """
    if not 64 <= texels <= 4096:
        raise ValueError(f"texels: give 64 to 4096, not {texels}")
    if not 100 <= triangles <= 400_000:
        raise ValueError(f"triangles: give 100 to 400000, not {triangles}")
    of = (code(), shape, cells, triangles, paint, texels, hulls)
    key = signature(*of)
    if not key:
        return _named(_made("", *of[1:]))
    if key in _memory:
        return _memory[key]
    found = _kept(key)
    if found is None:
        with _draws_of_its_own(key):
            found = _made(key, *of[1:])
        if signature(*of) != key:
            return _named(found)
        _keep(found)
    _memory[key] = found
    return found


@contextmanager
def _draws_of_its_own(key: str) -> Iterator[None]:
    """Within the block, global random draws depend on what is made alone; behind it they go on as if it had not been made.

    Otherwise whether a shape is kept of an earlier run would decide what is drawn after it.
    """
    held = np.random.get_state(), random.getstate()  # noqa: NPY002 - programs may draw from it all the same
    np.random.seed(int(key[:8], 16))  # noqa: NPY002
    random.seed(key)
    try:
        yield
    finally:
        np.random.set_state(held[0])  # noqa: NPY002
        random.setstate(held[1])


def _made(key: str, shape: Any, cells: int, triangles: int, paint: Any, texels: int, hulls: Any) -> Made:
    from .hulls import hulls as pieces

    if isinstance(shape, Shape):
        skin = surface(shape, cells)
        drawn = decimated(shape, skin, triangles, float(shape.size.max()) / cells)
    else:
        drawn, skin = shape.drawn(), shape.skin()
    bulk = Form(skin.vertices, skin.faces, (), np.zeros(3))
    collide = pieces(shape if isinstance(shape, Shape) else None, skin, bulk.volume, hulls)
    if isinstance(hulls, str | int):
        collide = _boxed_alike(collide, drawn.vertices)
    vertices, normals, faces = drawn.vertices, drawn.normals, drawn.faces
    uv, picture, roughness = np.zeros((0, 2)), np.zeros((0, 0, 3), np.uint8), np.zeros(0)
    if paint is not None:
        vertices, normals, faces, uv, picture, roughness = _painted(drawn, paint, texels)
    return Made(
        vertices, normals, uv, faces, picture, roughness, collide, bulk.volume, bulk.centre_of_mass, bulk.inertia,
        _bits(skin), key,
    )  # fmt: skip


def _boxed_alike(hulls: tuple[Array, ...], drawn: Array) -> tuple[Array, ...]:
    """Hulls that reach exactly as far along x, y and z as what is drawn: one box holds both."""
    low, high = drawn.min(axis=0), drawn.max(axis=0)
    found = [np.clip(corners, low, high) for corners in hulls]
    for point in drawn[np.concatenate([drawn.argmin(axis=0), drawn.argmax(axis=0)])]:
        nearest = int(np.argmin([np.linalg.norm(corners - point, axis=1).min() for corners in found]))
        found[nearest] = np.concatenate([found[nearest], point[None]])
    return tuple(found)


def _painted(drawn: Skin, paint: "Paint", texels: int) -> tuple[Array, Array, Array, Array, Array, Array]:
    from .atlas import unwrapped

    flat = unwrapped(drawn, texels)
    told = paint(flat.points, flat.normals)
    rgb, rough = told if isinstance(told, tuple) else (told, None)
    rgb = np.asarray(rgb, dtype=float)
    if rgb.shape != flat.points.shape or not np.isfinite(rgb).all():
        raise ValueError(
            f"the paint gives {rgb.shape} for {len(flat.points)} points: it is to return sRGB (N, 3), 0 to 1, "
            "or that and a roughness"
        )
    levels = np.zeros(0)
    if rough is not None:
        middles = drawn.vertices[drawn.faces].mean(axis=1)
        again = paint(middles, drawn.normals[drawn.faces].mean(axis=1))[1]
        levels = np.clip(np.round(np.broadcast_to(again, (len(middles),)) / LEVELS) * LEVELS, 0.02, 1.0)
    return drawn.vertices[flat.source], drawn.normals[flat.source], flat.faces, flat.uv, flat.picture(rgb), levels


def _bits(skin: Skin) -> int:
    """Closed surfaces that face outwards: separate pieces, without the insides of hollow ones."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    a, b = skin.faces[:, [0, 1]].ravel(), skin.faces[:, [1, 2]].ravel()
    size = len(skin.vertices)
    _, owner = connected_components(coo_array((np.ones(len(a), dtype=bool), (a, b)), shape=(size, size)), False)
    p, q, r = (skin.vertices[skin.faces[:, k]] for k in range(3))
    volumes = np.bincount(owner[skin.faces[:, 0]], np.einsum("fi,fi->f", p, np.cross(q, r)))
    return int((volumes > 1e-6 * np.abs(volumes).max()).sum())


@cache
def code() -> str:
    """Of the text of this package, and the versions of what it makes shapes with."""
    from importlib import metadata

    texts = [path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py"))]
    libraries = ("numpy", "scikit-image", "fast-simplification", "manifold3d", "scipy")
    return signature(texts, [metadata.version(name) for name in libraries])


def _kept(key: str) -> Made | None:
    held = kept_shapes.kept(key)
    try:
        if held is None or str(held.pop("signature")) != key:
            return None
        hulls = tuple(held.pop(f"hull{n}") for n in range(int(held.pop("count"))))
        volume, bits = float(held.pop("volume")), int(held.pop("bits"))
        return Made(hulls=hulls, volume=volume, bits=bits, signature=key, **held)
    except (KeyError, TypeError, ValueError):  # of another layout
        return None


def _named(found: Made) -> Made:
    """Signed by what it came out as, so that all builds call it alike."""
    return replace(found, signature=signature(*_arrays(found).values()))


def _arrays(found: Made) -> dict[str, Array]:
    arrays = {f.name: np.asarray(getattr(found, f.name)) for f in fields(found) if f.name != "hulls"}
    return (
        arrays | {f"hull{n}": points for n, points in enumerate(found.hulls)} | {"count": np.asarray(len(found.hulls))}
    )


def _keep(found: Made) -> None:
    kept_shapes.keep(found.signature, _arrays(found))

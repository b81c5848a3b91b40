"""Whether a written file is what its recipe makes: exactly in words and integers, in numbers to their last written digit.

Sums of floats differ in their last bits from one make of processor to another, so a rounded number may fall on either side
of a half, a number that is zero in mathematics may be written as 1e-20, a coplanar face may be cut along its other diagonal,
and a pixel may be one level lighter. None of these is a change of the recipe; everything else is.
"""

from decimal import Decimal
from typing import Any

import cv2
import numpy as np
import yaml

NOTHING = 1e-12
"""Numbers below this (metres, kilograms, square metres) are rounding noise around zero."""
CORNER_M, TEXTURE, NORMAL = 1.01e-5, 1.01e-4, 2.01e-3
"""One unit of the last digit that an OBJ file writes for a vertex, a texture coordinate and a normal (two for a normal)."""
PIXELS, LEVELS = 1e-3, 8
"""Share of a picture's samples that may differ, and by how many of the 256 levels."""


def same(name: str, written: bytes, made: bytes) -> bool:
    """True when the two contents of file `name` mean the same asset."""
    if written == made:
        return True
    if name.endswith(".png"):
        return _same_picture(written, made)
    if name.endswith(".obj"):
        return _same_mesh(written.decode(), made.decode(), faces=not name.startswith("hulls/"))
    return _same_value(yaml.safe_load(written), yaml.safe_load(made))


def _same_value(a: Any, b: Any) -> bool:
    if isinstance(a, dict) and isinstance(b, dict):
        return list(a) == list(b) and all(_same_value(a[key], b[key]) for key in a)
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(map(_same_value, a, b))
    if isinstance(a, float) or isinstance(b, float):
        return isinstance(a, float | int) and isinstance(b, float | int) and _same_number(float(a), float(b))
    return type(a) is type(b) and bool(a == b)


def _same_number(a: float, b: float) -> bool:
    """True when the numbers differ by at most one unit of the last digit that the longer of them writes."""
    if max(abs(a), abs(b)) < NOTHING:
        return True
    unit = 10.0 ** min(int(Decimal(repr(x)).as_tuple().exponent) for x in (a, b))
    return abs(a - b) < 1.01 * unit


def _same_mesh(a: str, b: str, *, faces: bool) -> bool:
    """True when each corner of each face is drawn the same; of a hull, whose faces follow from them, when its vertices are."""
    first, second = _mesh(a), _mesh(b)
    if any(first[kind].shape != second[kind].shape for kind in ("v", "vt", "f")):
        return False
    if not faces:
        return _close(first["v"], second["v"], CORNER_M)
    if not np.array_equal(first["f"][..., :2], second["f"][..., :2]):
        return False
    normals = (mesh["vn"][mesh["f"][..., 2] - 1] for mesh in (first, second))
    return (
        _close(first["v"], second["v"], CORNER_M)
        and _close(first["vt"], second["vt"], TEXTURE)
        and _close(*normals, NORMAL)
    )


def _close(a: np.ndarray, b: np.ndarray, tolerance: float) -> bool:
    return a.shape == b.shape and bool(np.all(np.abs(a - b) < tolerance))


def _mesh(text: str) -> dict[str, np.ndarray]:
    """Rows of an OBJ file by kind; `f` has shape (faces, 3) in a hull, else (faces, 3, 3): vertex, texture, normal."""
    rows: dict[str, list[Any]] = {"v": [], "vt": [], "vn": [], "f": []}
    for line in text.splitlines():
        kind, *words = line.split()
        rows[kind].append(
            [[int(n) for n in word.split("/")] for word in words] if kind == "f" else [float(w) for w in words]
        )
    return {kind: np.array(values) for kind, values in rows.items()}


def _same_picture(a: bytes, b: bytes) -> bool:
    first, second = (cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED) for data in (a, b))
    if first is None or second is None or first.shape != second.shape:
        return False
    apart = np.abs(first.astype(int) - second.astype(int))
    return bool(apart.max() <= LEVELS and np.mean(apart > 0) <= PIXELS)

"""What one asset is made of: the value every `catalog/make/<key>.py` returns from `make()`."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .hulls import Hull, Primitive
from .surface import Surface


@dataclass(frozen=True)
class Part:
    """A visible piece: its surface, the material it wears, and how much it weighs relative to the others.

    `density` (kg/m^3, typical of its substance) only sets how the asset's mass is spread over its parts; zero for parts that
    are only drawn. `cavity` is a closed surface taken out of it.
    """

    name: str
    surface: Surface
    material: str
    density: float
    crease_deg: float = 40.0
    cavity: Surface | None = None


@dataclass(frozen=True)
class Support:
    """A place where things can rest: at height `z`, over a rectangle or ellipse of extents (x, y) around `centre`."""

    name: str
    z: float
    extents: tuple[float, float]
    centre: tuple[float, float] = (0.0, 0.0)
    shape: str = "rectangle"
    default: bool = False


@dataclass(frozen=True)
class Recipe:
    """An asset in its build frame (metres, z up, +X front, any origin)."""

    key: str
    category: str
    description: str
    metric_height: float
    metric_height_source: str
    mass: float
    mass_source: str
    contact: dict[str, float]
    contact_source: str
    parts: list[Part]
    materials: dict[str, dict[str, Any]]
    collision: list[Primitive | Hull]
    textures: dict[str, np.ndarray] = field(default_factory=dict)
    texture_levels: dict[str, int] = field(default_factory=dict)
    supports: list[Support] = field(default_factory=list)
    looks: dict[str, dict[str, dict[str, Any]]] = field(default_factory=dict)
    default_look: str | None = None
    recolour: tuple[str, ...] = ()
    """Materials that a look from `worldkit.materials` replaces."""

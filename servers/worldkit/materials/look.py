"""What a look is: everything a renderer must know about a surface besides its shape."""

from dataclasses import dataclass

WHITE = (1.0, 1.0, 1.0, 1.0)
NOTHING = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Look:
    """One entry of the library.

    `paint` names a painter of `worldkit.materials.paint` (``family.function`` and its arguments), or is None for a plain
    colour. Colours are sRGB in 0..1; the remaining numbers follow the metallic/roughness convention.
    """

    description: str
    rgba: tuple[float, float, float, float] = WHITE
    """sRGB tint; multiplies the painted texture."""
    paint: str | None = None
    """Painter, as ``family.function``."""
    arguments: tuple[object, ...] = ()
    """Positional arguments of the painter, after the texture size."""
    tile_m: float = 1.0
    """Metres that one repeat of the texture covers (flat painters)."""
    around: bool = False
    """The painter paints directions around the centre (balls, fruit) instead of a flat tile."""
    grain: bool = False
    """The texture's horizontal axis follows the longest side of the object."""
    vary: float = 0.0
    """Large-scale brightness variation that hides the tiling of wide surfaces, 0..1."""
    apart: float = 0.0
    """How much brighter or darker the brightest and darkest pieces are than most: no two boards are of one tree, 0..1."""
    roughness: float = 0.5
    metallic: float = 0.0
    coat: float = 0.0
    """Clear varnish over the base, 0..1."""
    sheen: float = 0.0
    """Soft glow of fibres at grazing angles, 0..1."""
    worn_m: float = 0.0
    """How far from the edges of boxes and cylinders it is rubbed and chipped, m; only what is painted flat wears."""
    beneath: tuple[float, float, float] | None = None
    """sRGB of what shows where it has worn off; None: itself, paler."""
    relief_m: float = 0.0
    """Height of the painted relief, metres from lowest to highest."""
    clear: float = 0.0
    """Share of light that passes and is refracted, 0..1."""
    index: float = 1.5
    """Of refraction, of what is clear."""
    absorbs: tuple[float, float, float] = NOTHING
    """What light loses of itself in it, of red, green and blue, 1/m: of what is clear, in place of its tint where that can
    be told by the way that light goes in it."""
    wall: bool = False
    """A closed skin of it that a law moves is a thin wall with air inside: a bottle of glass. A liquid fills its skin."""
    thin: float = 0.0
    """A leaf: the share of the light on its other side that comes through it, 0..1."""
    mark: bool = False
    """A sphere of this look carries a thin band and two dots, so that its spin can be seen."""
    emission: float = 0.0
    """Light the surface gives off, relative to its colour."""

"""What a film draws and nobody simulated: surfaces, and meshes made of many small things."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..errors import ProgramError
from .film_bounds import FAR_M, SEEN

Vec3 = tuple[float, float, float]
SHAPES = ("box", "sphere", "cylinder", "capsule", "ellipsoid", "mesh")
MOST_PIXELS = 4096


@dataclass(frozen=True)
class Surface:
    """A look of the film's own, where none of `worldkit.materials` fits.

    `picture`, uint8 (H, W, 3), repeats every `tile_m` metres, row 0 the top, or lies on a mesh by its own `uv`: row 0 at v = 0 and
    the last row at v = 1, so that for a picture to stand upright v runs downwards.
    """

    colour: str = "#ffffff"
    roughness: float = 0.6
    metallic: float = 0.0
    glow: float = 0.0
    """Light it gives off, relative to its colour."""
    opacity: float = 1.0
    picture: np.ndarray | None = field(default=None, compare=False, repr=False)
    tile_m: float = 1.0

    def __post_init__(self) -> None:
        rgb(self.colour)
        for name in ("roughness", "metallic", "opacity"):
            if not 0.0 <= getattr(self, name) <= 1.0:
                raise ProgramError(f"{name} lies between 0 and 1, got {getattr(self, name)}", "Surface", "")
        if not 0.0 <= self.glow <= 50.0 or not 0.0 < self.tile_m < np.inf:
            raise ProgramError(
                f"a surface glows with 0 to 50 and has a tile above 0 m, not {self.glow} and {self.tile_m}",
                "Surface",
                "",
            )
        if self.picture is not None:
            shape = np.shape(self.picture)
            if (
                len(shape) != 3
                or shape[2] != 3
                or max(shape[:2]) > MOST_PIXELS
                or np.asarray(self.picture).dtype != np.uint8
            ):
                raise ProgramError(
                    f"a picture is uint8 of (height, width, 3), at most {MOST_PIXELS} a side; got {shape}",
                    "Surface",
                    "",
                )


def rgb(colour: str) -> tuple[float, float, float]:
    """`#rrggbb` as three numbers from 0 to 1 (sRGB); a `ProgramError` for anything else."""
    text = colour.removeprefix("#") if isinstance(colour, str) else ""
    try:
        if len(text) != 6:
            raise ValueError(colour)
        red, green, blue = (int(text[i : i + 2], 16) / 255.0 for i in (0, 2, 4))
    except ValueError:
        raise ProgramError(f"a colour is written as '#rrggbb', not {colour!r}", "film.py", "e.g. '#ffb46a'") from None
    return (red, green, blue)


@dataclass(frozen=True)
class Thing:
    """One thing that is drawn only."""

    name: str
    shape: str
    size: Vec3
    """Full extents, m; of a mesh, the factors that it is scaled by."""
    look: str | Surface
    pos: Vec3
    quat: tuple[float, float, float, float]
    to: str = ""
    """The body it is fixed to, whose frame `pos` and `quat` are in; the world's when empty."""
    instead: bool = False
    """A skin: the body's own shapes are left out."""
    vertices: np.ndarray | None = None
    faces: np.ndarray | None = None
    uv: np.ndarray | None = None
    sways: np.ndarray | None = None
    """(V, 2): how far a fresh breeze carries each corner of a mesh, m, and its phase, radians."""
    ways: np.ndarray | None = None
    """(F, P, 3), m: where P copies are in each frame of the film."""
    sizes: np.ndarray | None = None
    """(F, P): the diameter of each copy in each frame, m; 0 is not drawn."""
    turns: np.ndarray | None = None
    """(F, P, 4): how each copy of a mesh is turned in each frame."""
    of: str = ""
    """What it is a piece of, where several make one: that is what is listed."""
    grows: bool = False
    """Blades of grass: each is lit as the sward that it belongs to, not as a plate."""

    def __post_init__(self) -> None:
        for what, count in (("size", 3), ("pos", 3), ("quat", 4)):
            numbers = np.asarray(getattr(self, what), dtype=float)
            if numbers.shape != (count,) or not (np.abs(numbers) <= FAR_M).all():
                raise ProgramError(
                    f"the {what} of {self.name!r} must be {count} numbers up to {FAR_M:g}, is {numbers.tolist()}",
                    "film.py",
                    "check how it is reckoned",
                )
        if self.vertices is not None and not (np.abs(self.vertices) <= FAR_M).all():
            raise ProgramError(f"a corner of {self.name!r} is nowhere", "film.py", "check how it is reckoned")
        if not min(self.size) > 0 or abs(float(np.linalg.norm(self.quat)) - 1) > 1e-3:
            raise ProgramError(f"{self.name!r} has no size, or its quaternion is none", "film.py", "check its numbers")

    def facts(self, arrays: dict[str, np.ndarray], number: int, breeze: bool) -> dict[str, Any]:
        """This thing as JSON; its arrays go into `arrays`. In a `breeze` it says how it sways."""
        found: dict[str, Any] = {
            "name": self.name, "shape": self.shape, "size": list(map(float, self.size)), "pos": list(map(float, self.pos)),
            "quat": list(map(float, self.quat)), "to": self.to, "instead": self.instead,
            "look": look_facts(self.look, arrays, f"picture{number}"),
        }  # fmt: skip
        found |= {"grows": True} if self.grows else {}
        found |= {"of": self.of} if self.of else {}
        for name, kind in (
            ("vertices", "f4"),
            ("faces", "i4"),
            ("uv", "f4"),
            ("ways", "f4"),
            ("sizes", "f4"),
            ("turns", "f4"),
        ):
            value = getattr(self, name)
            if name == "uv" and breeze and self.sways is not None:
                value, found["sways"] = self.sways, True
            if value is not None:
                arrays[f"{name}{number}"] = np.asarray(value, dtype=kind)
                found[name] = f"{name}{number}"
        return found


def matt(look: str | Surface) -> str | Surface:
    """A look of what grows: a plain colour is that of a leaf, not of satin plastic."""
    return Surface(colour=look, roughness=0.95) if isinstance(look, str) and look.startswith("#") else look


def known(look: str | Surface) -> None:
    """Raise a `ProgramError` that names the nearest where there is no such look."""
    from .. import materials

    if isinstance(look, str):
        try:
            materials.look(look)
        except ValueError as unknown:
            raise ProgramError(
                str(unknown).split(" Use one of")[0], "film.py", "name a look, '#rrggbb', or a Surface"
            ) from None
    elif not isinstance(look, Surface):
        raise ProgramError(f"{look!r} is no look", "film.py", "name a look, '#rrggbb', or a Surface")


def opaque(look: str | Surface, name: str, movers: tuple[str, ...]) -> str | Surface:
    """The look of a body; a `ProgramError` where that would make a mover nearly clear, which shows what did not happen."""
    if name in movers and isinstance(look, Surface) and look.opacity < SEEN:
        raise ProgramError(
            f"{name!r} moves, and an opacity of {look.opacity:g} makes it unseen",
            "film.py",
            f"give it at least {SEEN:g}, or a look of glass",
        )
    return look


def look_facts(look: str | Surface, arrays: dict[str, np.ndarray], key: str) -> Any:
    """A look as JSON: its name, or its numbers."""
    if isinstance(look, str):
        return look
    found: dict[str, Any] = {
        "rgb": list(rgb(look.colour)), "roughness": look.roughness, "metallic": look.metallic, "glow": look.glow,
        "opacity": look.opacity, "tile_m": look.tile_m,
    }  # fmt: skip
    if look.picture is not None:
        arrays[key] = np.asarray(look.picture, dtype=np.uint8)
        found["picture"] = key
    return found

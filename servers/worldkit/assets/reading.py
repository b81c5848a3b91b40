"""Reading `asset.yaml` strictly: unknown or missing keys, wrong numbers and missing files are errors with a place."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from .. import quick_yaml
from .entry import Asset, Piece, Support

REQUIRED = ("category", "description", "source", "licence", "native_extents", "metric_height", "friction", "visual")
OPTIONAL = [
    "key",
    "metric_height_source",
    "mass",
    "mass_source",
    "density",
    "solid_volume",
    "inertia",
    "restitution",
    "torsional",
    "rolling",
    "contact_source",
    "facing",
    "materials",
    "recolour",
    "looks",
    "default_look",
    "collision",
    "supports",
    "thumbnail",
    "creator",
    "mended",
    "assumed",
    "measured",
]
CONTACT = ("friction", "restitution", "torsional", "rolling")
MATERIAL = ("look", "texture", "rgba", "specular", "shininess", "reflectance", "metallic", "roughness", "emission")
SHAPES = {
    "hull": ("file",),
    "sphere": ("diameter",),
    "box": ("extents",),
    "cylinder": ("diameter", "height"),
    "capsule": ("diameter", "height"),
}


class AssetError(ValueError):
    """An `asset.yaml` that does not describe an asset: names the file, the key and what is wanted."""


def read_asset(folder: Path) -> Asset:
    """The entry in `folder/asset.yaml`.

    Raises:
        AssetError: the file is missing, not YAML, or not an asset; the message names file, key and remedy.
    """
    import yaml

    path = folder / "asset.yaml"
    try:
        data = quick_yaml.read(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise AssetError(f"{path}: cannot be read ({error.strerror})") from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise AssetError(f"{path}: not YAML: {error}") from error
    row = _Row(path, "", data)
    row.only(REQUIRED, OPTIONAL)
    if row.get("key", folder.name) != folder.name:
        row.fail("key", f"must be the folder's name, {folder.name!r}, got {data['key']!r}")
    if ("mass" in data) == ("density" in data):
        row.fail("mass", "give either mass (kg) or density (kg/m^3), not both and not neither")
    native = row.numbers("native_extents", 3, positive=True)
    volume = row.number("solid_volume", math.prod(native), positive=True)
    inertia = row.sub("inertia", {"com": [0, 0, 0], "per_kg": [*_box_inertia(native), 0, 0, 0]})
    inertia.only(("com", "per_kg"))
    materials = {name: _material(row, folder, f"materials.{name}") for name in row.mapping("materials")}
    looks = {
        look: {name: _material(row, folder, f"looks.{look}.{name}") for name in row.mapping(f"looks.{look}")}
        for look in row.mapping("looks")
    }
    for where, used in [("recolour", row.get("recolour", [])), *((f"looks.{k}", v) for k, v in looks.items())]:
        if unknown := [name for name in used if name not in materials]:
            row.fail(where, f"names no material of this asset: {', '.join(unknown)}; materials: {', '.join(materials)}")
    if row.get("default_look") not in (None, *looks):
        row.fail("default_look", f"must be one of {', '.join(looks) or 'no looks'}, got {data['default_look']!r}")
    return Asset(
        key=folder.name,
        folder=folder,
        category=row.text("category"),
        description=row.text("description"),
        source=row.text("source"),
        licence=row.text("licence"),
        native_extents=native,
        metric_height=row.number("metric_height", positive=True),
        metric_height_source=row.text("metric_height_source", ""),
        mass=row.number("mass", positive=True) if "mass" in data else None,
        density=row.number("density", positive=True) if "density" in data else None,
        mass_source=row.text("mass_source", ""),
        solid_volume=volume,
        inertia_com=inertia.numbers("com", 3),
        inertia_per_kg=inertia.numbers("per_kg", 6),
        contact=_contact(row),
        contact_source=row.text("contact_source", ""),
        facing=row.text("facing", "+x"),
        visual=tuple(_visual(item, folder, materials) for item in row.items("visual")),
        materials=materials,
        looks=looks,
        default_look=row.get("default_look"),
        recolour=tuple(row.get("recolour", ())),
        collision=tuple(_piece(item, folder, n) for n, item in enumerate(row.items("collision"))),
        supports=tuple(_support(item, native) for item in row.items("supports")),
        thumbnail=folder / row.text("thumbnail", "thumbnail.png"),
        creator=row.text("creator", ""),
        mended=(*row.lines("mended"), *row.lines("assumed")),
    )


class _Row:
    """One mapping of the file, with its dotted place for error messages."""

    def __init__(self, path: Path, place: str, data: Any) -> None:
        self.path, self.place, self.data = path, place, data
        if not isinstance(data, Mapping):
            self.fail("", f"must be a mapping, got {type(data).__name__}")

    def fail(self, key: str, problem: str) -> None:
        place = ".".join(part for part in (self.place, key) if part) or "the file"
        raise AssetError(f"{self.path}: {place}: {problem}")

    def only(self, required: tuple[str, ...], optional: tuple[str, ...] | list[str] = ()) -> None:
        if missing := [key for key in required if key not in self.data]:
            self.fail(missing[0], f"is missing; an entry needs {', '.join(required)}")
        if unknown := [str(key) for key in self.data if key not in (*required, *optional)]:
            self.fail(unknown[0], f"is not a known key; known: {', '.join((*required, *optional))}")

    def get(self, key: str, default: Any = None) -> Any:
        return self.data.get(key, default)

    def text(self, key: str, default: str | None = None) -> str:
        value = self.get(key, default)
        if not isinstance(value, str) or (default is None and not value.strip()):
            self.fail(key, f"must be text, got {value!r}")
        return value

    def number(self, key: str, default: float | None = None, *, positive: bool = False) -> float:
        return self._real(key, self.get(key, default), positive)

    def numbers(self, key: str, count: int, default: Any = None, *, positive: bool = False) -> Any:
        values = self.get(key, default)
        if not isinstance(values, (list, tuple)) or len(values) != count:
            self.fail(key, f"must be a list of {count} numbers, got {values!r}")
        return tuple(self._real(key, value, positive) for value in values)

    def mapping(self, dotted: str) -> Mapping[str, Any]:
        value: Any = self.data
        for key in dotted.split("."):
            value = value.get(key, {})
        if not isinstance(value, Mapping):
            self.fail(dotted, f"must be a mapping, got {value!r}")
        return value

    def sub(self, key: str, default: Mapping[str, Any]) -> "_Row":
        return _Row(self.path, key, self.get(key, default))

    def items(self, key: str) -> list["_Row"]:
        values = self.get(key, [])
        if not isinstance(values, list):
            self.fail(key, f"must be a list, got {values!r}")
        return [_Row(self.path, f"{key}[{n}]", value) for n, value in enumerate(values)]

    def lines(self, key: str) -> tuple[str, ...]:
        values = self.get(key, [])
        if not isinstance(values, list):
            self.fail(key, f"must be a list of texts, got {values!r}")
        return tuple(map(str, values))

    def file(self, key: str, folder: Path) -> Path:
        path = (folder / self.text(key)).resolve()
        if not path.is_relative_to(folder.resolve()) or not path.is_file():
            self.fail(key, f"must name a file inside {folder}, got {self.data[key]!r}")
        return path

    def _real(self, key: str, value: Any, positive: bool) -> float:
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
            self.fail(key, f"must be a finite number, got {value!r}")
        if positive and value <= 0:
            self.fail(key, f"must be positive, got {value!r}")
        return float(value)


def _contact(row: _Row) -> dict[str, float]:
    values = {key: row.number(key) for key in CONTACT if key in row.data}
    for key, value in values.items():
        if value < 0 or (key == "restitution" and value > 1):
            row.fail(key, f"must be {'between 0 and 1' if key == 'restitution' else 'at least 0'}, got {value}")
    return values


def _material(row: _Row, folder: Path, dotted: str) -> dict[str, Any]:
    item = _Row(row.path, dotted, row.mapping(dotted))
    item.only((), MATERIAL)
    values: dict[str, Any] = {}
    for key in item.data:
        if key == "texture":
            values[key] = item.file(key, folder)
        elif key == "look":
            values[key] = _look(item)
        else:
            values[key] = item.numbers(key, 4) if key == "rgba" else item.number(key)
    return values


def _look(item: _Row) -> str:
    from ..materials import look

    name = item.text("look")
    try:
        look(name)
    except ValueError as error:
        item.fail("look", str(error))
    return name


def _visual(item: _Row, folder: Path, materials: Mapping[str, Any]) -> tuple[Path, str]:
    item.only(("mesh", "material"))
    if item.data["material"] not in materials:
        item.fail("material", f"is not one of this asset's materials: {', '.join(materials)}")
    return item.file("mesh", folder), item.data["material"]


def _piece(item: _Row, folder: Path, number: int) -> Piece:
    shape = item.get("type")
    if shape not in SHAPES:
        item.fail("type", f"must be one of {', '.join(SHAPES)}, got {shape!r}")
    item.only(("type", *SHAPES[shape]), ("name", "pos", "quat", *CONTACT))
    if shape == "capsule" and item.number("height") <= item.number("diameter"):
        item.fail("height", "of a capsule counts its caps and must exceed its diameter")
    return Piece(
        type=shape,
        name=item.text("name", f"{shape}_{number:02d}"),
        file=item.file("file", folder) if "file" in item.data else None,
        pos=item.numbers("pos", 3, (0, 0, 0)),
        quat=item.numbers("quat", 4, (1, 0, 0, 0)),
        extents=item.numbers("extents", 3, positive=True) if "extents" in item.data else None,
        diameter=item.number("diameter", positive=True) if "diameter" in item.data else None,
        height=item.number("height", positive=True) if "height" in item.data else None,
        contact=_contact(item),
    )


def _support(item: _Row, native: tuple[float, float, float]) -> Support:
    item.only(("name", "z_fraction", "extents"), ("centre", "shape", "default"))
    fraction = item.number("z_fraction")
    if not 0 <= fraction <= 1:
        item.fail("z_fraction", f"must lie between 0 (lowest point) and 1 (top), got {fraction}")
    if item.get("shape", "rectangle") not in ("rectangle", "ellipse"):
        item.fail("shape", f"must be rectangle or ellipse, got {item.get('shape')!r}")
    return Support(
        name=item.text("name"),
        z=fraction * native[2],
        z_fraction=fraction,
        extents=item.numbers("extents", 2, positive=True),
        centre=item.numbers("centre", 2, (0, 0)),
        shape=item.get("shape", "rectangle"),
        default=bool(item.get("default", False)),
    )


def _box_inertia(extents: tuple[float, float, float]) -> tuple[float, float, float]:
    """Inertia of a uniform box per kilogram, the fallback of an entry without `inertia`."""
    x, y, z = (e * e / 12 for e in extents)
    return (y + z, x + z, x + y)

"""Somebody's mesh: `catalog/meshes/KEY.obj`, and beside it `KEY.yaml` with the facts that no mesh contains.

    description: A weathered granite boulder
    category: nature
    source: scanned by the maker of the world
    licence: CC0-1.0
    height: 0.4          # m, how high it stands in the real world
    density: 2650        # kg/m^3, or mass: 57 (kg at that height)
    friction: 0.7        # and restitution, torsional, rolling where they are known
    rgba: [0.5, 0.5, 0.48, 1]

Everything else is measured: extents, volume, centre of mass and inertia, for which the mesh must be closed. It collides as
its convex hull. It stands upright along +z with its front along +x, in any unit of length.
"""

from functools import lru_cache
from pathlib import Path
from typing import Any

from ... import quick_yaml
from ...data_folders import catalog_root
from ..entry import Asset, Piece
from ..reading import CONTACT, AssetError

FOLDER = "meshes"
NEEDED = ("description", "category", "source", "licence", "height", "friction")
MAY = (*(name for name in CONTACT if name != "friction"), "density", "mass", "rgba")
GREY = [0.6, 0.6, 0.6, 1.0]


def keys() -> tuple[str, ...]:
    """The meshes that have both files."""
    return tuple(sorted(path.stem for path in _folder().glob("*.obj") if path.with_suffix(".yaml").is_file()))


def find(key: str) -> Asset:
    """The mesh, measured."""
    mesh, said = _folder() / f"{key}.obj", _folder() / f"{key}.yaml"
    facts = _facts(said)
    centre, extents, volume, com, inertia = _measured(mesh, mesh.stat().st_mtime_ns)
    offset = (-centre[0], -centre[1], -centre[2])
    return Asset(
        key=key,
        folder=_folder(),
        category=str(facts["category"]),
        description=str(facts["description"]),
        source=str(facts["source"]),
        licence=str(facts["licence"]),
        native_extents=extents,
        metric_height=float(facts["height"]),
        metric_height_source=str(facts["source"]),
        mass=facts.get("mass"),
        density=facts.get("density"),
        mass_source=str(facts["source"]),
        solid_volume=volume,
        inertia_com=com,
        inertia_per_kg=inertia,
        contact={name: float(facts[name]) for name in CONTACT if name in facts},
        contact_source=str(facts["source"]),
        facing="+x",
        visual=((mesh, "surface"),),
        materials={"surface": {"rgba": [float(value) for value in facts.get("rgba", GREY)]}},
        looks={},
        default_look=None,
        recolour=("surface",),
        collision=(Piece("hull", "hull", file=mesh, pos=offset),),
        supports=(),
        thumbnail=_folder() / f"{key}.png",
        visual_pos=offset,
    )


def example(catalog: Path) -> str:
    """An octahedron of granite, half a metre from its own origin."""
    folder = catalog / FOLDER
    folder.mkdir()
    points = ((2, 0, 0), (-2, 0, 0), (0, 2, 0), (0, -2, 0), (0, 0, 1), (0, 0, -1))
    faces = ((1, 3, 5), (3, 2, 5), (2, 4, 5), (4, 1, 5), (3, 1, 6), (2, 3, 6), (4, 2, 6), (1, 4, 6))
    rows = [f"v {x} {y} {z + 0.5}" for x, y, z in points] + [f"f {a} {b} {c}" for a, b, c in faces]
    (folder / "boulder.obj").write_text("\n".join(rows) + "\n", encoding="utf-8")
    said = "description: a boulder\ncategory: nature\nsource: an example\nlicence: CC0-1.0\n"
    (folder / "boulder.yaml").write_text(said + "height: 0.4\ndensity: 2650\nfriction: 0.7\n", encoding="utf-8")
    return "boulder"


def files(key: str) -> tuple[Path, ...]:
    """The mesh and the YAML file beside it."""
    return (_folder() / f"{key}.obj", _folder() / f"{key}.yaml")


def _folder() -> Path:
    return catalog_root() / FOLDER


def _facts(path: Path) -> dict[str, Any]:
    import yaml

    try:
        facts = quick_yaml.read(path.read_text(encoding="utf-8"))
    except (OSError, yaml.YAMLError, UnicodeDecodeError) as error:
        raise AssetError(f"{path}: cannot be read as YAML: {error}") from error
    if not isinstance(facts, dict):
        raise AssetError(f"{path}: it must be a mapping with {', '.join(NEEDED)}")
    if missing := [name for name in NEEDED if name not in facts]:
        raise AssetError(f"{path}: {missing[0]} is missing; it needs {', '.join(NEEDED)}")
    if unknown := sorted(map(str, set(facts) - {*NEEDED, *MAY})):
        raise AssetError(f"{path}: {unknown[0]} is not a known key; known: {', '.join((*NEEDED, *MAY))}")
    if ("mass" in facts) == ("density" in facts):
        raise AssetError(f"{path}: give either mass (kg) or density (kg/m^3), not both and not neither")
    for name in ("height", "mass", "density", *CONTACT):
        value = facts.get(name, 1.0)
        low = 0.0 if name in CONTACT else 1e-9
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not low <= value < 1e9:
            raise AssetError(f"{path}: {name} must be a number in SI units, and not negative, got {value!r}")
    return facts


@lru_cache(maxsize=128)
def _measured(mesh: Path, _modified: int) -> tuple[Any, Any, float, Any, Any]:
    """(centre of the bounding box, extents, volume, centre of mass from that centre, inertia per kg), native units."""
    import trimesh

    try:
        found: Any = trimesh.load(mesh, force="mesh", process=True)
        closed, extents, volume = found.is_watertight, [float(value) for value in found.extents], float(found.volume)
    except Exception as error:  # a parser may raise anything on somebody's file
        raise AssetError(f"{mesh}: it cannot be read as a mesh: {error}") from error
    if not closed or volume <= 0:
        raise AssetError(f"{mesh}: it is not closed, so that it has no volume: fill its holes, faces outward")
    centre = found.bounds.mean(axis=0)
    com = found.center_mass - centre
    turning = found.moment_inertia / volume
    six = (turning[0, 0], turning[1, 1], turning[2, 2], turning[0, 1], turning[0, 2], turning[1, 2])
    return (
        tuple(float(value) for value in centre),
        tuple(extents),
        volume,
        tuple(map(float, com)),
        tuple(map(float, six)),
    )

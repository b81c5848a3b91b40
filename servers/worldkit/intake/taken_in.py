"""All steps from a mesh file to the files of an asset's folder, and what is told of it."""

from pathlib import Path
from typing import Any

import numpy as np
import yaml

from ..errors import IntakeError
from ..files import write_atomic
from . import declared_sizes, drawn_pieces, mending, moving_parts, shown_meshes, told_frames, touchable, upright
from .drawn_pieces import Array
from .mending import Solid

HEADER = "Taken in by `worldwright asset add`; what is measured here is of the files beside it."
LARGE, FULL, HOLLOW = 0.02, 0.2, 120.0
"""A built-up thing larger than so many m^3 that fills so much of its box is hollow, and has this density, kg/m^3, on the whole."""
HOLLOW_SOURCE = "between a refrigerator (70 kg in 0.65 m^3), a sofa and a car, our judgement"
HEAVIEST, LIGHTEST = 30_000.0, 0.5
"""kg/m^3: no thing's mean density is higher, or lower."""


def take_in(file: Path, asked: dict[str, Any]) -> tuple[dict[str, bytes], dict[str, Any]]:
    """The files of an asset by name, `asset.yaml` with them, and its facts as in that.

    Args:
        file: the mesh; what belongs to it lies beside it.
        asked: `key`, `category`, `description`, `licence`, `creator`, `source`, `material` (a row of density, friction …
            with its `name` and `source`), and optionally `height`, `units`, `reference`, `up`, `front`, `mass`; of a library's
            offer also `extents`, m, to which each axis is scaled, `rotation` (3, 3) in the file's axes, and `built_up`:
            what is large and full is hollow inside.

    Raises:
        IntakeError: it cannot become an asset.
    """
    suffix = file.suffix.lower()
    declared_sizes.check(file)
    pieces, said = drawn_pieces.read(file)
    told = told_frames.of(file)
    turn, assumed = upright.turn(suffix, asked.get("up", ""), asked.get("front", ""), told)
    turn = turn @ np.asarray(asked.get("rotation") or np.eye(3), float)
    pieces = [piece.moved(turn, np.zeros(3)) for piece in pieces]
    low, high = _box([piece.vertices[np.unique(piece.faces)] for piece in pieces])
    if not high[2] > low[2]:
        raise IntakeError(
            "zero_volume", "it is flat: it has no height", file.name, "give it thickness, or name another --up"
        )
    factor, height_source, more = upright.scale(suffix, high - low, asked, told)
    pieces = [piece.moved(np.diag(factor), -factor * (low + high) / 2) for piece in pieces]
    solid = mending.solid_of(pieces, file.name)
    rows, hulls, how = touchable.pieces(solid)
    files, visual, materials, shown = shown_meshes.files(pieces)
    for row in rows:
        if "hull" in row:
            row["file"] = f"hull_{row.pop('hull'):02d}.obj"
            files[row["file"]] = touchable.hull_text(hulls[int(row["file"][5:-4])]).encode()
    size = factor * (high - low)
    facts = {
        "key": asked["key"],
        "category": asked["category"],
        "description": asked["description"],
        "source": asked["source"],
        "licence": asked["licence"],
        "creator": asked["creator"],
        "native_extents": [round(float(side), 6) for side in size],
        "metric_height": round(float(size[2]), 6),
        "metric_height_source": height_source,
        **_weight(solid, hulls, size, asked, assumed),
        **{
            name: asked["material"][name]
            for name in ("friction", "restitution")
            if asked["material"].get(name) is not None
        },
        "contact_source": f"{asked['material']['name']}: {asked['material']['source']}",
        "facing": "+x",
        "visual": visual,
        "materials": materials,
        "recolour": sorted({row["material"] for row in visual}),
        "collision": [_rounded(row) for row in rows],
        "mended": [*said, *solid.said, *shown],
        "assumed": [*assumed, *more, *asked.get("assumed", ())],
        "measured": {
            "collides_as": how,
            "triangles": sum(len(piece.faces) for piece in pieces),
            "closed": solid.closed,
        },
    }
    if (moving := moving_parts.model(asked["key"], pieces, facts)) is not None:
        files |= moving[0]
        facts["measured"]["moving"] = moving[1]
    facts["assumed"] = list(dict.fromkeys(facts["assumed"]))
    return files, facts


def write(folder: Path, files: dict[str, bytes], facts: dict[str, Any], header: str = HEADER) -> None:
    """Write an asset's folder, its `asset.yaml` last."""
    for name, content in files.items():
        write_atomic(folder / name, content)
    write_atomic(folder / "asset.yaml", text(facts, header))


def text(facts: dict[str, Any], header: str = HEADER) -> str:
    """`asset.yaml`."""
    kept = {key: value for key, value in facts.items() if value not in ([], {}, None, "")}
    body = yaml.safe_dump(kept, sort_keys=False, allow_unicode=True, width=120, default_flow_style=None)
    return f"# {header}\n{body}"


def _box(clouds: list[Array]) -> tuple[Array, Array]:
    return np.min([cloud.min(axis=0) for cloud in clouds], axis=0), np.max(
        [cloud.max(axis=0) for cloud in clouds], axis=0
    )


def _weight(solid: Solid, hulls: list[Array], size: Array, asked: dict[str, Any], assumed: list[str]) -> dict[str, Any]:
    """Mass or density, volume and inertia, in the frame of the box's centre."""
    if solid.closed:
        volume, com, inertia = solid.volume, solid.com, solid.inertia
    elif hulls:
        volume, com, inertia = _of_hulls(hulls)
        assumed.append("its volume is that of what it collides as")
    else:
        volume = float(np.prod(size))
        com, inertia = np.zeros(3), volume * np.diag([size @ size - side**2 for side in size]) / 12
        assumed.append("its volume is that of its box")
    six = inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]] / volume
    material = asked["material"]
    weight: dict[str, Any] = {"density": float(material["density"])}
    box = float(np.prod(size))
    source = f"{material['name']}, {material['density']:g} kg/m^3: {material['source']}"
    if asked.get("built_up") and box > LARGE and volume > FULL * box:
        weight, source = {"density": HOLLOW}, f"{HOLLOW:g} kg/m^3 of its outside: {HOLLOW_SOURCE}"
        assumed.append(f"it is hollow inside, {HOLLOW:g} kg/m^3 on the whole: give its --mass in kg where it is known")
    if asked.get("mass"):
        weight, source = {"mass": float(asked["mass"])}, "stated by whoever added it"
        mean = float(asked["mass"]) / volume
        if not LIGHTEST <= mean <= HEAVIEST:
            raise IntakeError(
                "implausible_mass", f"{asked['mass']:g} kg in {volume:.3g} m^3 are {mean:.3g} kg/m^3, which no substance has",
                "", "correct its --mass in kg, or its --height in m",
            )  # fmt: skip
    return {
        **weight,
        "mass_source": source,
        "solid_volume": float(f"{volume:.6g}"),
        "inertia": {"com": [round(float(v), 7) + 0.0 for v in com], "per_kg": [float(f"{v:.6g}") + 0.0 for v in six]},
    }


def _of_hulls(hulls: list[Array]) -> tuple[float, Array, Array]:
    """Volume, centre (3,) and inertia (3, 3) of hulls that hardly overlap."""
    from scipy.spatial import ConvexHull

    volume, moment, second = 0.0, np.zeros(3), np.zeros((3, 3))
    for corners in hulls:
        faces = ConvexHull(corners).simplices
        middle = corners.mean(axis=0)
        a, b, c = (corners[faces[:, k]] - middle for k in range(3))
        inward = np.einsum("fi,fi->f", a, np.cross(b, c)) < 0
        faces = np.where(inward[:, None], faces[:, ::-1], faces)
        own, com, inertia = mending.properties(corners, faces)
        volume += own
        moment += own * com
        second += inertia + own * (com @ com * np.eye(3) - np.outer(com, com))
    com = moment / volume
    return volume, com, second - volume * (com @ com * np.eye(3) - np.outer(com, com))


def _rounded(row: dict[str, Any]) -> dict[str, Any]:
    return {
        key: [round(v, 7) + 0.0 for v in value]
        if isinstance(value, list)
        else round(value, 7)
        if isinstance(value, float)
        else value
        for key, value in row.items()
    }

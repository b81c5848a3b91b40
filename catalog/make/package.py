"""A recipe becomes the files of its asset folder: OBJ meshes, PNG textures, hulls and `asset.yaml`."""

from collections import Counter
from typing import Any

import numpy as np
import trimesh
import yaml

from .hulls import Hull, Primitive
from .recipe import Part, Recipe
from .surface import Surface, hull_text, obj_text
from .texture import png


def files(recipe: Recipe) -> dict[str, bytes]:
    """Every file of the asset (without the thumbnail), by path inside its folder."""
    points = np.concatenate([part.surface.vertices for part in recipe.parts])
    low, high = points.min(axis=0), points.max(axis=0)
    centre, extents = (low + high) / 2, high - low
    out: dict[str, bytes] = {}
    visual = []
    for part in recipe.parts:
        surface = part.surface.mapped(part.surface.vertices - centre)
        out[f"{part.name}.obj"] = obj_text(surface, part.crease_deg).encode()
        visual.append({"mesh": f"{part.name}.obj", "material": part.material})
    for name, picture in recipe.textures.items():
        out[name] = png(picture, recipe.texture_levels.get(name, 256))
    collision: list[dict[str, Any]] = []
    written: dict[int, str] = {}
    uses = Counter(id(piece.surface) for piece in recipe.collision if isinstance(piece, Hull))
    shared = {key for key, count in uses.items() if count > 1}
    for piece in recipe.collision:
        if isinstance(piece, Primitive):
            collision.append(_primitive(piece, centre))
            continue
        if piece.pos == (0.0, 0.0, 0.0) and id(piece.surface) not in shared:  # a lone piece is stored where it belongs
            vertices, pose = piece.surface.vertices - centre, {}
        else:
            vertices, pose = (
                piece.surface.vertices,
                {"pos": _rounded(np.array(piece.pos) - centre), "quat": _rounded(piece.quat, 6)},
            )
        name = written.setdefault(id(piece.surface), f"hulls/{len(written):02d}.obj")
        out[name] = hull_text(vertices, piece.surface.faces).encode()
        collision.append({"type": "hull", **_named(piece), "file": name, **pose, **piece.contact})
    volume, com, spread = _mass_properties(recipe.parts)
    facts = {
        "key": recipe.key,
        "category": recipe.category,
        "description": recipe.description,
        "source": f"made by code: catalog/make/{recipe.key}.py",
        "licence": "Apache-2.0",
        "facing": "+x",
        "native_extents": _rounded(extents),
        "metric_height": recipe.metric_height,
        "metric_height_source": recipe.metric_height_source,
        "mass": recipe.mass,
        "mass_source": recipe.mass_source,
        "solid_volume": float(f"{volume:.6g}"),
        "inertia": {"com": _rounded(com - centre), "per_kg": [float(f"{x:.6g}") for x in spread]},
        **recipe.contact,
        "contact_source": recipe.contact_source,
        "visual": visual,
        "materials": recipe.materials,
        "recolour": list(recipe.recolour),
        "looks": recipe.looks,
        "default_look": recipe.default_look,
        "collision": collision,
        "supports": [
            {
                "name": support.name,
                "default": support.default,
                "z_fraction": round(float((support.z - low[2]) / extents[2]), 6),
                "centre": _rounded(np.array(support.centre) - centre[:2]),
                "extents": _rounded(support.extents),
                "shape": support.shape,
            }
            for support in recipe.supports
        ],
        "thumbnail": "thumbnail.png",
    }
    facts = {key: value for key, value in facts.items() if value not in ([], {}, None)}
    header = (
        f"# Written by `python -m catalog.make {recipe.key}`: change catalog/make/{recipe.key}.py, not this file.\n"
    )
    text = yaml.dump(facts, sort_keys=False, allow_unicode=True, width=120, Dumper=_Flat)
    out["asset.yaml"] = (header + text).encode()
    return out


class _Flat(yaml.SafeDumper):
    """Lists of numbers on one line, everything else in block style."""

    def represent_sequence(self, tag: str, sequence: Any, flow_style: bool | None = None) -> yaml.SequenceNode:
        items = list(sequence)
        return super().represent_sequence(tag, items, flow_style=not any(isinstance(i, (dict, list)) for i in items))

    def ignore_aliases(self, data: Any) -> bool:
        return True


def _primitive(piece: Primitive, centre: np.ndarray) -> dict[str, Any]:
    row: dict[str, Any] = {"type": piece.type, **_named(piece), "pos": _rounded(np.array(piece.pos) - centre)}
    if piece.quat != (1.0, 0.0, 0.0, 0.0):
        row["quat"] = _rounded(piece.quat, 6)
    if piece.extents is not None:
        row["extents"] = _rounded(piece.extents)
    for name in ("diameter", "height"):
        if getattr(piece, name) is not None:
            row[name] = round(float(getattr(piece, name)), 5)
    return row | piece.contact


def _named(piece: Primitive | Hull) -> dict[str, str]:
    return {"name": piece.name} if piece.name else {}


def _rounded(values: Any, digits: int = 5) -> list[float]:
    return [round(float(v), digits) + 0.0 for v in values]


def _mass_properties(parts: list[Part]) -> tuple[float, np.ndarray, np.ndarray]:
    """Solid volume (m^3), centre of mass (3,), and inertia about it per kilogram (xx, yy, zz, xy, xz, yz; m^2)."""
    volume, mass, moment, second = 0.0, 0.0, np.zeros(3), np.zeros((3, 3))
    for part in parts:
        for surface, sign in ((part.surface, 1.0), (part.cavity, -1.0)):
            if surface is None or part.density == 0:
                continue
            body = _solid(surface, part.name)
            m = sign * part.density * body.volume
            c = np.asarray(body.center_mass)
            volume += sign * body.volume
            mass += m
            moment += m * c
            second += sign * part.density * np.asarray(body.moment_inertia) + m * (c @ c * np.eye(3) - np.outer(c, c))
    com = moment / mass
    inertia = second / mass - (com @ com * np.eye(3) - np.outer(com, com))
    return volume, com, inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]


def _solid(surface: Surface, name: str) -> trimesh.Trimesh:
    body = trimesh.Trimesh(surface.vertices, surface.faces, process=True)
    if not body.is_watertight or body.volume <= 0:
        raise ValueError(
            f"part {name!r} has a density but is not a closed, outward surface (volume {body.volume:.3g} m^3)"
        )
    return body

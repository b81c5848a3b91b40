"""A kit: a thing of sculpted parts, each of one substance; it becomes an asset by the way of `worldwright asset keep`.

Metres and degrees; z up, +x the front; it stands on its floor as it is written.
"""

import hashlib
import os
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from worldkit import contacts
from worldkit.intake import confined_intake, of_figure
from worldkit.joints import Joint
from worldkit.sculpt import Part
from worldkit.sculpt.brushes import Paint
from worldwright.intake import substances

KITS = Path(__file__).parent / "kits"
LOOKS = {
    "wood": "wood_cherry", "oak": "wood_oak", "pine": "wood_pine", "steel": "titanium", "iron": "iron_cast", "brass": "brass",
    "copper": "copper", "gold": "gold", "aluminium": "aluminium", "glass": "glass_clear", "ceramic": "ceramic_white",
    "rubber": "rubber_black", "plastic": "plastic_white", "wax": "wax", "fabric": "fabric_red", "leather": "leather_brown",
    "clay": "ceramic_terracotta", "stone": "granite", "paper": "paper",
}  # fmt: skip
"""What a substance looks like unless a part says otherwise."""


@dataclass(frozen=True)
class Kit:
    """A thing, and what its shape does not tell."""

    category: str
    description: str
    size_source: str
    """Whose measures these are."""
    substance: str
    """What it touches with: friction and restitution of the whole."""
    parts: tuple[Part, ...]


def part(
    name: str, shape: Any, of: str, parent: str | None = None, joint: "Joint | Sequence[Joint] | None" = None, *,
    look: str | None = None, paint: Paint | None = None, hulls: Any = "auto", density: float | None = None,
    restitution: float | None = None, roughness: float = 0.5, metallic: float = 0.0, texels: int = 512, triangles: int = 6000,
) -> Part:  # fmt: skip
    """A part of one substance, with its density, contact and look."""
    row = substances.named(of)
    surface = contacts.surface(friction=row["friction"], restitution=restitution)
    make = {"hulls": hulls, "texels": texels, "triangles": triangles}
    return Part(
        name, shape, parent, joint, paint=paint, look=None if paint else look or LOOKS[of], roughness=roughness,
        metallic=metallic, density=density or row["density"], surface=surface, make=make,
    )  # fmt: skip


def source(key: str) -> str:
    """SHA-256 of the module that a kit is written in; its `asset.yaml` holds it, so that a stale one is told from its source."""
    return hashlib.sha256((KITS / f"{key}.py").read_bytes()).hexdigest()


def asset(key: str, kit: Kit) -> dict[str, bytes]:
    """Every file of the asset (without the thumbnail) by name, after it has stood on a floor for five seconds."""
    made, facts = files(key, kit)
    before = dict(os.environ)
    try:
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "out"
            out.mkdir()
            header = f"Written by `python -m catalog.make {key}`: change catalog/make/kits/{key}.py, not this file."
            confined_intake.finish(made, facts, Path(folder), out, header)
            return {
                path.name: path.read_bytes() for path in out.iterdir() if path.name not in ("world.mjz", "program.json")
            }
    finally:
        os.environ.clear()
        os.environ.update(before)


def files(key: str, kit: Kit) -> tuple[dict[str, bytes], dict[str, Any]]:
    """The files of the asset and its facts, before it has stood on a floor."""
    row = substances.named(kit.substance)
    said = {
        "category": kit.category,
        "description": kit.description,
        "source": f"made by code: catalog/make/kits/{key}.py",
        "licence": "Apache-2.0",
        "metric_height_source": kit.size_source,
        "mass_source": "density of each part's substance times its volume: servers/worldwright/intake/substances.csv",
        "friction": row["friction"],
        "restitution": row["restitution"],
        "contact_source": f"{row['name']}: {row['source']}",
    }
    made, facts = of_figure.files(key, kit.parts, said)
    facts["measured"]["source_sha256"] = source(key)
    return made, facts

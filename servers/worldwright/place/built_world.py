"""The world that is built already, where there is one: what the bundle pass found in it (`layout.json`)."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..model.errors import WorldwrightError
from ..model.evidence import environment
from ..model.evidence.run import Run, sha256_file
from ..model.plan import belonging

LAYOUT = "layout.json"
LARGEST = 64 << 20


@dataclass(frozen=True)
class BuiltWorld:
    """What stands in the bundle of exactly this program and plan."""

    parents: dict[str, str]
    """By the name of a body that of the body that carries it."""
    contacts: tuple[tuple[str, str, float, float], ...]
    """Bodies that are inside each other at the start, the depth, m, and the radius of the smaller geom, m; deepest first."""

    def owner(self, body: str, objects: set[str]) -> str:
        """The object that a body belongs to (`model.plan.belonging`)."""
        return belonging.owner(body, self.parents, objects)


def find(plan: Path) -> BuiltWorld | None:
    """The built world of a run's plan and program as they stand; None where the bundle pass has not made it, or it was changed."""
    run = Run(plan.parent)
    try:
        if plan.resolve() != run.plan.resolve():
            return None
        folder = run.evidence(run.evidence_key(environment.current().sha256())) / "bundle"
        result = _object(folder / "result.json")
        if not result.get("ok") or sha256_file(folder / LAYOUT) != (result.get("files") or {}).get(LAYOUT):
            return None
        told = _object(folder / LAYOUT)
        rows = tuple((str(a), str(b), float(depth), float(radius)) for a, b, depth, radius in told["contacts"])
        return BuiltWorld({str(n): str(body["parent"]) for n, body in told["bodies"].items()}, rows)
    except (WorldwrightError, OSError, KeyError, TypeError, ValueError, AttributeError):
        return None


def _object(path: Path) -> dict[str, Any]:
    if path.stat().st_size > LARGEST:
        raise ValueError(path.name)
    value = json.loads(path.read_bytes())
    return value if isinstance(value, dict) else {}

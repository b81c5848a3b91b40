"""What things are made of, for the mass and the contacts of a mesh that tells neither: `substances.csv`."""

import csv
from functools import cache
from pathlib import Path
from typing import Any

from ..model.errors import NotFoundError

UNSTATED = "plastic"


@cache
def table() -> dict[str, dict[str, Any]]:
    """Each substance with `name`, `density` (kg/m^3), `friction`, `restitution` and `source`."""
    with (Path(__file__).parent / "substances.csv").open(encoding="utf-8", newline="") as lines:
        return {
            row["substance"]: {
                "name": row["substance"],
                **{key: float(row[key]) for key in ("density", "friction", "restitution")},
                "source": row["source"],
            }
            for row in csv.DictReader(lines)
        }


def named(name: str) -> dict[str, Any]:
    """One substance.

    Raises:
        NotFoundError: there is none of that name; it lists those that there are.
    """
    found = table().get(name.strip().lower())
    if found is None:
        raise NotFoundError(
            f"there is no material {name!r}", place="material", next_move=f"name one of: {', '.join(table())}"
        )
    return found

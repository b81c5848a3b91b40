"""A number of a plan by its path: `simulation_parameters.masses.ball`, `scene_objects.ball.size[2]`.

A row of a list is named by its `name`, or by its place, counted from 0 as in the messages of `lint`. Only numbers that are
written in the plan can be swept: a number that is not there has no value to differ from.
"""

import re
from collections.abc import Iterator
from difflib import get_close_matches
from typing import Any

from ..model.plan.plan_problems import dotted
from ..model.plan.plan_text import PlanDocument
from .campaign_file import CampaignError

Path = tuple[str | int, ...]
MOST_NAMED = 12
_PART = re.compile(r"\.?([^.\[\]]+)|\[(\d{1,9})\]")


def path_of(document: PlanDocument, field: str) -> Path:
    """Where a field stands in a plan.

    Raises:
        CampaignError: there is no such number; the nearest that are there are named.
    """
    path: list[str | int] = []
    at = 0
    while at < len(field) and (part := _PART.match(field, at)):
        path.append(part[1] if part[1] is not None else int(part[2]))
        at = part.end()
    found = _found(document, tuple(path)) if at == len(field) else None
    if found is None:
        known = list(numbers(document))
        near = get_close_matches(field, known, n=MOST_NAMED, cutoff=0.5) or known[:MOST_NAMED]
        raise CampaignError(
            f"the plan has no number `{field}`",
            place=document.file,
            next_move=f"its {len(known)} numbers are named like {', '.join(near)}" if near else "it holds no number",
        )
    return found


def numbers(document: PlanDocument) -> dict[str, float]:
    """Every number that is written in a plan, by its path."""
    found = {}
    for section, node in document.nodes.items():
        for path, value in _walk((section,), node.data()):
            found[dotted(path)] = value
    return found


def _walk(path: Path, value: Any) -> Iterator[tuple[Path, float]]:
    if isinstance(value, dict):
        for key, item in value.items():
            yield from _walk((*path, str(key)), item)
    elif isinstance(value, list | tuple):
        for number, item in enumerate(value):
            yield from _walk((*path, number), item)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield path, value


def _found(document: PlanDocument, wanted: Path) -> Path | None:
    """The path with rows by their numbers; None where no number stands there."""
    if not wanted or wanted[0] not in document.nodes:
        return None
    value = document.nodes[str(wanted[0])].data()
    path: list[str | int] = [wanted[0]]
    for part in wanted[1:]:
        if isinstance(value, list | tuple) and isinstance(part, str):
            rows = [n for n, row in enumerate(value) if isinstance(row, dict) and row.get("name") == part]
            if len(rows) != 1:
                return None
            part = rows[0]
        try:
            value = value[part]
        except (KeyError, IndexError, TypeError):
            return None
        path.append(part)
    return tuple(path) if isinstance(value, int | float) and not isinstance(value, bool) else None

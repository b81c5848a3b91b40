"""Joints with limits and constraints with anchors, as data: what must stay within a range, and what must stay together."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

Array = np.ndarray


@dataclass(frozen=True)
class Joint:
    """A hinge or a slide with limits."""

    name: str
    body: int
    """Index of the body it moves."""
    kind: str
    """`hinge` or `slide`."""
    axis: Array
    """(3,) in the body's own frame."""
    low: float
    """rad or m, measured from the model's reference pose."""
    high: float
    pos0: Array
    """(3,) of the body in its parent's frame in the reference pose, m."""
    quat0: Array
    """(4,) wxyz, likewise."""


@dataclass(frozen=True)
class Tie:
    """A weld or a connect: two points that coincide while it holds."""

    name: str
    bodies: tuple[int, int]
    """Indices; -1 is the world."""
    anchors: Array
    """(2, 3) the point in each body's own frame, m."""


@dataclass(frozen=True)
class Rope:
    """A tendon that may not be longer than its limit; a rod not shorter than another, either."""

    name: str
    bodies: tuple[int, ...]
    """(N,) indices along its way; -1 is the world."""
    points: Array
    """(N, 3) in each body's own frame, m."""
    longest_m: float
    shortest_m: float = 0.0


def ropes(rows: Sequence[Mapping[str, Any]], index: Any) -> tuple[Rope, ...]:
    """From the rows of `describe`; those without a limit or a way are left out."""
    return tuple(
        Rope(
            str(row.get("name", "")),
            tuple(index(body) for body, _ in row["way"]),
            np.array([point for _, point in row["way"]], dtype=float),
            float(row["range"][1]),
            float(row["range"][0]),
        )
        for row in rows
        if row.get("range") is not None and len(row.get("way") or ()) > 1
    )


def joints(rows: Sequence[Mapping[str, Any]], index: Any) -> tuple[Joint, ...]:
    """From the rows of `describe`; those without limits or details are left out."""
    found = []
    for row in rows:
        if row.get("range") is None or row.get("quat0") is None or index(row.get("body")) < 0:
            continue
        low, high = (float(v) for v in row["range"])
        vectors = {key: np.asarray(row[key], dtype=float) for key in ("axis", "pos0", "quat0")}
        found.append(
            Joint(str(row.get("name", "")), index(row["body"]), str(row["type"]), low=low, high=high, **vectors)
        )
    return tuple(found)


def ties(rows: Sequence[Mapping[str, Any]], index: Any) -> tuple[Tie, ...]:
    """From the rows of `describe`; those that start inactive or without anchors are left out."""
    found = []
    for row in rows:
        if row.get("anchors") is None or not row.get("active", True):
            continue
        one, other = (index(name) for name in row["ends"])
        found.append(Tie(str(row.get("name", "")), (one, other), np.asarray(row["anchors"], dtype=float)))
    return tuple(found)

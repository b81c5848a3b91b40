"""How the work of an author's laws is spread over their time: of what is poured, little at first and most at last."""

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from .files import write_json

if TYPE_CHECKING:
    from .laws import Law

GROWING, PARTS = "growing.json", 40
"""The file, for whoever waits, and into how many equal parts the time is divided in it."""


def shares(laws: "Sequence[Law]", whole_s: float) -> list[float]:
    """The share of the work that is done after each part of `whole_s` s, from 0 to 1; empty where no law tells (`grows`)."""
    import numpy as np

    found = []
    for law in laws:
        with suppress(Exception):  # an author's own code, of which only an estimate depends
            done = np.arange(1, PARTS + 1) / PARTS
            grows = np.array([float(law.grows(share * whole_s, whole_s)) for share in done])  # type: ignore[attr-defined]
            spread = np.maximum.accumulate(done / np.maximum(grows, 1e-9))
            if np.isfinite(spread).all():
                found.append((len(getattr(law, "mass", ())) or 1, spread / spread[-1]))
    if not found:
        return []
    mean = sum(points * spread for points, spread in found) / sum(points for points, _ in found)
    return [0.0, *(round(float(share), 6) for share in mean)]


def write(out: Path, laws: "Sequence[Law]", whole_s: float) -> None:
    """Write them into a folder, if there are any."""
    if told := shares(laws, whole_s):
        write_json(out / GROWING, {"shares": told})

"""The heights of things by category, against which `asset_dimensions` and sizes are judged.

`categories.csv` has one row for each category: the range of heights, what kind of thing it is, what it usually rests on, where
a seat is as a share of its height, and who says so. An object's category is the longest one that its name ends with, as the
head of an English compound is its last word: `dining_chair_2` is a dining chair, `chair_leg` is no chair.
"""

import csv
import re
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path

from ..model.plan.committed import AssetRow, SceneObject

_SIDES = re.compile("left|right|upper|lower|middle|first|second|third|near|far|north|south|east|west|[a-f]")
"""Words that only distinguish similar things; a `top`, a `back` or a `leg` is a part and is not judged."""
_SCALED = frozenset({"toy", "model", "mini", "miniature", "giant", "huge", "tiny", "doll", "scale"})
"""Words that say that the usual size does not hold."""
_PLURALS = {
    "shelves": "shelf",
    "knives": "knife",
    "dice": "dice",
    "glasses": "glass",
    "boxes": "box",
    "benches": "bench",
}


@dataclass(frozen=True)
class Category:
    """One row: heights in metres; `kind` is support, seat, container, terrain, large or thing."""

    name: str
    low_m: float
    high_m: float
    kind: str
    rests_on: str
    seat_share: tuple[float, float] | None
    source: str

    @property
    def head(self) -> str:
        """Its last word."""
        return self.name.rsplit(" ", 1)[-1]


@cache
def table() -> dict[str, Category]:
    """Every category by name."""
    path = Path(__file__).parent / "categories.csv"
    with path.open(encoding="utf-8", newline="") as lines:
        return {row["category"]: _category(row) for row in csv.DictReader(lines)}


def _category(row: dict[str, str]) -> Category:
    share = tuple(float(v) for v in row["seat_share"].split("-")) if row["seat_share"] else None
    low, high = float(row["height_low_m"]), float(row["height_high_m"])
    seat = (share[0], share[1]) if share else None
    return Category(row["category"], low, high, row["kind"], row["rests_on"], seat, row["source"])


def of(row: SceneObject | AssetRow, name: str) -> Category | None:
    """The category of an object, by its own name, its catalog key, or a role that is a category."""
    other = row.filename if isinstance(row, AssetRow) else row.role
    return named(name) or (named(other) if isinstance(row, AssetRow) or other.lower() in table() else None)


@lru_cache(maxsize=65536)
def named(name: str) -> Category | None:
    """The longest category with which a name ends; None if there is none or the name tells of another scale."""
    words = [w for w in re.split(r"[^a-z]+", re.sub(r"([a-z])([A-Z])", r"\1 \2", name).lower()) if w]
    if _SCALED.intersection(words):
        return None
    known = table()
    while words:
        for start in range(len(words)):
            phrase = " ".join(words[start:])
            found = known.get(phrase) or known.get(_singular(phrase))
            if found is not None:
                return found
        if not _SIDES.fullmatch(words[-1]):
            return None
        words.pop()
    return None


def _singular(phrase: str) -> str:
    *before, last = phrase.split(" ")
    last = _PLURALS.get(last, last.removesuffix("s"))
    return " ".join([*before, last])

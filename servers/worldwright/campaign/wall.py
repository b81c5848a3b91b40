"""The page of a campaign: what came of it, failures grouped by cause, histograms of margins, and a wall of its worlds.

`index.html` lies in the campaign's folder and reads nothing but the posters, films and reports beside it; a film plays under the pointer. Rows are gone through twice:
once for the columns and the order, then by number for the table, the page and whoever else looks at each; of a very large campaign
the page shows the worlds that come first.
"""

import json
import math
from array import array
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from worldkit.files import write_atomic

from ..model.frozen import Frozen
from . import campaign_table
from .campaign_store import Store
from .world_row import Row

PAGE = "index.html"
MOST_SHOWN = 20_000
MOST_OF_A_CAUSE = 12
BINS = 24


class Histogram(Frozen):
    """The margins of one expectation over all worlds."""

    name: str
    unit: str
    low: float
    high: float
    counts: tuple[int, ...]
    """One a bin, of equal widths from `low` to `high`."""
    fails: int
    """Margins below 0."""
    total: int

    @property
    def zero(self) -> float | None:
        """Where 0 lies between the ends, as a share; None beyond them."""
        share = -self.low / (self.high - self.low)
        return share if 0 <= share <= 1 else None

    @property
    def bars(self) -> list[tuple[float, float, bool]]:
        """Of each bin: where it begins and how high it is, as shares, and whether all of it lies below 0."""
        top, width = max(self.counts), (self.high - self.low) / len(self.counts)
        return [
            (n / len(self.counts), count / top, self.low + (n + 1) * width <= 0) for n, count in enumerate(self.counts)
        ]


@dataclass
class Group:
    """The worlds of one cause."""

    kind: str
    step: str
    count: int = 0
    said: str = ""
    next_move: str = ""
    rows: list[Row] = field(default_factory=list)


@dataclass
class Seen:
    """What the page says of the rows."""

    outcomes: Counter[str] = field(default_factory=Counter)
    groups: dict[tuple[str, str], Group] = field(default_factory=dict)
    margins: dict[str, "array[float]"] = field(default_factory=lambda: defaultdict(lambda: array("d")))
    units: dict[str, str] = field(default_factory=dict)
    shown: list[Row] = field(default_factory=list)
    total: int = 0
    tokens: int = 0
    usd: float = 0.0

    def add(self, row: Row) -> None:
        """One row more."""
        self.total += 1
        self.outcomes[row.outcome] += 1
        self.tokens += row.tokens_read + row.tokens_written
        self.usd += row.usd or 0.0
        if row.cause is not None:
            group = self.groups.setdefault((row.cause.kind, row.cause.step), Group(row.cause.kind, row.cause.step))
            group.count += 1
            group.said, group.next_move = group.said or row.cause.said, group.next_move or row.cause.next_move
            if len(group.rows) < MOST_OF_A_CAUSE:
                group.rows.append(row)
        for margin in row.margins:
            if margin.margin is not None and math.isfinite(margin.margin):
                name = f"{margin.objective}.{margin.name}"
                self.margins[name].append(margin.margin)
                self.units[name] = margin.unit
        if len(self.shown) < MOST_SHOWN:
            self.shown.append(row)


def write(store: Store, see: Callable[[Row], None] = lambda _: None) -> list[Path]:
    """Write `table.parquet`, `table.csv` and `index.html` of what is done so far, each by the worlds' numbers; returns their paths.

    Args:
        store: a campaign.
        see: shown each row that the table has, in its order.
    """
    seen, places = Seen(), list[tuple[int, str]]()

    def placed() -> Iterator[Row]:
        for row in store.rows():
            places.append((row.number, row.world))
            yield row

    def by_number() -> Iterator[Row]:
        for _, world in sorted(places):
            if (row := store.row(world)) is not None:
                seen.add(row)
                see(row)
                yield row

    columns = campaign_table.columns(placed())
    table = campaign_table.write(by_number(), columns, store.folder)
    page = store.folder / PAGE
    write_atomic(page, render(store, seen))
    return [*table, page]


def render(store: Store, seen: Seen) -> str:
    """The page as HTML."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader("worldwright.campaign"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    campaign = store.begun.campaign
    return environment.get_template("wall.html").render(
        name=campaign.name or store.folder.name,
        until=campaign.until,
        worlds=campaign.size,
        author=campaign.author,
        seen=seen,
        outcomes=seen.outcomes.most_common(),
        groups=sorted(seen.groups.values(), key=lambda group: -group.count),
        histograms=[histogram(name, values, seen.units[name]) for name, values in sorted(seen.margins.items())],
        rows=embedded(seen.shown),
        categories=sorted({row.category for row in seen.shown if row.category}),
    )


def histogram(name: str, values: Sequence[float], unit: str = "") -> Histogram:
    """The histogram of finite values, at least one."""
    low, high = min(values), max(values)
    if high - low <= 1e-12 * max(1.0, abs(low)):
        low, high = low - 0.5, high + 0.5
    counts = [0] * BINS
    for value in values:
        counts[min(BINS - 1, int((value - low) / (high - low) * BINS))] += 1
    fails = sum(value < 0 for value in values)
    return Histogram(name=name, unit=unit, low=low, high=high, counts=tuple(counts), fails=fails, total=len(values))


def embedded(rows: list[Row]) -> str:
    """Rows as JSON that may stand inside a script: no `<` of any text ends it."""
    return json.dumps(list(map(_tile, rows)), separators=(",", ":")).replace("<", "\\u003c")


def _tile(row: Row) -> dict[str, Any]:
    """What the wall shows of a world; what is empty is left out, since there are many."""
    margin = row.margin
    told = {
        "n": row.number,
        "w": row.world,
        "o": row.outcome,
        "c": row.category,
        "k": row.cause.kind if row.cause else "",
        "m": round(margin, 6) if margin is not None and math.isfinite(margin) else None,
        "v": ", ".join(_values(row)),
        "p": row.poster,
        "f": row.film,
        "r": row.report or (f"{row.folder}/" if row.folder else ""),
    }
    return {name: value for name, value in told.items() if value not in ("", None)}


def _values(row: Row) -> Iterator[str]:
    for name, value in row.values.items():
        yield f"{name.rsplit('.', 1)[-1]} {value:g}"

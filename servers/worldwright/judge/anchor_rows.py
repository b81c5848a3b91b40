"""The published figures that a run is compared with: the reference, and ten video models under the same judge.

Source: the reference's paper (ChronoAgentic), table "PhyWorldBench results", left (its categories) and right (all systems), 80
demos, judged by Gemini 2.5 Pro on the full film at 24 fps with the benchmark's own judging prompt. The paper gives percents,
rounded to a tenth; the counts behind them are whole numbers out of n, of which only one is near enough (`count`).
"""

import csv
from functools import cache
from importlib.resources import files

from .tally import Group, Share

FILE = "published_figures.csv"
CITED = (
    'ChronoAgentic, table "PhyWorldBench results": 80 demos, judge Gemini 2.5 Pro on the full film at 24 fps, '
    "the benchmark's judging prompt; films of the video models: PhyWorldBench's release"
)
ROUNDED = 0.0501
"""The paper rounds halves now up, now down: a count is meant where its percent is as near as this."""
REFERENCE = "ChronoAgentic"


@cache
def systems() -> tuple[Group, ...]:
    """Overall rows: the reference first, then the video models by what share has everything right."""
    return tuple(_group(row) for row in _rows() if row["kind"] != "category")


@cache
def categories() -> tuple[Group, ...]:
    """The reference's own categories."""
    rows = [row for row in _rows() if row["kind"] == "category"]
    return tuple(_group({**row, "system": row["system"].partition(" / ")[2]}) for row in rows)


def count(percent: float, of: int) -> int:
    """How many of `of` a printed percent means.

    Raises:
        ValueError: no whole number of them, or more than one, rounds to it.
    """
    near = [k for k in range(of + 1) if abs(100 * k / of - percent) <= ROUNDED]
    if len(near) != 1:
        raise ValueError(f"{percent} % of {of} is no whole number of them")
    return near[0]


def _rows() -> list[dict[str, str]]:
    text = files(__package__).joinpath(FILE).read_text(encoding="utf-8")
    return list(csv.DictReader(text.splitlines()))


def _group(row: dict[str, str]) -> Group:
    of = int(row["n"])
    sa, pc, both = (Share(passed=count(float(row[name]), of), of=of) for name in ("sa", "pc", "both"))
    return Group(name=row["system"], sa=sa, pc=pc, both=both)

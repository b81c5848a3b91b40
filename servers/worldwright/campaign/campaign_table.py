"""The table of a campaign: one row a world, flat, for whatever loads Parquet or CSV.

Columns are fixed, but for one `vary.FIELD` a swept field, one `minutes.STEP` a step and, for each expectation, `margin.N.NAME`
(N: its objective, counted from 0) with `measured.N.NAME`; a cell that has nothing to say is empty. Written a stretch at a time:
of all rows, no more is held than each one's place and address.
"""

import secrets
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .world_row import Row

if TYPE_CHECKING:
    import pyarrow

PARQUET, CSV = "table.parquet", "table.csv"
STRETCH = 10_000
TEXTS = (
    "world", "category", "prompt", "outcome", "cause", "cause_step", "cause_said", "interventions",
    "plan_sha256", "program_sha256", "world_sha256", "trajectory_sha256", "environment_sha256", "key",
    "folder", "recording", "report", "poster", "film", "worker", "author", "transcript",
)  # fmt: skip
COUNTS = ("number", "iterations", "runs", "begun", "tokens_read", "tokens_written")
NUMBERS = ("seconds", "margin", "memory_mb", "usd", "author_seconds")


def columns(rows: Iterable[Row]) -> list[str]:
    """The columns that rows differ in: what was swept, minutes, margins, what was measured, each by name."""
    kinds = ("vary.", "minutes.", "margin.", "measured.")
    found: set[str] = set()
    for row in rows:
        found.update(name for name in flat(row) if "." in name)
    return sorted(found, key=lambda name: (next(n for n, kind in enumerate(kinds) if name.startswith(kind)), name))


def flat(row: Row) -> dict[str, Any]:
    """A row as one level of names."""
    cells: dict[str, Any] = {name: getattr(row, name) for name in (*TEXTS, *COUNTS, *NUMBERS) if hasattr(row, name)}
    cells["interventions"] = "; ".join(row.interventions)
    if row.cause is not None:
        cells |= {"cause": row.cause.kind, "cause_step": row.cause.step, "cause_said": row.cause.said}
    else:
        cells["cause"] = ""
    cells |= {f"vary.{name}": value for name, value in row.values.items()}
    cells |= {f"minutes.{name}": value for name, value in row.minutes.items()}
    seen: dict[str, int] = {}
    for margin in row.margins:
        name = f"{margin.objective}.{margin.name}"
        seen[name] = seen.get(name, 0) + 1
        name += f".{seen[name]}" if seen[name] > 1 else ""
        cells |= {f"margin.{name}": margin.margin, f"measured.{name}": margin.measured}
    return cells


def schema_of(differing: list[str]) -> "pyarrow.Schema":
    """The schema of a table with these columns beside the fixed ones."""
    import pyarrow as pa

    return pa.schema(
        [(name, pa.int64()) for name in COUNTS]
        + [(name, pa.string()) for name in TEXTS]
        + [(name, pa.float64()) for name in (*NUMBERS, *differing)]
    )


def of(rows: list[Row]) -> "pyarrow.Table":
    """The table of rows, in memory."""
    import pyarrow as pa

    return pa.Table.from_pylist([flat(row) for row in rows], schema=schema_of(columns(rows)))


def write(rows: Iterable[Row], differing: list[str], folder: Path) -> tuple[Path, Path]:
    """Write `table.parquet` and `table.csv` into a folder, each in one step; returns their paths.

    Two may write at once: each has its own drafts, and the later table stands.

    Args:
        rows: in the order of the table.
        differing: what `columns` says of the same rows.
        folder: where.
    """
    import pyarrow as pa
    import pyarrow.csv
    import pyarrow.parquet

    schema = schema_of(differing)
    parquet, csv = folder / PARQUET, folder / CSV
    own = secrets.token_hex(4)
    drafts = [path.with_name(f".{path.name}.{own}") for path in (parquet, csv)]
    try:
        with (
            pa.parquet.ParquetWriter(drafts[0], schema, compression="zstd") as first,
            pa.csv.CSVWriter(drafts[1], schema) as second,
        ):
            for stretch in _stretches(rows):
                table = pa.Table.from_pylist([flat(row) for row in stretch], schema=schema)
                first.write_table(table)
                second.write_table(table)
        for draft, path in zip(drafts, (parquet, csv), strict=True):
            draft.replace(path)
    finally:
        for draft in drafts:  # what was not put in its place
            draft.unlink(missing_ok=True)
    return parquet, csv


def read(folder: Path) -> "pyarrow.Table":
    """The table that `write` wrote."""
    import pyarrow.parquet

    return pyarrow.parquet.read_table(folder / PARQUET)


def _stretches(rows: Iterable[Row]) -> Iterator[list[Row]]:
    left = iter(rows)
    while stretch := list(islice(left, STRETCH)):
        yield stretch

"""The recordings of a campaign as a data set to train on: Parquet, one file a world, split by the draw's seed.

| path under `trajectories/` | what |
|---|---|
| `split=train/`, `split=validation/`, `split=test/` | `<world>.parquet`: one row a recorded moment, in order |
| `schema.json` | each column's shape, unit and description, by plan; the shares; the columns of every file |

A file has `world`, `number`, `row`, `time` (s), one `vary.FIELD` a swept field, and each chosen column of the recording as a list
of numbers, row-major over its shape. Worlds of one draw share what was drawn, so they are always in one part: the part is a
function of the sweep's seed and the draw's number alone (of a world's address, where nothing is drawn), and no world changes its
part when a campaign grows. Shares are therefore kept on average only. What an earlier call wrote of worlds that are begun again, or
left no recording this time, is taken away; `schema.json` is written last, so that without it the set is not whole.

    import pyarrow.dataset
    train = pyarrow.dataset.dataset("runs/falls/trajectories", partitioning="hive").filter(pyarrow.dataset.field("split") == "train")
"""

import hashlib
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from worldkit.files import write_json

from ..model.errors import RecordingError
from ..model.storage import writing
from .campaign_file import Campaign, CampaignError
from .campaign_store import Store
from .world_row import Row

FOLDER, SCHEMA = "trajectories", "schema.json"
PARTS, SHARES = ("train", "validation", "test"), (0.8, 0.1, 0.1)
COLUMNS = ("qpos", "qvel", "ctrl", "pos", "quat", "energy")
"""Chosen where nobody says which."""
MOST_NUMBERS = 1 << 22
"""Of one column that are written at a time: places in a list are numbers of 32 bits, and a long recording does not fit into memory."""


def part_of(campaign: Campaign, row: Row, shares: tuple[float, float, float] = SHARES) -> str:
    """The part of the data set that a world belongs to."""
    sweep = campaign.sweep
    drawn = sweep is not None and any(axis.drawn for axis in sweep.fields.values())
    said = f"{sweep.seed}\n{row.number % sweep.draws}" if sweep is not None and drawn else row.world
    chance = int.from_bytes(hashlib.sha256(f"split\n{said}".encode()).digest()[:8], "big") / 2**64
    if chance < shares[0]:
        return PARTS[0]
    return PARTS[1] if chance < shares[0] + shares[1] else PARTS[2]


def write(
    store: Store, columns: tuple[str, ...] = COLUMNS, shares: tuple[float, float, float] = SHARES
) -> dict[str, int]:
    """Write the data set beside the table, one world at a time; how many worlds each part has.

    Worlds without a recording, whatever their outcome, are left out; refuted ones are in, since their motion is as real.

    Args:
        store: the campaign's folder.
        columns: of the recording, by the names in `worldengine/recording/columns.py`.
        shares: of train, validation and test; they add up to 1.

    Raises:
        CampaignError: the shares do not add up, a column is none of any recording's, or no world left a recording.
    """
    if not all(share >= 0 for share in shares) or not abs(sum(shares) - 1) <= 1e-9:  # so written, a NaN is refused
        raise CampaignError(
            "the shares of train, validation and test add up to 1", next_move="say for example 0.8 0.1 0.1"
        )
    campaign, folder = store.begun.campaign, store.folder / FOLDER
    counts, told = dict.fromkeys(PARTS, 0), dict[str, dict[str, Any]]()
    with writing("the data set", folder):
        for row in store.rows():
            path = folder / f"split={part_of(campaign, row, shares)}" / f"{row.world}.parquet"
            if row.recording and (shapes := _world(store, row, columns, path)):
                counts[part_of(campaign, row, shares)] += 1
                told.setdefault(row.plan_sha256 if campaign.sweep is None else "sweep", shapes)
            else:
                _take_away(path)
        for path in folder.glob("split=*/*.parquet"):
            kept = store.row(path.stem)  # a draft that was broken off is of no world
            if kept is None or path.parent.name != f"split={part_of(campaign, kept, shares)}":
                _take_away(path)
        if not told:
            raise CampaignError(
                "no world of this campaign left a recording",
                place=str(store.folder),
                next_move="worldwright campaign status",
            )
        about = {"columns": told, "shares": dict(zip(PARTS, shares, strict=True)), "worlds": counts}
        write_json(folder / SCHEMA, about)
    return counts


def _take_away(path: Path) -> None:
    """Delete a file of an earlier call, if there is one; from then on the set is not whole until it is written to its end."""
    if path.is_file() or path.is_symlink():
        (path.parents[1] / SCHEMA).unlink(missing_ok=True)
        path.unlink()


def _world(store: Store, row: Row, columns: tuple[str, ...], path: Path) -> dict[str, Any]:
    """Write one world's file; what its columns are. Nothing is written of a recording that cannot be read."""
    import numpy as np
    import pyarrow as pa
    import pyarrow.parquet

    from worldengine.recording import stored

    try:
        recording = stored.open(store.folder / row.recording)
        known = {column.name: column for column in recording._state.columns.values()}
        if unknown := [name for name in columns if name not in known]:
            raise CampaignError(
                f"a recording has no column `{unknown[0]}`",
                place=row.recording,
                next_move=f"known: {', '.join(name for name in known if name != 'time')}",
            )
        time = np.asarray(recording.time)
        arrays = {name: getattr(recording, name) for name in columns}
        widths = {name: math.prod(array.shape[1:]) for name, array in arrays.items()}
    except (stored.RecordingError, RecordingError):
        return {}
    shapes = {
        name: {"shape": list(known[name].shape), "unit": known[name].unit, "description": known[name].description}
        for name in ("time", *columns)
    }

    def stretch(begin: int, end: int) -> pa.Table:
        cells: dict[str, Any] = {
            "world": pa.array([row.world] * (end - begin), pa.string()),
            "number": pa.array(np.full(end - begin, row.number)),
            "row": pa.array(np.arange(begin, end)),
            "time": pa.array(time[begin:end]),
        }
        cells |= {f"vary.{name}": pa.array(np.full(end - begin, float(value))) for name, value in row.values.items()}
        for name, array in arrays.items():
            ends = np.arange(end - begin + 1, dtype=np.int32) * np.int32(widths[name])
            cells[name] = pa.ListArray.from_arrays(
                pa.array(ends), pa.array(np.ascontiguousarray(array[begin:end]).ravel())
            )
        return pa.table(cells)

    (path.parents[1] / SCHEMA).unlink(missing_ok=True)  # until all of it is written
    path.parent.mkdir(parents=True, exist_ok=True)
    draft = path.with_name(f".{path.name}")
    schema = stretch(0, 0).schema.with_metadata(
        {"worldwright": json.dumps({"outcome": row.outcome, "columns": shapes})}
    )
    with pa.parquet.ParquetWriter(draft, schema, compression="zstd") as writer:
        for begin, end in stretches(len(time), max(widths.values(), default=1)):
            writer.write_table(stretch(begin, end))
    draft.replace(path)
    return shapes


def stretches(rows: int, width: int) -> Iterator[tuple[int, int]]:
    """Stretches of a recording's rows, of which the widest column has so many numbers a row; at least one, an empty one of none."""
    length = max(1, MOST_NUMBERS // max(1, width))
    for begin in range(0, max(1, rows), length):
        yield begin, min(rows, begin + length)

"""The recordings of a campaign as a data set to train on: Parquet, one file a world, split by the draw's seed.

| path under `trajectories/` | what |
|---|---|
| `split=train/`, `split=validation/`, `split=test/` | `<world>.parquet`: one row a recorded moment, in order |
| `schema.json` | each column's shape, unit and description, by plan; the shares; the columns of every file |

A file has `world`, `number`, `row`, `time` (s), one `vary.FIELD` a swept field, and each chosen column of the recording as a list
of numbers, row-major over its shape. Worlds of one draw share what was drawn, so they are always in one part: the part is a
function of the sweep's seed and the draw's number alone (of a world's address, where nothing is drawn), and no world changes its
part when a campaign grows. Shares are therefore kept on average only.

    import pyarrow.dataset
    train = pyarrow.dataset.dataset("runs/falls/trajectories", partitioning="hive").filter(pyarrow.dataset.field("split") == "train")
"""

import hashlib
import json
from pathlib import Path
from typing import Any

from worldkit.files import write_json

from ..model.errors import RecordingError
from ..model.storage import writing
from .campaign_file import Campaign, CampaignError
from .campaign_store import Store
from .world_row import Row

FOLDER = "trajectories"
PARTS, SHARES = ("train", "validation", "test"), (0.8, 0.1, 0.1)
COLUMNS = ("qpos", "qvel", "ctrl", "pos", "quat", "energy")
"""Chosen where nobody says which."""


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
    if min(shares) < 0 or abs(sum(shares) - 1) > 1e-9:
        raise CampaignError(
            "the shares of train, validation and test add up to 1", next_move="say for example 0.8 0.1 0.1"
        )
    campaign, folder = store.begun.campaign, store.folder / FOLDER
    counts, told = dict.fromkeys(PARTS, 0), dict[str, dict[str, Any]]()
    with writing("the data set", folder):
        for row in store.rows():
            if row.recording and (shapes := _world(store, row, columns, folder, part_of(campaign, row, shares))):
                counts[part_of(campaign, row, shares)] += 1
                told.setdefault(row.plan_sha256 if campaign.sweep is None else "sweep", shapes)
        if not told:
            raise CampaignError(
                "no world of this campaign left a recording",
                place=str(store.folder),
                next_move="worldwright campaign status",
            )
        about = {"columns": told, "shares": dict(zip(PARTS, shares, strict=True)), "worlds": counts}
        write_json(folder / "schema.json", about)
    return counts


def _world(store: Store, row: Row, columns: tuple[str, ...], folder: Path, part: str) -> dict[str, Any]:
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
        cells: dict[str, Any] = {
            "world": pa.array([row.world] * len(time)),
            "number": pa.array(np.full(len(time), row.number)),
            "row": pa.array(np.arange(len(time))),
            "time": pa.array(time),
        }
        cells |= {f"vary.{name}": pa.array(np.full(len(time), float(value))) for name, value in row.values.items()}
        for name in columns:
            flat = np.ascontiguousarray(getattr(recording, name)).reshape(len(time), -1)
            ends = np.arange(len(time) + 1, dtype=np.int32) * flat.shape[1]
            cells[name] = pa.ListArray.from_arrays(pa.array(ends), pa.array(flat.reshape(-1)))
    except (stored.RecordingError, RecordingError):
        return {}
    shapes = {
        name: {"shape": list(known[name].shape), "unit": known[name].unit, "description": known[name].description}
        for name in ("time", *columns)
    }
    table = pa.table(cells).replace_schema_metadata(
        {"worldwright": json.dumps({"outcome": row.outcome, "columns": shapes})}
    )
    for other in PARTS:  # the shares were others, the last time
        (folder / f"split={other}" / f"{row.world}.parquet").unlink(missing_ok=True)
    path = folder / f"split={part}" / f"{row.world}.parquet"
    path.parent.mkdir(parents=True, exist_ok=True)
    draft = path.with_name(f".{path.name}")
    pa.parquet.write_table(table, draft, compression="zstd")
    draft.replace(path)
    return shapes

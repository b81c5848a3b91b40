"""An accepted folder whose recorded inputs were forged, and sealed anew, is refused by name."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pyarrow as pa
import pytest

from worldengine.recording.columns import TABLES, arrow_schema
from worldwright.stamp import bundle
from worldwright.stamp import tools as stamp
from worldwright.stamp.statement import Statement

Copy = Callable[[Path], Path]


def table(path: Path, name: str, **columns: list[Any]) -> None:
    """Write one of a recording's tables; columns that are left out are zero."""
    schema = arrow_schema(TABLES[name])
    rows = len(next(iter(columns.values())))
    arrays = [pa.array(columns.get(f.name, [0] * rows), f.type) for f in schema]
    with pa.OSFile(str(path), "wb") as sink, pa.ipc.new_stream(sink, schema) as writer:
        writer.write_batch(pa.RecordBatch.from_arrays(arrays, schema=schema))


def sealed(run: Path) -> None:
    """Seal the accepted folder again as it stands, with nobody's signature."""
    folder = run / "accepted"
    for name in ("stamp.dsse.json", "stamp.pub"):
        (folder / name).unlink(missing_ok=True)
    statement = Statement.model_validate_json((folder / bundle.STAMP).read_bytes())
    bundle.seal(folder, statement.model_copy(update={"subject": bundle.subjects(folder)}))
    (run / "journal.jsonl").unlink()


@pytest.mark.parametrize(
    ("name", "columns", "says"),
    [
        ("inputs", {"step": [0], "entry": [-5], "value": [1.0]}, "row 0 (step 0): its entry is none of"),
        ("inputs", {"step": [1 << 30], "entry": [0], "value": [1.0]}, "row 0 (step 1073741824): its step is none of"),
        ("edits", {"array": ["opt.gravity"], "index": [2], "value": [-1.0]}, "no declared parameter: opt.gravity"),
    ],
)
def test_a_forged_stream_is_refused_by_file_row_and_cause(
    accepted: Path, copy: Copy, name: str, columns: dict[str, list[Any]], says: str
) -> None:
    run = copy(accepted)
    table(run / "accepted" / bundle.WORLD / f"{name}.arrows", name, **columns)
    sealed(run)
    found = stamp.verify(str(run), anybody=True)
    assert not found.ok and found.state == "refuted"
    (failed,) = [c for c in found.checks if not c.ok]
    assert failed.name == "run" and says in failed.detail and f"{name}.arrows" in failed.detail

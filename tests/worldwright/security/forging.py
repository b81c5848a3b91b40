"""What somebody can do who may write the run's folder: change a file, and make every hash that knew it fit again."""

import hashlib
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from worldwright.model.evidence import environment
from worldwright.model.evidence.journal import Journal
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.stamp import bundle
from worldwright.stamp.statement import Statement

Edit = Callable[[Any], Any]


def folder_of(run: Path) -> Path:
    """The evidence folder of the program and plan as they stand."""
    found = Run(run)
    return found.evidence(found.evidence_key(environment.current().sha256()))


def edited(path: Path, edit: Edit) -> None:
    """Read a JSON file, change it, and write it back."""
    path.write_text(json.dumps(edit(json.loads(path.read_bytes()))), encoding="utf-8")


def report(name: str, edit: Edit, *, journal: bool) -> Callable[[Path], None]:
    """Change a report of the evidence; with `journal`, the journal is written anew so that it vouches for it."""

    def touch(run: Path) -> None:
        edited(folder_of(run) / f"{name}.json", edit)
        if journal:
            rewrite(run)

    return touch


def rewrite(run: Path) -> None:
    """Write the journal anew: the same lines, with the hashes of the files as they are now, and a chain that holds."""
    path, evidence = run / "journal.jsonl", folder_of(run)
    entries = [{k: v for k, v in e.items() if k != "chain"} for e in Journal(path).entries()]
    path.unlink()
    for entry in entries:
        if isinstance(entry.get("reports"), dict) and entry.get("key") == evidence.name:
            entry["reports"] = {n: sha256_file(evidence / f"{n}.json") for n in entry["reports"]}
        result = evidence / str(entry.get("stage", "")) / "result.json"
        if entry.get("result_sha256") and entry.get("key") == evidence.name and result.is_file():
            entry["result_sha256"] = sha256_file(result)
        Journal(path).append(entry)


def recording(edit: Callable[[Path], None]) -> Callable[[Path], None]:
    """Change the recording's folder, and make the pass's hashes and the journal fit."""

    def touch(run: Path) -> None:
        physics = folder_of(run) / "physics"
        edit(physics / "trajectory")
        refit(physics)
        rewrite(run)

    return touch


def refit(physics: Path) -> None:
    """Make the hashes in a pass's result those of its files."""
    from worldengine.recording import stored

    def files(result: Any) -> Any:
        result["files"] = {name: sha256_file(physics / name) for name in result["files"] if (physics / name).is_file()}
        result["summary"]["trajectory_sha256"] = stored.digest(stored.open(physics / "trajectory"))
        return result

    sha256 = stored.digest(stored.open(physics / "trajectory"))
    edited(physics / "trajectory" / "complete.json", lambda ending: {**ending, "sha256": sha256})
    edited(physics / "result.json", files)


def rows(name: str, change: Callable[[dict[str, Any]], dict[str, Any]]) -> Callable[[Path], None]:
    """Rewrite a stream of the recording: `change` gets its columns as lists of rows."""
    import pyarrow as pa

    def edit(folder: Path) -> None:
        path = folder / f"{name}.arrows"
        with pa.OSFile(str(path), "rb") as source:
            table = pa.ipc.open_stream(source).read_all()
        columns = change({key: table.column(key).to_pylist() for key in table.column_names})
        made = pa.table({f.name: pa.array(columns[f.name], f.type) for f in table.schema}, schema=table.schema)
        with pa.OSFile(str(path), "wb") as sink, pa.ipc.new_stream(sink, table.schema) as writer:
            writer.write_table(made)

    return edit


def stretched(columns: dict[str, Any], factor: float = 2.1) -> dict[str, Any]:
    """Every body comes so many times as far along x as it did."""
    qpos, pos = columns["qpos"], columns["pos"]
    for rows_ in (qpos, pos):
        start = rows_[0][0]
        for row in rows_:
            row[0] = start + factor * (row[0] - start)
    for name in ("qvel", "linvel"):
        columns[name] = [[factor * row[0], *row[1:]] for row in columns[name]]
    return columns


def resealed(run: Path, edit: Edit | None = None, *, key: str = "none") -> None:
    """Seal the accepted folder anew after a change; sign it with nobody's key, or with a stranger's."""
    folder = run / "accepted"
    statement = Statement.model_validate_json((folder / "stamp.json").read_bytes())
    value = statement.model_dump(mode="json", by_alias=True)
    value = edit(value) if edit else value
    for name in ("stamp.dsse.json", "stamp.pub"):
        (folder / name).unlink(missing_ok=True)
    statement = Statement.model_validate(value)
    bundle.seal(folder, statement.model_copy(update={"subject": bundle.subjects(folder)}))
    (run / "journal.jsonl").unlink(missing_ok=True)
    if key == "stranger":
        from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

        from worldwright.stamp import signing

        signing.sign(folder, "stamp.json", Ed25519PrivateKey.generate())


def table(path: Path, name: str, **columns: list[Any]) -> None:
    """Write one of a recording's tables; columns that are left out are zero."""
    import pyarrow as pa

    from worldengine.recording.columns import TABLES, arrow_schema

    schema = arrow_schema(TABLES[name])
    rows = len(next(iter(columns.values())))
    arrays = [pa.array(columns.get(f.name, [0] * rows), f.type) for f in schema]
    with pa.OSFile(str(path), "wb") as sink, pa.ipc.new_stream(sink, schema) as writer:
        writer.write_batch(pa.RecordBatch.from_arrays(arrays, schema=schema))


def sha256(text: str) -> str:
    """Of a text."""
    return hashlib.sha256(text.encode()).hexdigest()

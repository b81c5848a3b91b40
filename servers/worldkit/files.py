"""Writing files so that a reader, or a crash, never sees half of one."""

import json
import os
import secrets
from pathlib import Path
from typing import Any


def write_atomic(path: Path | str, content: bytes | str) -> None:
    """Replace `path` by `content` in one step (write beside it, flush to disk, rename)."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    data = content.encode() if isinstance(content, str) else content
    temporary = path.parent / f".{path.name}.{secrets.token_hex(4)}"
    # Created with its final mode (less the user's mask): a confined program may not change modes.
    handle = os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o644)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
            stream.flush()
            os.fsync(stream.fileno())
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def json_text(value: Any) -> str:
    """`value` as indented JSON with a final newline; NaN is refused (`ValueError`), since JSON has none."""
    return json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def write_json(path: Path | str, value: Any) -> None:
    """Atomically write `value` as `json_text` has it."""
    write_atomic(path, json_text(value))

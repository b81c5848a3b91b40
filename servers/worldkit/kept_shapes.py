"""Made shapes are kept as files, by what they are made of: `KEY-HASH.npz`, the hash that of the file's own bytes.

An entry that does not have the hash of its name is broken, and two of one key cannot both be right: neither is taken, and the
shape is made anew. Inside the sandbox the shapes of earlier runs lie in folders that can only be read (`GIVEN`); new ones go
where they are thrown away, unless whoever runs the sandbox keeps them.
"""

import contextlib
import hashlib
import io
import os
import secrets
import zipfile
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

FOLDER = "WORLDKIT_SCULPT_CACHE"
"""Environment variable with the folder in which made shapes are kept; else one in the user's cache."""
GIVEN = "WORLDKIT_SCULPT_GIVEN"
"""Environment variable with folders of shapes made earlier, which are only read."""
MOST_KEPT = 200


def folder() -> Path:
    """Where made shapes are kept: `WORLDKIT_SCULPT_CACHE`, else in the user's cache, which a sandbox replaces."""
    named = os.environ.get(FOLDER)
    if named:
        return Path(named)
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "worldwright" / "sculpt"


def kept(key: str) -> "dict[str, np.ndarray] | None":
    """The arrays kept under a key; None where there are none, or what is there is broken."""
    import numpy as np

    given: list[str | Path] = [word for word in os.environ.get(GIVEN, "").split(os.pathsep) if word]
    for place in (*given, folder()):
        for path in _entries(Path(place), key):
            with contextlib.suppress(OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, zlib.error):
                content = path.read_bytes()
                if path.name != name_of(key, content):
                    continue
                with np.load(io.BytesIO(content), allow_pickle=False) as stored:
                    return {name: stored[name] for name in stored.files}
    return None


def keep(key: str, arrays: "dict[str, np.ndarray]") -> None:
    """Store arrays whole or not at all; a folder that cannot be written costs time, not correctness."""
    import numpy as np

    stream = io.BytesIO()
    np.savez_compressed(stream, allow_pickle=False, **arrays)
    content = stream.getvalue()
    with contextlib.suppress(OSError):
        place = folder()
        place.mkdir(parents=True, exist_ok=True)
        old = sorted(place.glob("*.npz"), key=lambda path: path.stat().st_mtime)
        gone = [*old[: max(0, len(old) - MOST_KEPT + 1)], *place.glob(f"{key}-*.npz")]
        for path in gone:
            path.unlink(missing_ok=True)
        part = place / f".{secrets.token_hex(8)}.part"
        part.write_bytes(content)
        part.replace(place / name_of(key, content))


def name_of(key: str, content: bytes) -> str:
    """The name of the file that holds this content under this key."""
    return f"{key}-{hashlib.sha256(content).hexdigest()}.npz"


def _entries(place: Path, key: str) -> Iterator[Path]:
    """The one file under a key in a folder."""
    found = list(place.glob(f"{key}-*.npz"))
    if len(found) == 1:
        yield found[0]

"""The person's data folder, of which an agent may not take the signing key and may write nothing but assets.

It holds the key that signs what is accepted here, the list of the keys that the person calls known, the proofs under way and
what the sandbox's probe found: whoever writes there says what is proved. Only the standard library is imported, for the guard
and the shells that it starts; `worldkit.data_folders` says the same of the folder to the rest of the suite.
"""

from __future__ import annotations

import os
from pathlib import Path

ASSETS, KEY, JUDGED = "assets", "signing-key.pem", "judged"
KNOWN_HERE = "examples/known_keys"
"""The checkout's own list of known keys."""


def folder() -> Path:
    """The data folder, with links resolved; it need not exist."""
    named = os.environ.get("WORLDWRIGHT_DATA")
    above = os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share"
    return Path(os.path.realpath(named or Path(above) / "worldwright"))


def key() -> Path:
    """The signing key's file, with links resolved."""
    return Path(os.path.realpath(folder() / KEY))


def judged() -> Path:
    """Where a benchmark's verdicts lie, with links resolved: who builds reads none."""
    return Path(os.path.realpath(folder() / JUDGED))


def shut(target: Path, project: Path) -> bool:
    """Whether a file, with links resolved, decides whose word counts: no agent writes it."""
    if target == Path(os.path.realpath(project / KNOWN_HERE)) or target == key():
        return True
    return target.is_relative_to(folder()) and not target.is_relative_to(Path(os.path.realpath(folder() / ASSETS)))

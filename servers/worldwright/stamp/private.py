"""Where proof runs and verifications happen: in the user's data folder, outside of every run.

Whoever writes the program also writes the run folder. A proof kept there could be forged beforehand, and acceptance,
which continues a proof that was begun, would accept the forgery. Nor can an agent's shell in a harness write there
(`contract/users_data.py`): what it verifies begins anew, in a folder of its own (`verification`).
"""

import hashlib
import tempfile
from pathlib import Path

from ..model.evidence.run import Run
from ..model.storage import writing
from .keyring import folder


def proofs(run: Run, key: str) -> Path:
    """The folder for the proof of one run and one key, made if it is not there; nobody else may look into it.

    Raises:
        StorageError: the data folder cannot be written.
    """
    identity = hashlib.sha256(f"{run.folder.resolve()}\n{key}".encode()).hexdigest()[:24]
    path = folder() / "proofs" / identity
    with writing("the proof", path):
        path.mkdir(mode=0o700, parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path):  # one that is there already may yet be shut to this process
            pass
    return path

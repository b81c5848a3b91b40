"""What the process of a live world saw of its drive, kept in its memory: by this alone it signs, and nobody signs later.

Whoever finds the folder afterwards can have another story in it, events that another hand wrote, rows of another drive. A replay
tells that the motion follows from the stream; only who was there can tell that this was the stream, and who sent it.
"""

import hashlib
import json
import time
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from ..model.evidence.run import sha256_file
from .drive_folder import BEGUN, EVENTS, LISTED, LIVE


class Witness:
    """Writes down who came, drove and left, and remembers every file as it was left.

    Args:
        folder: of the drive.
        files: SHA-256 of what it began with, by name.
        doubt: why it vouches for nothing, known before the first step.
    """

    def __init__(self, folder: Path, files: Mapping[str, str], doubt: str = "") -> None:
        self.folder, self._doubt = folder, doubt
        self._saw = {**files, BEGUN: sha256_file(folder / BEGUN)}
        self._events = hashlib.sha256()
        self._log = (folder / EVENTS).open("xb", buffering=0)
        self._length = 0
        self._whole = False

    def note(self, what: str, more: Mapping[str, Any]) -> None:
        """Add a line to the events; an `OSError` where the disk is full, a `ValueError` when nothing is noted any more."""
        line = json.dumps({"at": round(time.time(), 3), "what": what, **more}).encode() + b"\n"
        try:
            rest = memoryview(line)
            while rest:
                rest = rest[self._log.write(rest) :]
        except OSError:
            with suppress(OSError):  # half a line is no word of ours: what was noted before, and after, still counts
                self._log.truncate(self._length)
                self._log.seek(self._length)
            raise
        self._length += len(line)
        self._events.update(line)

    def ended(self) -> None:
        """Remember what was recorded, at the moment that the engine's process has ended."""
        if self._whole:
            return
        with suppress(OSError):  # then nothing is vouched for
            for name in LISTED:
                if name.startswith(f"{LIVE}/") and (self.folder / name).is_file():
                    self._saw[name] = sha256_file(self.folder / name)
            self._whole = True

    def close(self) -> None:
        """Note nothing any more."""
        with suppress(OSError):
            self._log.close()

    def contradicts(self, stated: Mapping[str, str]) -> str:
        """Why this process cannot sign a statement that lists these files by SHA-256; empty where it saw the same."""
        self.close()
        if self._doubt:
            return self._doubt
        if not self._whole:
            return "it did not see its end"
        saw = {**self._saw, EVENTS: self._events.hexdigest()}
        seen = {name for name in stated if name.startswith(f"{LIVE}/")}.union(saw)
        other = [name for name in sorted(seen) if stated.get(name) != saw.get(name)]
        return f"{', '.join(other)} is not what it left" if other else ""

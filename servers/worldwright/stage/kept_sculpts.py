"""What was sculpted in the sandbox, kept outside it by the program that made it, and given back to be read only.

A process of an author can fill only the place of exactly the sources that ran in it: their names and contents. So no program
can leave anything for another one, and what a sculpted file makes (`sculpting_step`) is made by that file and what it reads alone. What
lies here was written by a program and is opened in the sandbox only; its hash is in its name.
"""

import contextlib
import hashlib
import json
import os
import re
import shutil
import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from worldkit.files import write_atomic
from worldkit.sculpt import keeping

from ..model import companions
from ..model.evidence.file_hashes import cache_folder
from . import plain

NAME = re.compile(r"([0-9a-f]{24})-[0-9a-f]{64}\.npz")
MOST_PLACES, MOST_ENTRIES = 100, 64
MOST_BYTES = 128 << 20


@dataclass(frozen=True)
class Given:
    """The kept shapes of one author's process: the places it may read, and the one that it fills."""

    places: tuple[Path, ...]
    own: Path

    def variables(self, scratch: Path) -> dict[str, str]:
        """Environment variables of the process, whose new shapes go below its scratch folder."""
        there = [str(path) for path in self.places if path.is_dir()]
        return {keeping.FOLDER: str(scratch / "sculpt"), keeping.GIVEN: os.pathsep.join(there)}

    def keep(self, scratch: Path) -> tuple[str, ...]:
        """Keep what the process made anew, once it has ended; returns the names of the entries."""
        kept = []
        with contextlib.suppress(OSError):
            for path in sorted((scratch / "sculpt").glob("*.npz"))[:MOST_ENTRIES]:
                match = NAME.fullmatch(path.name)
                content = plain.read(path, MOST_BYTES) if match else None
                if match is None or content is None or path.name != keeping.name_of(match[1], content):
                    continue
                for old in self.own.glob(f"{match[1]}-*.npz"):
                    old.unlink(missing_ok=True)
                write_atomic(self.own / path.name, content)
                kept.append(path.name)
        if kept:
            _tidy()
        return tuple(kept)


def given(files: Mapping[str, bytes]) -> Given:
    """The kept shapes of a process that runs these files, by path relative to the run folder.

    Besides those of the whole, it may read those of each file alone with what that reads.
    """
    helpers = [name for name in files if name.endswith(".py") and Path(name).name not in companions.OURS]
    own = place_of(files)
    alone = []
    if helpers:
        with tempfile.TemporaryDirectory(prefix="worldwright-sculpt-") as folder:
            for name, content in files.items():
                write_atomic(Path(folder) / name, content)
            alone = [place_of(needed(Path(folder), name)) for name in helpers]
    return Given(tuple(dict.fromkeys((own, *alone))), own)


def of_files(program: Path, paths: Iterable[Path]) -> Given:
    """`given` for a program and files beside it that its process may read, others left out."""
    files = {}
    for path in {program, *paths}:
        with contextlib.suppress(ValueError, OSError):
            files[path.relative_to(program.parent).as_posix()] = path.read_bytes()
    return given(files)


def needed(root: Path, file: str) -> dict[str, bytes]:
    """A file of a run and all that it reads there, by path relative to the run folder."""
    return {file: (root / file).read_bytes(), **companions.of(root / file, root)}


def place_of(files: Mapping[str, bytes]) -> Path:
    """Where shapes are kept that a process with exactly these files made."""
    told = json.dumps(sorted((name, hashlib.sha256(content).hexdigest()) for name, content in files.items()))
    return cache_folder() / "sculpts" / hashlib.sha256(told.encode()).hexdigest()


def _tidy() -> None:
    """Drop the places that were filled longest ago."""
    with contextlib.suppress(OSError):
        places = sorted((cache_folder() / "sculpts").iterdir(), key=lambda path: path.stat().st_mtime)
        for path in places[: max(0, len(places) - MOST_PLACES)]:
            shutil.rmtree(path, ignore_errors=True)

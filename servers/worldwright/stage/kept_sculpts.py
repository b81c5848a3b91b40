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
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from worldkit import kept_shapes
from worldkit.files import write_atomic

from ..model import companions
from ..model.evidence.file_hashes import cache_folder
from . import plain

NAME = re.compile(r"([0-9a-f]{24})-[0-9a-f]{64}\.npz")
MOST_PLACES, MOST_ENTRIES = 100, 64
MOST_BYTES, MOST_IN_PLACE, MOST_IN_ALL = 128 << 20, 256 << 20, 2 << 30


@dataclass(frozen=True)
class Given:
    """The kept shapes of one author's process: the places it may read, and the one that it fills."""

    places: tuple[Path, ...] = ()
    own: Path | None = None

    def variables(self, scratch: Path) -> dict[str, str]:
        """Environment variables of the process, whose new shapes go below its scratch folder; its places count as just used."""
        there = [path for path in self.places if path.is_dir()]
        for path in there:
            with contextlib.suppress(OSError):
                os.utime(path)
        return {kept_shapes.FOLDER: str(scratch / "sculpt"), kept_shapes.GIVEN: os.pathsep.join(map(str, there))}

    def keep(self, scratch: Path) -> tuple[str, ...]:
        """Keep what the process made anew, once it has ended; returns the names of the entries."""
        kept: list[str] = []
        if self.own is None:
            return ()
        with contextlib.suppress(OSError):
            for path in sorted((scratch / "sculpt").glob("*.npz"))[:MOST_ENTRIES]:
                match = NAME.fullmatch(path.name)
                content = plain.read(path, MOST_BYTES) if match else None
                if match is None or content is None or path.name != kept_shapes.name_of(match[1], content):
                    continue
                if plain.read(self.own / path.name, MOST_BYTES) != content:  # others may be reading it
                    write_atomic(self.own / path.name, content)
                for old in self.own.glob(f"{match[1]}-*.npz"):
                    if old.name != path.name:
                        old.unlink(missing_ok=True)
                kept.append(path.name)
        if kept:
            _tidy()
        return tuple(kept)


NOTHING = Given()
"""For a process that makes every shape anew, and whose shapes nobody else is given."""


SCULPTING = (b"sculpt", b"vehicles")


def given(files: Mapping[str, bytes]) -> Given:
    """The kept shapes of a process that runs these files, by path relative to the run folder.

    Besides those of the whole, it may read those of each file alone with what that reads.
    """
    own, alone = place_of(files), []
    if _sculpts(files):
        for name in files:
            if name.endswith(".py") and Path(name).name not in companions.OURS:
                needs = {name: files[name], **companions.among(files, name)}
                alone += [place_of(needs)] if _sculpts(needs) else []
    return Given(tuple(dict.fromkeys((own, *alone))), own)


def _sculpts(files: Mapping[str, bytes]) -> bool:
    """Whether one of these may import `worldkit.sculpt`, or what draws by it: none that does lacks the word."""
    return any(word in content for name, content in files.items() if name.endswith(".py") for word in SCULPTING)


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
    """Leave the places that were used last, as many as may be and as have so many bytes; of each, its newest entries.

    A place goes whole: half of one would be filled again by the next look at its plan, at the cost of another place.
    """
    left = MOST_IN_ALL
    for number, (_, path) in enumerate(sorted(_used(), reverse=True)):
        with contextlib.suppress(OSError):  # others tidy beside
            left -= _trim(path, MOST_IN_PLACE) if number < MOST_PLACES else 0
            if number >= MOST_PLACES or left < 0:
                shutil.rmtree(path, ignore_errors=True)


def _used() -> Iterator[tuple[int, Path]]:
    """Each place, and when it was used last, ns."""
    with contextlib.suppress(OSError):
        for path in (cache_folder() / "sculpts").iterdir():
            with contextlib.suppress(OSError):
                yield path.stat().st_mtime_ns, path


def _trim(place: Path, most: int) -> int:
    """Leave the newest entries of a place, as many as have so many bytes; returns how many bytes are left."""
    kept, before = 0, place.stat()
    for path, state in sorted(
        ((path, path.stat()) for path in place.glob("*.npz")), key=lambda one: -one[1].st_mtime_ns
    ):
        if kept + state.st_size > most:
            most = kept  # nor what is older and smaller
            path.unlink(missing_ok=True)
        else:
            kept += state.st_size
    os.utime(place, ns=(before.st_atime_ns, before.st_mtime_ns))  # to be trimmed is no use of it
    return kept

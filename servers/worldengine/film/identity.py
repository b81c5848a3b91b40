"""Identify what pictures depend on besides the recording: the film's code, the renderer, and the packages of both."""

import hashlib
import json
import os
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import worldkit
from worldkit import listings

from . import renderers

PACKAGES = ("av", "opencv-python-headless")
"""Packages that encode and scale pictures, whichever renderer draws them."""

DRAWN_FROM = (
    "cameras/**/*.py", "filming/**/*.py", "materials/**/*.py", "settings.py", "lights.py", "model_text.py", "turning.py", "forms/lattice.py",
    "laws.py", "moved_shapes.py", "in_pieces.py",
)  # fmt: skip
"""What of `worldkit` decides how a recorded world looks when it is drawn, and from where."""
REPLAYED_BY = (
    "recording/seen.py",
    "recording/replay.py",
    "recording/lain.py",
    "recording/long_table.py",
    "recording/point_colours.py",
    "inputs/declared_media.py",
)
"""What of the engine decides what is shown at which time, and where an author's laws are drawn."""


@dataclass(frozen=True)
class Identity:
    """Two films of the same identity and recording are the same."""

    renderer: str
    """Name of the wanted renderer."""
    version: str
    packages: dict[str, str]
    """Version by distribution name."""
    sha256: str
    """The hash of all this and of the code."""


def identity(renderer: str = "") -> Identity:
    """The identity of the films that would be made now.

    Args:
        renderer: a renderer other than the wanted one (`WORLDKIT_RENDERER`).

    Raises:
        SeamError: there is no such renderer.
    """
    name = renderer or renderers.wanted()
    packages = renderers.installed((*PACKAGES, *renderers.SEAM.find(name).PACKAGES))
    code = _code(name)
    digest = hashlib.sha256(json.dumps([name, packages]).encode())
    digest.update(code.encode())
    return Identity(name, _version(name, code), packages, digest.hexdigest())


def renderer_version(name: str) -> str:
    """A renderer's version: its packages' versions, and the beginning of the SHA-256 of all code that its pictures depend on."""
    return _version(name, _code(name))


def _version(name: str, code: str) -> str:
    said = [
        f"{package} {number}" for package, number in renderers.installed(renderers.SEAM.find(name).PACKAGES).items()
    ]
    return ", ".join([*said, f"code {code[:12]}"])


def _code(name: str) -> str:
    """The hash of the film's code, of what it takes from `worldkit` when it draws, of a renderer, and of all plainer ones, which
    it draws on, and which may take over from it."""
    film, kit = Path(__file__).parent, Path(worldkit.__file__ or "").parent
    # Plain texts: each step of a run asks this of some hundred files.
    own = listings.files(str(film), ("*.py",), deep=False)
    for drawn_from in DRAWN_FROM:
        folder, everything, _ = drawn_from.partition("/**/")
        own += listings.files(str(kit / folder), ("*.py",)) if everything else [str(kit / folder)]
    own += [renderers.__file__ or "", *(str(film.parent / name) for name in REPLAYED_BY)]
    drawn: list[str] = []
    while name:
        drawn += map(str, renderers.SEAM.files(name))
        name = renderers.plainer(name)
    files = tuple(dict.fromkeys([*sorted(own), *drawn]))
    return _hash(tuple((p, s.st_size, s.st_mtime_ns) for p, s in zip(files, map(os.stat, files), strict=True)))


@lru_cache(maxsize=32)
def _hash(files: tuple[tuple[str, int, int], ...]) -> str:
    """One hash over names and contents, read anew when a file's size or time changes."""
    digest = hashlib.sha256()
    for name, *_ in files:
        path = Path(name)
        digest.update(path.name.encode() + b"\0" + hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()

"""Identify what pictures depend on besides the recording: the film's code, the renderer, and the packages of both."""

import hashlib
import json
from dataclasses import dataclass
from pathlib import Path

from worldkit import filming

from . import renderers

PACKAGES = ("av", "opencv-python-headless")
"""Packages that encode and scale pictures, whichever renderer draws them."""


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
    own = [*Path(__file__).parent.glob("*.py"), *Path(filming.__file__ or "").parent.rglob("*.py")]
    own.append(Path(renderers.__file__ or ""))
    # Plainer renderers may take over from any other, so they count for it.
    drawn: list[Path] = []
    one = name
    while one:
        drawn += renderers.SEAM.files(one)
        one = renderers.plainer(one)
    digest = hashlib.sha256(json.dumps([name, packages]).encode())
    for path in dict.fromkeys([*sorted(own), *drawn]):
        digest.update(path.name.encode() + b"\0" + hashlib.sha256(path.read_bytes()).digest())
    return Identity(name, renderer_version(name), packages, digest.hexdigest())


def renderer_version(name: str) -> str:
    """A renderer's version: its packages' versions, and the beginning of the SHA-256 of its own code."""
    digest = hashlib.sha256()
    for path in renderers.SEAM.files(name):
        digest.update(path.name.encode() + b"\0" + hashlib.sha256(path.read_bytes()).digest())
    said = [
        f"{package} {number}" for package, number in renderers.installed(renderers.SEAM.find(name).PACKAGES).items()
    ]
    return ", ".join([*said, f"code {digest.hexdigest()[:12]}"])

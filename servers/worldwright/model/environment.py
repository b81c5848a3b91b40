"""The environment contract: what a run depends on besides its program and plan, read without importing any of it.

Versions come from the installed metadata and hashes from the files on disk, so that asking costs milliseconds and a
server can name an evidence key without loading the simulator.
"""

import contextlib
import hashlib
import json
import os
import platform
import sys
from functools import lru_cache
from importlib.metadata import PackageNotFoundError, distribution, version
from pathlib import Path

from worldkit.files import write_json

from .evidence import Environment

PACKAGES = ("mujoco", "mujoco-core", "numpy", "pyarrow", "av", "opencv-python-headless", "worldwright")
"""Everything that can change a trajectory or a picture."""


def cache_folder() -> Path:
    """Where this machine keeps what can always be made again: `WORLDWRIGHT_CACHE`, else the user's cache folder."""
    override = os.environ.get("WORLDWRIGHT_CACHE")
    if override:
        return Path(override)
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "worldwright"


def current() -> Environment:
    """The environment a pass would run in now. Hashes are cached by the size and time of every file behind them."""
    simulator = _simulator()
    worldkit = _files(Path(__file__).parents[2] / "worldkit", ("*.py", "*.vert", "*.frag", "*.glsl"))
    catalog = _files(_catalog(), ("*.yaml", "*.obj", "*.png"))
    return Environment(
        python=platform.python_version(),
        machine=f"{platform.system()}-{platform.machine()}",
        packages={name: found for name in PACKAGES if (found := _version(name))},
        simulator_sha256=_hash("simulator", simulator),
        worldkit_sha256=_hash("worldkit", worldkit),
        catalog_sha256=_hash("catalog", catalog),
    )


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return ""


@lru_cache
def _simulator() -> tuple[tuple[Path, str], ...]:
    """The engine's shared library."""
    for name in ("mujoco-core", "mujoco"):
        try:
            files = distribution(name).files or []
        except PackageNotFoundError:
            continue
        found = [f for f in files if f.name.startswith("libmujoco") or f.name == "mujoco.dll"]
        if found:
            return tuple((Path(str(f.locate())), f.name) for f in found)
    return ()


def _catalog() -> Path:
    from worldkit import assets

    return Path(assets.catalog_root())


def _files(root: Path, patterns: tuple[str, ...]) -> tuple[tuple[Path, str], ...]:
    """Matching files below a folder with their relative names, in a fixed order; thumbnails decide nothing."""
    found = sorted({path for pattern in patterns for path in root.rglob(pattern) if path.name != "thumbnail.png"})
    return tuple((path, path.relative_to(root).as_posix()) for path in found)


def _hash(name: str, files: tuple[tuple[Path, str], ...]) -> str:
    """SHA-256 over names and contents, remembered as long as no file's size or modification time changes."""
    stats = [(str(p), s.st_size, s.st_mtime_ns) for p, _ in files for s in (p.stat(),)]
    stamp = hashlib.sha256(json.dumps([sys.version, stats]).encode()).hexdigest()
    kept = cache_folder() / f"hash-{name}.json"
    try:
        known = json.loads(kept.read_text(encoding="utf-8"))
        if known["stamp"] == stamp:
            return str(known["sha256"])
    except (OSError, ValueError, KeyError, TypeError):
        pass
    digest = hashlib.sha256()
    for path, relative in files:
        digest.update(relative.encode() + b"\0" + hashlib.sha256(path.read_bytes()).digest())
    with contextlib.suppress(OSError):  # a read-only home costs time, not correctness
        write_json(kept, {"stamp": stamp, "sha256": digest.hexdigest()})
    return digest.hexdigest()

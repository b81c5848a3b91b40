"""Find the installed simulator and its version without importing it."""

import importlib.metadata
import importlib.util
from functools import cache
from pathlib import Path

from ..model.errors import NotFoundError


@cache
def package_folder() -> Path:
    """The folder of the `mujoco` package."""
    spec = importlib.util.find_spec("mujoco")
    if spec is None or not spec.submodule_search_locations:
        raise NotFoundError(
            "the simulator is not installed in this Python", place="mujoco", next_move="pip install 'mujoco>=4.0,<5'"
        )
    folders = [Path(folder) for folder in spec.submodule_search_locations]
    return next((folder for folder in folders if (folder / "__init__.py").is_file()), folders[0])


@cache
def version() -> str:
    """Its version, e.g. `4.0.0`."""
    try:
        return importlib.metadata.version("mujoco")
    except importlib.metadata.PackageNotFoundError:
        return "unknown"


def manual_folder() -> Path:
    """The manual that ships inside the package (`doc/`); it may be absent in other builds."""
    return package_folder() / "doc"


def fingerprint() -> str:
    """The identity of the installed build: version, and size and time of the files from which tables are made."""
    parts = [version(), str(package_folder())]
    for path in sorted(package_folder().glob("*.so*")) + sorted(package_folder().glob("*.pyd")):
        stat = path.stat()
        parts.append(f"{path.name}:{stat.st_size}:{stat.st_mtime_ns}")
    for name in ("XMLschema.rst", "XMLreference.rst", "changelog.rst"):
        path = manual_folder() / name
        if path.is_file():
            stat = path.stat()
            parts.append(f"{name}:{stat.st_size}:{stat.st_mtime_ns}")
    return "\n".join(parts)

"""The environment contract: what evidence depends on besides a run's program and plan, read without importing any of it.

Each kind of evidence depends on what made it, and on no more. A recording, and all that is measured on it, depends on the
interpreter, the machine, the packages that compute, the engine, and the code that builds, steps and records. Pictures
depend on the recording, the film's code and the renderer (`film`). The assets that a world uses are part of its own key
(`assets_used`). So a shader may change, or an asset be added, and every recording stands.

Versions come from the installed metadata and hashes from the files on disk, so that asking costs milliseconds and a
server can name an evidence key without loading the simulator.
"""

import platform
from functools import cache, lru_cache
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from worldkit import wheels
from worldkit.errors import SeamError

from ..errors import NotFoundError
from .file_hashes import Named, below, sha256_of
from .reports import Environment, Film

PACKAGES = ("mujoco", "mujoco-core", "numpy", "pyarrow", "opencv-python-headless", "worldwright")
"""Everything installed that can change a trajectory."""
SOURCES = ("*.py", "*.vert", "*.frag", "*.glsl")
SERVERS = Path(__file__).parents[3]
FILM = ("worldengine/film/", "worldkit/filming/")
"""What only pictures depend on."""
BESIDE = ("worldkit/intake/",)
"""What no world runs: an asset's own files are part of the key of each world that uses it."""


def current() -> Environment:
    """The environment in which a pass would run now; it is the same for all worlds, since it holds no world's assets."""
    return Environment(
        python=platform.python_version(),
        machine=f"{platform.system()}-{platform.machine()}",
        packages={name: found for name in PACKAGES if (found := wheels.version(name))},
        simulator_sha256=sha256_of("simulator", _simulator()),
        worldkit_sha256=sha256_of("worldkit", physics_code(SERVERS)),
    )


def physics_code(servers: Path) -> Named:
    """The hash of the code that builds, steps and records a world: worldkit, and worldengine without what only films."""
    found = (
        (path, f"{name}/{own}") for name in ("worldkit", "worldengine") for path, own in below(servers / name, SOURCES)
    )
    return tuple((path, name) for path, name in found if not name.startswith((*FILM, *BESIDE)))


def film(renderer: str = "") -> Film:
    """The film that pictures would be made with now, by a renderer other than the wanted one if it is named.

    Raises:
        NotFoundError: there is no such renderer as `WORLDKIT_RENDERER` names.
    """
    from worldengine.film.identity import identity

    try:
        found = identity(renderer)
    except SeamError as cause:
        raise NotFoundError(cause.cause, place=cause.place, next_move=cause.next_move) from cause
    return Film(renderer=found.renderer, version=found.version, packages=found.packages, sha256=found.sha256)


@cache
def checks() -> str:
    """The hash of the code that measures a recording, asked once a process, as that code is loaded once.

    It is no part of the environment's own hash: the code of a check may change, and every recording stands. What was found
    in one is found anew (`scan.json`, `expect.json`).
    """
    return sha256_of("checks", below(SERVERS / "worldwright" / "scan"))


@lru_cache
def _simulator() -> Named:
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

"""What a job may see and use, whatever level enforces it."""

import os
import sys
import sysconfig
from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True)
class Confinement:
    """The folders and limits of one job."""

    out: Path
    """The one folder the job may write."""
    reads: tuple[Path, ...]
    """Job-specific files and folders it may read (its snapshot, a recording)."""
    scratch: Path
    """A throw-away folder for temporary files."""
    cpu_s: int
    file_bytes: int
    memory_bytes: int
    """Address-space backstop; resident memory is watched by the supervisor."""
    processes: int = 256
    environment: dict[str, str] = field(default_factory=dict)


def runtime_paths() -> tuple[Path, ...]:
    """What any program needs to read: the interpreter, the environment's packages, worldkit and its catalog."""
    import worldkit
    from worldkit import assets

    paths = [Path(sys.prefix), Path(sys.base_prefix), Path(sysconfig.get_path("purelib"))]
    paths += [Path(sys.executable).resolve().parent.parent]
    # An environment may borrow another's packages (a .pth file, or the system's).
    paths += [path for path in map(Path, sys.path) if path.name in ("site-packages", "dist-packages")]
    paths += [Path(next(iter(worldkit.__path__))), Path(assets.catalog_root())]
    return tuple(dict.fromkeys(p.absolute() for p in paths if p.exists()))


def environment(scratch: str) -> dict[str, str]:
    """The environment variables of a job: nothing of the user's but the choice of renderer."""
    # One thread for linear algebra: a sum split between threads is not the same sum.
    keep = {
        k: v
        for k, v in os.environ.items()
        if k in ("WORLDKIT_RENDERER", "WORLDWRIGHT_CATALOG", "NVIDIA_VISIBLE_DEVICES")
    }
    return {
        **keep,
        "PATH": os.defpath,
        "HOME": scratch,
        "TMPDIR": scratch,
        "XDG_CACHE_HOME": scratch,
        "LANG": "C.UTF-8",
        "MUJOCO_GL": gl_backend(),
        "PYTHONDONTWRITEBYTECODE": "1",
        "PYTHONHASHSEED": "0",
        "PYTHONUNBUFFERED": "1",
        "PYTHONPATH": str(Path(__file__).parents[3]),
        "OMP_NUM_THREADS": "1",
        "OPENBLAS_NUM_THREADS": "1",
    }


def gl_backend() -> str:
    """`MUJOCO_GL` if the user set it, else EGL when its library is here, else OSMesa."""
    import ctypes.util

    chosen = os.environ.get("MUJOCO_GL", "")
    if chosen in ("egl", "osmesa"):
        return chosen
    return "egl" if ctypes.util.find_library("EGL") else "osmesa"

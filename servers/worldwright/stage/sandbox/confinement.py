"""The folders and limits of a job, whatever level enforces them."""

import os
import sys
import sysconfig
from dataclasses import dataclass, field
from pathlib import Path

SYSTEM = (
    "/usr",
    "/bin",
    "/sbin",
    "/lib",
    "/lib32",
    "/lib64",
    "/etc/ld.so.cache",
    "/etc/ld.so.conf",
    "/etc/alternatives",
    "/etc/glvnd",
    "/etc/vulkan",
    "/etc/fonts",
    "/etc/OpenCL",
    "/etc/localtime",
)
"""Parts of the system that any job may read: programs and libraries; what it may know of the devices, `host_facts` says."""


def processes() -> int:
    """The most processes of one job that may live at once: enough to draw on every core, too few to hurt."""
    return 64 + 4 * (os.cpu_count() or 1)


def threads() -> int:
    """The most threads in all its processes together; each software renderer starts a little more than one per core."""
    return 512 + 64 * (os.cpu_count() or 1)


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
    token: int = 0
    """A number that every process of the job carries as a resource limit it cannot change, so that none is lost."""
    processes: int = field(default_factory=processes)
    threads: int = field(default_factory=threads)
    shared_bytes: int = 256 << 20
    """Size of the shared memory (`/dev/shm`) if the level gives the job one of its own."""
    environment: dict[str, str] = field(default_factory=dict)


def runtime_paths() -> tuple[Path, ...]:
    """Paths that any program reads: the interpreter, the environment's packages, worldkit, worldengine, the catalog and,
    where they do not hold the user's data folder, the user's own assets."""
    import worldengine
    import worldkit
    from worldkit.data_folders import catalog_root, data_root, own_root

    paths = [Path(sys.prefix), Path(sys.base_prefix), Path(sysconfig.get_path("purelib"))]
    paths += [Path(sys.executable).resolve().parent.parent]
    # An environment may borrow another's packages (a .pth file, or the system's).
    paths += [path for path in map(Path, sys.path) if path.name in ("site-packages", "dist-packages")]
    paths += [Path(next(iter(package.__path__))) for package in (worldkit, worldengine)]
    paths += [Path(catalog_root())]
    if not data_root().resolve().is_relative_to(own_root().resolve()):  # the signing key lies in there
        paths += [own_root()]
    own = (
        Path("/"),
        Path.home(),
        Path("/home"),
        Path("/root"),
    )  # never a whole home
    return tuple(dict.fromkeys(p for path in paths if path.exists() and (p := path.absolute()) not in own))


def devices() -> list[Path]:
    """Graphics devices, when the machine has some."""
    return [path for path in (Path("/dev/dri"), *sorted(Path("/dev").glob("nvidia*"))) if path.exists()]


def environment(scratch: str, lock: str = "") -> dict[str, str]:
    """The environment variables of a job: of the user's own only the choice of renderer, and the lock."""
    from worldkit.data_folders import own_root

    # One thread for linear algebra: a sum split between threads is not the same sum.
    keep = {
        k: v
        for k, v in os.environ.items()
        if k in ("WORLDKIT_RENDERER", "WORLDWRIGHT_CATALOG", "NVIDIA_VISIBLE_DEVICES")
    }
    return {
        **keep,
        "WORLDWRIGHT_ASSETS": str(own_root().absolute()),
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
        "WORLDKIT_LOCK": lock,
    }


def gl_backend() -> str:
    """`MUJOCO_GL` if the user set it, else EGL when its library is here, else OSMesa."""
    import ctypes.util

    chosen = os.environ.get("MUJOCO_GL", "")
    if chosen in ("egl", "osmesa"):
        return chosen
    return "egl" if ctypes.util.find_library("EGL") else "osmesa"

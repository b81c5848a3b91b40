"""bubblewrap: own namespaces for processes, network, users and files; the job sees what it needs and writes one folder.

Source: bwrap(1). `--remount-ro /` matters: the new root is a writable tmpfs otherwise, where stray writes seem to
succeed and vanish.
"""

import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

from . import rlimits
from .confinement import Confinement, runtime_paths

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
)
GRAPHICS = ("/etc/glvnd", "/etc/vulkan", "/etc/fonts", "/etc/OpenCL", "/sys/dev", "/sys/devices", "/sys/class")


def unusable() -> str:
    """Why this level does not work here; empty when a confined `true` really ran."""
    program = shutil.which("bwrap")
    if program is None:
        return "bwrap is not installed"
    probe = [program, "--unshare-all", "--die-with-parent", *_system(), "--proc", "/proc", "--dev", "/dev", "true"]
    try:
        done = subprocess.run(probe, capture_output=True, text=True, timeout=20, check=False)
    except (OSError, subprocess.SubprocessError) as cause:
        return str(cause)
    return "" if done.returncode == 0 else done.stderr.strip() or f"bwrap ended with status {done.returncode}"


def command(call: list[str], confinement: Confinement) -> list[str]:
    """The call inside its own namespaces."""
    reads = [*runtime_paths(), *confinement.reads]
    binds = [word for path in _outermost(reads) for word in ("--ro-bind", str(path), str(path))]
    variables = [word for name, value in confinement.environment.items() for word in ("--setenv", name, value)]
    return [
        shutil.which("bwrap") or "bwrap",
        *("--unshare-all", "--die-with-parent", "--new-session", "--clearenv", "--cap-drop", "ALL"),
        *_system(),
        *("--proc", "/proc", "--dev", "/dev"),
        *_devices(),
        *binds,
        *("--bind", str(confinement.scratch), str(confinement.scratch)),
        *("--bind", str(confinement.out), str(confinement.out)),
        *("--remount-ro", "/", "--chdir", str(confinement.out)),
        *variables,
        "--",
        *call,
    ]


def before_exec(confinement: Confinement) -> Callable[[], None]:
    """The resource limits are inherited through the namespaces."""
    return rlimits.before_exec(confinement)


def _system() -> list[str]:
    """System folders, read-only; those that are links stay links."""
    words: list[str] = []
    for name in (*SYSTEM, *GRAPHICS):
        path = Path(name)
        if path.is_symlink():
            words += ["--symlink", str(path.readlink()), name]
        elif path.exists():
            words += ["--ro-bind", name, name]
    return words


def _devices() -> list[str]:
    """Graphics devices, when the machine has some."""
    found = [Path("/dev/dri"), *sorted(Path("/dev").glob("nvidia*"))]
    return [word for path in found if path.exists() for word in ("--dev-bind", str(path), str(path))]


def _outermost(paths: list[Path]) -> list[Path]:
    """Drop what lies inside the system's own folders; a bind over a bind in another order would hide it."""
    kept = dict.fromkeys(path.absolute() for path in paths)
    return [path for path in kept if not str(path).startswith("/usr/") and str(path) != "/usr"]

"""bubblewrap: a job gets namespaces of its own for processes, network, users and files, sees what it needs and writes one
folder.

Source: bwrap(1). `--remount-ro /` matters: the new root is a writable tmpfs otherwise, where stray writes seem to
succeed and vanish.
"""

import shutil
import subprocess
from collections.abc import Callable, Iterable
from pathlib import Path

from . import host_facts, rlimits, seccomp
from .confinement import SYSTEM, Confinement, devices, runtime_paths

SETTINGS = ("/proc/sys", "/proc/sysrq-trigger", "/proc/irq", "/proc/fs", "/proc/acpi")


def unavailable() -> str:
    """Why this level cannot be tried here; empty when it can."""
    return seccomp.unavailable() or ("" if shutil.which("bwrap") else "bwrap is not installed")


def command(call: list[str], confinement: Confinement, denial: int) -> list[str]:
    """The call inside its own namespaces; its system-call filter is read from the descriptor `denial`."""
    reads = [*runtime_paths(), *confinement.reads]
    binds = [word for path in _outermost(reads) for word in ("--ro-bind", str(path), str(path))]
    variables = [word for name, value in confinement.environment.items() for word in ("--setenv", name, value)]
    return [
        shutil.which("bwrap") or "bwrap",
        *("--unshare-all", "--die-with-parent", "--new-session", "--clearenv", "--cap-drop", "ALL"),
        *("--hostname", host_facts.HOST_NAME),
        *as_it_is([*map(Path, SYSTEM), *host_facts.readable()]),
        *("--proc", "/proc", "--dev", "/dev"),
        # To the kernel's own settings, root's job is still root, whatever capabilities it lacks.
        *(word for path in SETTINGS if Path(path).exists() for word in ("--ro-bind", path, path)),
        *_hidden(),
        *(word for path in devices() for word in ("--dev-bind", str(path), str(path))),
        *("--size", str(confinement.shared_bytes), "--tmpfs", "/dev/shm", "--remount-ro", "/dev"),
        *binds,
        *("--bind", str(confinement.scratch), str(confinement.scratch)),
        *("--bind", str(confinement.out), str(confinement.out)),
        *("--remount-ro", "/", "--chdir", str(confinement.out), "--seccomp", str(denial)),
        *variables,
        "--",
        *call,
    ]


def facts() -> dict[str, str]:
    """What the evidence records about this level."""
    done = subprocess.run(["bwrap", "--version"], capture_output=True, text=True, timeout=10, check=False)
    return {"bubblewrap": done.stdout.strip().removeprefix("bubblewrap ")}


def before_exec(confinement: Confinement) -> Callable[[], None]:
    """Set the resource limits, which are inherited through the namespaces."""
    return rlimits.before_exec(confinement)


def as_it_is(paths: Iterable[Path]) -> list[str]:
    """Show each read-only in its own place; those that are links stay links."""
    words: list[str] = []
    for path in paths:
        if path.is_symlink():
            words += ["--symlink", str(path.readlink()), str(path)]
        elif path.exists():
            words += ["--ro-bind", str(path), str(path)]
    return words


def _hidden() -> list[str]:
    """Cover what tells of this very machine."""
    words = [word for name in host_facts.EMPTY if Path(name).exists() for word in ("--ro-bind", "/dev/null", name)]
    bare = [name for name in host_facts.BARE if Path(name).exists()]
    return words + [word for name in bare for word in ("--tmpfs", name, "--remount-ro", name)]


def _outermost(paths: list[Path]) -> list[Path]:
    """Drop what lies inside the system's own folders; a bind over a bind in another order would hide it."""
    kept = dict.fromkeys(path.absolute() for path in paths)
    return [path for path in kept if not str(path).startswith("/usr/") and str(path) != "/usr"]

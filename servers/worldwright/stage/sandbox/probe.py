"""Test whether a level really confines: a small program inside it tries to get out, and one success disqualifies the level.

The same file is the prober and the program: `python probe.py OUTSIDE PARENT` prints a JSON object from each attempt to
its outcome (`refused: …`, or `possible`). Every attempt is chosen so that it harms nothing where it succeeds.
"""

import contextlib
import ctypes
import errno
import json
import os
import socket
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

BARRED = (errno.EPERM, errno.EACCES, errno.EROFS, errno.ENOENT, errno.ENOSYS, errno.ESRCH, errno.ENETUNREACH)
"""Errors that say: not allowed, not there, or not visible. Any other failure means that the way was open."""
SEIZE, NEW_USER = 0x4206, 0x10000000
"""PTRACE_SEIZE traces without stopping; CLONE_NEWUSER."""


def started(pid: int) -> str:
    """When a process started, in clock ticks since boot: another namespace's process of the same number differs."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[19]
    except OSError:
        return ""


def attempts(outside: Path, parent: int) -> dict[str, Callable[[], object]]:
    """Ways out by name; each raises an OSError when it is barred."""
    libc = ctypes.CDLL(None, use_errno=True)

    def call(number: int, *arguments: int) -> object:
        if libc.syscall(number, *arguments) < 0:
            raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
        return None

    def system(name: str, *arguments: object) -> object:
        if getattr(libc, name)(*arguments) < 0:
            raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
        return None

    return {
        "write outside": lambda: (outside / "written").write_bytes(b"x"),
        "read outside": lambda: (outside / "secret").read_bytes(),
        "list outside": lambda: list(outside.iterdir()),
        "change a mode outside": lambda: (outside / "secret").chmod(0o666),
        "TCP": lambda: socket.create_connection(("127.0.0.1", 9), timeout=1),
        "UDP": lambda: socket.socket(socket.AF_INET, socket.SOCK_DGRAM),
        "Unix socket": lambda: socket.socket(socket.AF_UNIX),
        "signal the supervisor": lambda: os.kill(parent, 0),
        "trace the supervisor": lambda: system("ptrace", SEIZE, parent, None, None),
        # No such file system exists, but the right to mount is asked for first.
        "mount": lambda: system("mount", b"none", bytes(outside), b"no-such-file-system", 0, None),
        "user namespace": lambda: system("unshare", NEW_USER),
        "io_uring": lambda: call(425, 1, 0),
        "kernel settings": lambda: os.close(os.open("/proc/sys/kernel/core_pattern", os.O_WRONLY)),
        "raise a limit": lambda: _raise_limit(),
        "hardware addresses": lambda: _addresses(),
    }


def _addresses() -> list[str]:
    """What tells this machine from every other; a FileNotFoundError when no network device is seen."""
    names = [path / "address" for path in Path("/sys/class/net").iterdir()]
    if not names:
        raise FileNotFoundError(errno.ENOENT, "no network device is seen")
    return [name.read_text() for name in names]


def _raise_limit() -> None:
    import resource

    try:
        resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
    except ValueError as barred:
        raise PermissionError(1, str(barred)) from barred


def report(outside: Path, parent: int, start: str) -> dict[str, str]:
    """The outcome of each attempt; a parent whose number means another process here is out of reach."""
    if started(parent) not in ("", start):
        parent = 1 << 22
    found = {}
    for name, attempt in attempts(outside, parent).items():
        try:
            attempt()
            found[name] = "possible"
        except OSError as barred:
            found[name] = f"refused: {barred.strerror or barred}" if barred.errno in BARRED else "possible"
    return found


def ways_out(level: ModuleType) -> tuple[list[str], int, str]:
    """Run the attempts at a level: what was possible, how many were tried, and why it could not run, if so."""
    import tempfile

    from .. import family
    from .confinement import Confinement, environment
    from .enter import run

    with tempfile.TemporaryDirectory(prefix="worldwright-probe-", ignore_cleanup_errors=True) as name:
        folder = Path(name).resolve()
        for part in ("out", "scratch", "inside", "outside"):
            (folder / part).mkdir()
        (folder / "outside" / "secret").write_text("secret")
        program = folder / "inside" / "probe.py"
        program.write_bytes(Path(__file__).read_bytes())
        confinement = Confinement(
            out=folder / "out",
            reads=(folder / "inside",),
            scratch=folder / "scratch",
            cpu_s=20,
            file_bytes=1 << 20,
            memory_bytes=4 << 30,
            token=family.new_token(),
            environment=environment(str(folder / "scratch")),
        )
        call = [sys.executable, "-I", "-S", str(program), str(folder / "outside"), str(os.getpid())]
        call.append(started(os.getpid()))
        try:
            done = run(level, call, confinement, timeout_s=30)
            found = json.loads(done.stdout)
        except (OSError, ValueError) as cause:
            said = ""
            with contextlib.suppress(UnboundLocalError):
                said = done.stderr.decode(errors="replace").strip()
            return [], 0, said or str(cause)
        return [attempt for attempt, outcome in found.items() if outcome == "possible"], len(found), ""


if __name__ == "__main__":
    print(json.dumps(report(Path(sys.argv[1]), int(sys.argv[2]), sys.argv[3])))  # noqa: T201

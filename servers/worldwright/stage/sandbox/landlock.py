"""Landlock and seccomp: without privileges or namespaces, a job sees and writes its own folders and opens no socket.

Landlock confines reading, writing, running, TCP, abstract sockets and signals; a seccomp filter forbids what Landlock
does not know (UDP, the files' owners and modes, ptrace's relatives, io_uring, which would go round every filter). Both are
applied by the child to itself, after it has given up every capability. Source: landlock(7), seccomp(2),
capabilities(7), the kernel's user-space API documentation.
"""

import contextlib
import ctypes
import os
import struct
from collections.abc import Callable, Iterator
from pathlib import Path

from . import host_facts, rlimits, seccomp
from .confinement import SYSTEM, Confinement, devices, runtime_paths

CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446
VERSION_FLAG, PATH_BENEATH = 1, 1
EXECUTE, WRITE_FILE, READ_FILE, READ_DIR, TRUNCATE, IOCTL_DEVICE = 1 << 0, 1 << 1, 1 << 2, 1 << 3, 1 << 14, 1 << 15
RIGHTS_BY_ABI = {1: 0b1_1111_1111_1111, 2: 1 << 13, 3: TRUNCATE, 5: IOCTL_DEVICE}
"""File-system rights by the ABI that introduced them."""
READ, RUN = READ_FILE | READ_DIR, READ_FILE | READ_DIR | EXECUTE
TCP, SCOPES = 0b11, 0b11
"""Bind and connect are confined from ABI 4, abstract sockets and signals from ABI 6."""
FILE_RIGHTS = EXECUTE | WRITE_FILE | READ_FILE | TRUNCATE | IOCTL_DEVICE
"""The rights that a rule on a file, not a folder, may name."""
PROC = ("cpuinfo", "meminfo", "stat", "uptime", "version", "loadavg", "filesystems", "self", "thread-self")
PR_CAPBSET_DROP, PR_CAP_AMBIENT, CLEAR_AMBIENT, CAPABILITY_VERSION = 24, 47, 4, 0x20080522
WORLD = Path(__file__).parents[3]


def abi() -> int:
    """The kernel's Landlock version; below 1 without it."""
    return ctypes.CDLL(None, use_errno=True).syscall(CREATE_RULESET, None, 0, VERSION_FLAG)


def unavailable() -> str:
    """Why this level cannot be tried here; empty when it can."""
    return seccomp.unavailable() or ("" if abi() >= 1 else "the kernel does not offer Landlock")


def command(call: list[str], confinement: Confinement, denial: int) -> list[str]:
    """The call as it is: the child confines itself."""
    return call


def facts() -> dict[str, str]:
    """What the evidence records about this level."""
    return {"landlock_abi": str(abi())}


def before_exec(confinement: Confinement) -> Callable[[], None]:
    """Set resource limits, give up capabilities, then apply the file, network and system-call rules."""
    limits = rlimits.before_exec(confinement)
    rules = list(_rules(confinement))

    def confine() -> None:
        limits()
        drop_capabilities()
        restrict(rules)
        seccomp.install(seccomp.denial(landlock_abi=abi(), own_pid=os.getpid()))

    return confine


def _rules(confinement: Confinement) -> list[tuple[Path, int]]:
    """The rights beneath each path."""
    everything = sum(RIGHTS_BY_ABI.values())
    rules = [(Path(name), RUN) for name in SYSTEM]
    rules += [(path, RUN) for path in runtime_paths()]
    rules += [*_described(), *((path, READ) for path in confinement.reads)]
    # The import system lists the folder of worldkit; it may read nothing else there.
    rules += [(WORLD, READ_DIR)]
    rules += [(path, everything & ~EXECUTE & ~IOCTL_DEVICE) for path in (confinement.out, confinement.scratch)]
    rules += [(Path("/dev") / name, READ_FILE | WRITE_FILE) for name in ("null", "zero", "full", "random", "urandom")]
    rules += [(path, READ | WRITE_FILE | IOCTL_DEVICE) for path in devices()]
    rules += [(Path("/proc") / name, READ) for name in PROC]
    return rules


def _described(root: Path = Path("/sys")) -> Iterator[tuple[Path, int]]:
    """What may be read of /sys; of a card's folders the names of what lies in them too, as its driver lists them.

    Links need no rule: they are read without one, and one on them would be on what they lead to.
    """
    for path in host_facts.readable(root):
        if not path.is_symlink():
            yield path, READ
            if path.is_file():
                yield path.parent, READ_DIR


def restrict(rules: list[tuple[Path, int]]) -> None:
    """Confine the calling process, for good.

    Raises:
        OSError: the kernel refused.
    """
    libc = ctypes.CDLL(None, use_errno=True)
    version = abi()
    handled = sum(bits for since, bits in RIGHTS_BY_ABI.items() if since <= version)
    attributes = struct.pack("QQQ", handled, TCP if version >= 4 else 0, SCOPES if version >= 6 else 0)
    size = 24 if version >= 6 else 16 if version >= 4 else 8
    ruleset = libc.syscall(CREATE_RULESET, attributes, size, 0)
    if ruleset < 0:
        raise OSError(ctypes.get_errno(), "landlock_create_ruleset")
    for path, rights in rules:
        try:
            handle = os.open(path, os.O_PATH | os.O_CLOEXEC)
        except OSError:
            continue  # this machine does not have it
        try:
            allowed = handled & (rights if path.is_dir() else rights & FILE_RIGHTS)
            if allowed and libc.syscall(ADD_RULE, ruleset, PATH_BENEATH, struct.pack("=Qi", allowed, handle), 0):
                raise OSError(ctypes.get_errno(), "landlock_add_rule", str(path))
        finally:
            os.close(handle)
    libc.prctl(seccomp.PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    if libc.syscall(RESTRICT_SELF, ruleset, 0):
        raise OSError(ctypes.get_errno(), "landlock_restrict_self")
    os.close(ruleset)


def drop_capabilities() -> None:
    """Give up every capability, also those that running a program as root would bring back."""
    libc = ctypes.CDLL(None, use_errno=True)
    with contextlib.suppress(OSError, ValueError):
        last = int(Path("/proc/sys/kernel/cap_last_cap").read_text())
        for capability in range(last + 1):
            libc.prctl(PR_CAPBSET_DROP, capability, 0, 0, 0)
    libc.prctl(PR_CAP_AMBIENT, CLEAR_AMBIENT, 0, 0, 0)
    libc.capset(struct.pack("Ii", CAPABILITY_VERSION, 0), struct.pack("6I", *[0] * 6))

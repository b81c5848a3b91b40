"""Landlock and seccomp: without privileges or namespaces, the job may write its own folders only and open no socket.

Landlock confines file writes and TCP; a seccomp filter denies `socket` altogether, which Landlock cannot (UDP). Both
are applied by the child to itself. Source: landlock(7), seccomp(2), the kernel's user-space API documentation.
"""

import ctypes
import os
import platform
import struct
from collections.abc import Callable
from pathlib import Path

from . import rlimits
from .confinement import Confinement

CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446
VERSION_FLAG, PATH_BENEATH = 1, 1
# Every file-system right that changes something, by the ABI that brought it.
WRITE_RIGHTS = {1: 0b1_1111_1111_0010, 2: 1 << 13, 3: 1 << 14}
SECCOMP_MODE_FILTER, PR_SET_SECCOMP, PR_SET_NO_NEW_PRIVS = 2, 22, 38
ARCHITECTURES = {"x86_64": (0xC000003E, 41, 53), "aarch64": (0xC00000B7, 198, 199)}
"""Audit architecture, and the numbers of `socket` and `socketpair`."""
ALLOW, DENY = 0x7FFF0000, 0x00050000 | 13  # EACCES


def _abi() -> int:
    return ctypes.CDLL(None, use_errno=True).syscall(CREATE_RULESET, None, 0, VERSION_FLAG)


def unusable() -> str:
    """Why this level does not work here; empty when a confined child was really kept from writing and connecting."""
    if platform.machine() not in ARCHITECTURES:
        return f"no system-call numbers are known for {platform.machine()}"
    if _abi() < 1:
        return "the kernel does not offer Landlock"
    child = os.fork()
    if child == 0:
        code = 1
        try:
            _apply(())
            import socket

            try:
                Path("/tmp/worldwright-landlock-probe").write_bytes(b"")
            except PermissionError:
                try:
                    socket.socket()
                except PermissionError:
                    code = 0
        finally:
            os._exit(code)
    return "" if os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0 else "a confined process could still write"


def command(call: list[str], confinement: Confinement) -> list[str]:
    """The call as it is: the child confines itself."""
    return call


def before_exec(confinement: Confinement) -> Callable[[], None]:
    """Resource limits, then the file and socket rules."""
    limits = rlimits.before_exec(confinement)
    writable = (confinement.out, confinement.scratch, Path("/dev"))

    def confine() -> None:
        limits()
        _apply(writable)

    return confine


def _apply(writable: tuple[Path, ...]) -> None:
    libc = ctypes.CDLL(None, use_errno=True)
    rights = sum(bits for abi, bits in WRITE_RIGHTS.items() if abi <= _abi())
    ruleset = libc.syscall(CREATE_RULESET, struct.pack("Q", rights), 8, 0)
    if ruleset < 0:
        raise OSError(ctypes.get_errno(), "landlock_create_ruleset")
    for folder in writable:
        handle = os.open(folder, os.O_PATH | os.O_CLOEXEC)
        try:
            if libc.syscall(ADD_RULE, ruleset, PATH_BENEATH, struct.pack("=Qi", rights, handle), 0):
                raise OSError(ctypes.get_errno(), "landlock_add_rule", str(folder))
        finally:
            os.close(handle)
    libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    if libc.syscall(RESTRICT_SELF, ruleset, 0):
        raise OSError(ctypes.get_errno(), "landlock_restrict_self")
    os.close(ruleset)
    audit, *denied = ARCHITECTURES[platform.machine()]
    # BPF: load the architecture; a foreign one is denied whole; load the number; jump to deny on a match.
    steps = [(0x20, 0, 0, 4), (0x15, 1, 0, audit), (0x06, 0, 0, DENY), (0x20, 0, 0, 0)]
    steps += [(0x15, len(denied) - i, 0, number) for i, number in enumerate(denied)]
    steps += [(0x06, 0, 0, ALLOW), (0x06, 0, 0, DENY)]
    code = ctypes.create_string_buffer(b"".join(struct.pack("HBBI", *step) for step in steps))
    program = struct.pack("HxxxxxxQ", len(steps), ctypes.addressof(code))
    if libc.prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, ctypes.create_string_buffer(program), 0, 0):
        raise OSError(ctypes.get_errno(), "seccomp")

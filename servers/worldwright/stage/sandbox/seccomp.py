"""Seccomp filters, assembled: which system calls a confined program may not make, and those its supervisor decides on.

Not libseccomp: its rules name single calls, so it cannot refuse every call newer than a number; its binding loads in 83 ms.

A filter is a classic BPF program over (number, architecture, arguments). Calls that need an argument looked at are
judged on registers only, so a second thread cannot change what was judged; a call that takes its flags from memory
(`clone3`, `openat2`) does not exist for a job, and the C library uses the older one. Source: seccomp(2), and the
kernel's documentation of seccomp filters and of user notification.
"""

import ctypes
import errno
import os
import struct
from dataclasses import dataclass

from .syscalls import AUDIT, NEWEST, architecture, number

ALLOW, NOTIFY, KILL = 0x7FFF0000, 0x7FC00000, 0x80000000
LOAD, AND, EQUAL, GREATER, AT_LEAST, RETURN = 0x20, 0x54, 0x15, 0x25, 0x35, 0x06
SET_MODE_FILTER, NEW_LISTENER, PR_SET_NO_NEW_PRIVS = 1, 1 << 3, 38
AF_UNIX = 1
NEW_NAMESPACES = 0x7E020000
"""CLONE_NEWNS, NEWCGROUP, NEWUTS, NEWIPC, NEWUSER, NEWPID and NEWNET."""
TIOCSTI, TIOCLINUX, PR_SET_PDEATHSIG = 0x5412, 0x541C, 1
READ_AND_TRUNCATE, TRUNCATE = 0o1003, 0o1000
"""O_ACCMODE | O_TRUNC, and O_RDONLY | O_TRUNC."""
X32 = 0x40000000

_FORBIDDEN = """
    socket
    ptrace process_vm_readv process_vm_writev kcmp pidfd_getfd process_madvise process_mrelease
    keyctl add_key request_key bpf perf_event_open userfaultfd
    io_uring_setup io_uring_enter io_uring_register
    memfd_create memfd_secret execveat
    mount umount2 pivot_root chroot move_mount open_tree fsopen fsconfig fsmount fspick mount_setattr unshare setns
    init_module finit_module delete_module kexec_load kexec_file_load reboot swapon swapoff acct quotactl quotactl_fd
    nfsservctl settimeofday clock_settime clock_adjtime adjtimex sethostname setdomainname syslog iopl ioperm vhangup
    setuid setgid setreuid setregid setresuid setresgid setgroups setfsuid setfsgid capset setrlimit
    shmget shmat shmctl msgget semget mq_open mq_unlink
    inotify_init inotify_init1 inotify_add_watch fanotify_init fanotify_mark
    open_by_handle_at name_to_handle_at lookup_dcookie uselib personality
    mknod mknodat migrate_pages move_pages
    chmod fchmod fchmodat fchmodat2 chown lchown fchown fchownat
    setxattr lsetxattr fsetxattr removexattr lremovexattr fremovexattr utime utimes futimesat utimensat
"""
FORBIDDEN = tuple(_FORBIDDEN.split())
"""These calls fail with EPERM. The last two lines change owners, modes and times, which no Landlock right covers."""
SCHEDULING = ("sched_setaffinity", "sched_setscheduler", "sched_setparam", "sched_setattr")
BIRTHS = ("clone", "fork", "vfork")
"""With `clone3`, which no job has, all calls that start a process or a thread."""
SIGNALS = ("kill", "tkill", "tgkill", "rt_sigqueueinfo", "rt_tgsigqueueinfo", "pidfd_send_signal")


@dataclass(frozen=True)
class When:
    """A rule that compares half an argument: its verdict holds if 32 masked bits equal a value (or differ from it)."""

    call: str
    argument: int
    mask: int
    value: int
    differs: bool = False
    high: bool = False
    """Look at the argument's high 32 bits instead."""
    verdict: int = 0x00050000 | errno.EPERM


def refuse(code: int = errno.EPERM) -> int:
    """The verdict that makes a call fail with an error number."""
    return 0x00050000 | code


def unavailable() -> str:
    """Why filters cannot be used here; empty when they can."""
    if not architecture():
        import platform

        return f"no system-call numbers are known for {platform.machine()}"
    if ctypes.CDLL(None).prctl(21, 0, 0, 0, 0) < 0:  # PR_GET_SECCOMP
        return "the kernel has no seccomp"
    return ""


def denial(*, landlock_abi: int = 99, own_pid: int | None = None, births: bool = True) -> bytes:
    """The filter of the confined program.

    Args:
        landlock_abi: what Landlock here does not cover yet is refused here instead; 99 when namespaces cover it.
        own_pid: the program's process number, the only one it may signal before Landlock scopes signals (ABI 6).
        births: whether it may ever start a process or a thread.
    """
    rules: list[tuple[str, int] | When] = [(call, refuse()) for call in (*FORBIDDEN, *(() if births else BIRTHS))]
    rules += [(call, refuse(errno.ENOSYS)) for call in ("clone3", "openat2")]
    rules += [
        When("socketpair", 0, 0xFFFFFFFF, AF_UNIX, differs=True),
        When("clone", 0, NEW_NAMESPACES, 0, differs=True),
        When("ioctl", 1, 0xFFFFFFFF, TIOCSTI),
        When("ioctl", 1, 0xFFFFFFFF, TIOCLINUX),
        When("prctl", 0, 0xFFFFFFFF, PR_SET_PDEATHSIG),
        # A process may set its own priority, not another's.
        *(When(call, 0, 0xFFFFFFFF, 0, differs=True) for call in SCHEDULING),
        *(When(call, 1, 0xFFFFFFFF, 0, differs=True) for call in ("setpriority", "ioprio_set")),
        # The argument is a pointer to new limits, which is zero when limits are only read.
        When("prlimit64", 2, 0xFFFFFFFF, 0, differs=True),
        When("prlimit64", 2, 0xFFFFFFFF, 0, differs=True, high=True),
    ]
    if landlock_abi < 3:
        rules += [("truncate", refuse())]
        rules += [When("open", 1, READ_AND_TRUNCATE, TRUNCATE), When("openat", 2, READ_AND_TRUNCATE, TRUNCATE)]
    if landlock_abi < 6:
        mine = own_pid or 0
        rules += [When("kill", 0, 0xFFFFFFFF, mine, differs=True), When("tgkill", 0, 0xFFFFFFFF, mine, differs=True)]
        rules += [(call, refuse()) for call in SIGNALS if call not in ("kill", "tgkill")]
    return assemble(rules)


def births() -> bytes:
    """The filter that asks the supervisor before a process or a thread is born."""
    rules: list[tuple[str, int] | When] = [(call, NOTIFY) for call in BIRTHS]
    return assemble([("clone3", refuse(errno.ENOSYS)), *rules])


def assemble(rules: list[tuple[str, int] | When], machine: str = "") -> bytes:
    """Classic BPF, eight bytes an instruction: every rule in turn, then allow."""
    machine = machine or architecture()
    steps = [(LOAD, 0, 0, 4), (EQUAL, 1, 0, AUDIT[machine]), (RETURN, 0, 0, KILL), (LOAD, 0, 0, 0)]
    if machine == "x86_64":
        steps += [(AT_LEAST, 0, 1, X32), (RETURN, 0, 0, refuse(errno.ENOSYS))]
    steps += [(GREATER, 0, 1, NEWEST), (RETURN, 0, 0, refuse(errno.ENOSYS))]
    for rule in rules:
        if not isinstance(rule, When):
            call, verdict = rule
            if (known := number(call, machine)) is not None:
                steps += [(EQUAL, 0, 1, known), (RETURN, 0, 0, verdict)]
        elif (known := number(rule.call, machine)) is not None:
            hit, miss = (1, 0) if rule.differs else (0, 1)
            steps += [
                (EQUAL, 0, 5, known),
                (LOAD, 0, 0, 16 + 8 * rule.argument + 4 * rule.high),
                (AND, 0, 0, rule.mask),
                (EQUAL, hit, miss, rule.value),
                (RETURN, 0, 0, rule.verdict),
                (LOAD, 0, 0, 0),
            ]
    steps.append((RETURN, 0, 0, ALLOW))
    return b"".join(struct.pack("HBBI", *step) for step in steps)


def install(program: bytes, *, listen: bool = False) -> int:
    """Put a filter on the calling process for good; with `listen`, returns the descriptor that its questions come to.

    Raises:
        OSError: the kernel refused.
    """
    libc = ctypes.CDLL(None, use_errno=True)
    code = ctypes.create_string_buffer(program, len(program))
    header = ctypes.create_string_buffer(struct.pack("HxxxxxxQ", len(program) // 8, ctypes.addressof(code)))
    libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    done = libc.syscall(number("seccomp"), SET_MODE_FILTER, NEW_LISTENER if listen else 0, header)
    if done < 0:
        code_number = ctypes.get_errno()
        raise OSError(code_number, f"seccomp: {os.strerror(code_number)}")
    return int(done)

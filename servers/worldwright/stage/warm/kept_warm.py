"""Ask this process's nursery for a warm start; None where there is none, and the caller starts the process cold."""

import os
import select
import socket
import subprocess
import sys
import threading
import time
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from . import letters

SWITCH = "WORLDWRIGHT_WARM"
PATIENCE_S = 20.0
"""A nursery that does not answer within so many seconds is not asked again; nothing has begun by then."""
ITS_ENVIRONMENT = {
    "PATH": os.defpath,
    "LANG": "C.UTF-8",
    "MUJOCO_GL": "disable",
    "PYTHONHASHSEED": "0",
    "PYTHONUNBUFFERED": "1",
    "PYTHONPATH": str(Path(__file__).parents[3]),
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "PYDANTIC_DISABLE_PLUGINS": "__all__",
}
"""A nursery's own, of which nothing is the user's; for what it forks it is replaced."""
MOST_GIVEN_UP = 4
"""Where so many have failed, or seen their files change, no other is started."""
WITHOUT_EFFECT = (
    "PYTHONUNBUFFERED",
    "PYTHONDONTWRITEBYTECODE",
    "PYTHONIOENCODING",
    "PYTHONSAFEPATH",
    "PYTHONNOUSERSITE",
    *("OPENBLAS_CORETYPE", "OPENBLAS_L2_SIZE"),  # of linear algebra, which no supervisor does; no engine is given them
)
AT_START = ("PYTHON", "LD_", "GLIBC_", "MALLOC_", "OPENBLAS_", "OMP_", "MKL_", "NPY_")
"""Beginnings of variables that a process reads when it starts, and never again."""


class Nursery:
    """The socket to a nursery."""

    def __init__(self, control: socket.socket, ready: bool, process: "subprocess.Popen[bytes] | None" = None) -> None:
        self.control, self.ready, self.process, self.owner = control, ready, process, os.getpid()
        self.lock = threading.Lock()

    @classmethod
    def start(cls, since_s: float | None = None) -> "Nursery":
        """Start one; it loads its modules while this process goes on, each as it is since `since_s`, by default now."""
        ours, theirs = socket.socketpair()
        with theirs:
            number, since = str(theirs.fileno()), repr(time.time() if since_s is None else since_s)
            process = subprocess.Popen(
                [sys.executable, "-s", "-P", "-m", "worldwright.stage.warm.nursery", number, since],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                env=ITS_ENVIRONMENT,
                pass_fds=(theirs.fileno(),),
                start_new_session=True,  # what is typed at a terminal is not meant for it
            )
        return cls(ours, False, process)

    def alive(self) -> bool:
        """Whether it can still be asked."""
        return self.process is None or self.process.poll() is None

    def ask(self, kind: bytes) -> socket.socket | None:
        """The socket to a new process, which waits for its request; None while none can be had.

        Raises:
            OSError, ValueError: it has ended, or another thread has closed it.
        """
        with self.lock:
            if not self.ready:
                said = select.poll()  # `select` refuses the high numbers that a long-lived server comes to
                said.register(self.control, select.POLLIN)
                if not said.poll(0) or self.control.recv(1) != letters.READY:
                    return None
                self.ready = True
            ours, theirs = socket.socketpair()
            with theirs:
                socket.send_fds(self.control, [kind], [theirs.fileno()])
        ours.settimeout(PATIENCE_S)
        return ours

    def close(self) -> None:
        """Let it end, once no other thread is asking."""
        with self.lock:
            self.control.close()


@dataclass
class Kept:
    """What this process has of nurseries."""

    nursery: Nursery | None = None
    wanted: bool = False
    given_up: int = 0
    lock: threading.Lock = field(default_factory=threading.Lock)
    """Two threads that ask at first start one nursery, and give up only the one that each of them asked."""


_kept = Kept()


def keep() -> None:
    """Have a nursery from the first process on that it could start: this process will start more than one."""
    _kept.wanted = True


def use(nursery: Nursery | None) -> Nursery | None:
    """Have this nursery, or none; returns the one before."""
    with _kept.lock:
        before, _kept.nursery = _kept.nursery, nursery
    return before


def ask(kind: bytes) -> tuple[Nursery, socket.socket] | None:
    """A nursery, and the socket to its new process of a kind, which waits for its request; None: start it cold."""
    if os.environ.get(SWITCH) == "0" or sys.platform != "linux":
        return None
    with _kept.lock:
        nursery = _kept.nursery
        if nursery is None or nursery.owner != os.getpid():
            if _kept.wanted and _kept.given_up < MOST_GIVEN_UP:
                with suppress(OSError):  # no room for one more process: what is started cold may still find some
                    _kept.nursery = Nursery.start()
            return None
    with suppress(OSError, ValueError):
        if nursery.alive():
            asked = nursery.ask(kind)
            return (nursery, asked) if asked else None
    give_up(nursery)
    return None


def give_up(nursery: Nursery) -> None:
    """Do without a nursery whose files have changed or which has died; whoever keeps one has another later."""
    with _kept.lock:
        if _kept.nursery is nursery:  # else another thread has given it up, and there may be a new one
            _kept.nursery = None
            _kept.given_up += 1
    nursery.close()


def taken(asked: socket.socket) -> bool:
    """Whether the process at the other end is ready to begin; it then waits for `GO`."""
    try:
        return asked.recv(1) == letters.TAKEN
    except OSError:
        return False


def supervisor(job: Path, errors: int, lock: int, environment: dict[str, str]) -> bool:
    """Have a job supervised by a process that is forked; false where it must be started.

    Args:
        job: its folder.
        errors: descriptor of the file that its words go to.
        lock: descriptor of the job's lock, which is held.
        environment: the process's.
    """
    if not starts_alike(environment) or (found := ask(letters.SUPERVISOR)) is None:
        return False
    nursery, asked = found
    with asked, suppress(OSError):  # one is that the folder in which this process stands is gone
        request = {"job": str(job), "environment": environment, "folder": str(Path.cwd()), "umask": umask()}
        letters.send(asked, request, (errors, lock))
        if taken(asked):
            asked.send(letters.GO)
            return True
    give_up(nursery)
    return False


def umask() -> int:
    """This process's, read without setting it, which another thread would notice.

    Raises:
        OSError: the kernel does not tell.
    """
    status = Path("/proc/self/status").read_text(encoding="utf-8", errors="replace")
    if not (words := status.partition("Umask:")[2].split(maxsplit=1)):
        raise OSError("/proc/self/status names no Umask")
    return int(words[0], 8)


def starts_alike(environment: dict[str, str]) -> bool:
    """Whether an interpreter that is started in this environment is like the nursery's."""
    import locale

    if locale.getencoding().lower() not in ("utf-8", "utf8") or sys.flags.optimize or sys.flags.dev_mode:
        return False
    return all(
        ITS_ENVIRONMENT.get(name) == value
        for name, value in environment.items()
        if name.startswith(AT_START) and name not in WITHOUT_EFFECT
    )

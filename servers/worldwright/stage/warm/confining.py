"""An engine, forked: it joins the namespaces of a sandbox, gives up all that bubblewrap would take from it, and only then begins.

Two processes: the keeper joins, forks the engine into the sandbox's process numbers, tells the shell there how it ended, and ends it
when whoever asked has gone; it runs nothing that reads a world. The engine confines itself in the order of a cold start: the limits,
every capability, and both filters of system calls, after which none of it can be undone.
"""

import ctypes
import os
import select
import signal
import socket
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any, NoReturn

from ..sandbox import landlock, rlimits, seccomp
from ..sandbox.confinement import Confinement
from . import letters, newborn

PR_SET_DUMPABLE = 4


def begin(asked: socket.socket) -> int:
    """Be the keeper of the engine that is asked for; returns when it has ended."""
    request, (inside, status, output, births, *descriptors) = letters.receive(asked)
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.setns(inside, seccomp.NEW_NAMESPACES):
        return 1
    ours, theirs = socket.socketpair()
    engine = os.fork()
    if engine == 0:
        _engine(request, theirs, output, births, descriptors)
    newborn.alone(asked.fileno(), status, ours.fileno())
    with suppress(OSError):
        if ours.recv(1) == letters.TAKEN:
            asked.send(letters.TAKEN)
            asked.send(str(engine).encode())
            if asked.recv(1) == letters.GO:
                ours.send(letters.GO)
                ours.close()
                _watch(asked, engine)
    with suppress(ProcessLookupError):
        os.kill(engine, signal.SIGKILL)
    _, ended, used = os.wait4(engine, 0)
    with suppress(OSError):
        asked.send(repr(used.ru_utime + used.ru_stime).encode())
    code = os.waitstatus_to_exitcode(ended)
    with suppress(OSError):
        os.write(status, b"%d\n" % (code if code >= 0 else 128 - code))
    return 0


def _watch(asked: socket.socket, engine: int) -> None:
    """Wait until the engine has ended, or whoever asked for it."""
    number = os.pidfd_open(engine)
    looked = select.poll()
    looked.register(number, select.POLLIN)
    looked.register(asked.fileno(), select.POLLHUP)
    looked.poll()
    os.close(number)


def _engine(request: dict[str, Any], keeper: socket.socket, output: int, births: int, given: list[int]) -> NoReturn:
    """Be the engine, and end."""
    status = 1
    try:
        _confine(request, births)
        keeper.send(letters.TAKEN)
        if keeper.recv(1) == letters.GO:
            keeper.close()
            for number in (1, 2):
                os.dup2(output, number)
            _lay(given, request["descriptors"])
            status = _run(request)
    except SystemExit as ended:
        if ended.code is not None and not isinstance(ended.code, int):
            print(ended.code, file=sys.stderr)  # noqa: T201 - as the interpreter does
        status = ended.code if isinstance(ended.code, int) else int(ended.code is not None)
    except BaseException:
        import traceback

        traceback.print_exc()
    finally:
        with suppress(Exception):
            sys.stdout.flush()
            sys.stderr.flush()
        os._exit(status)


def _confine(request: dict[str, Any], births: int) -> None:
    """Confine this process for good, as `sandbox.enter` and bubblewrap confine one that they start."""
    from ..sandbox.enter import limit_births

    out, scratch, limits = Path(request["out"]), Path(request["scratch"]), request["limits"]
    os.setsid()
    newborn.become(request["environment"] | {"PWD": request["out"]}, request["out"], request["umask"])
    ctypes.CDLL(None).prctl(PR_SET_DUMPABLE, 1, 0, 0, 0)  # as a program that was started; joining namespaces takes it
    with socket.socket(fileno=births) as told:
        limit_births(told, request["births"])
    rlimits.before_exec(Confinement(out=out, reads=(), scratch=scratch, **limits))()
    landlock.drop_capabilities()
    seccomp.install(seccomp.denial())


def _lay(given: list[int], numbers: list[int]) -> None:
    """Put each descriptor at the number that the engine's words name, and close all others."""
    import fcntl

    beyond = max([2, *numbers, *given]) + 1
    held = [fcntl.fcntl(number, fcntl.F_DUPFD, beyond) for number in given]  # none in another's place
    for number, at in zip(held, numbers, strict=True):
        os.dup2(number, at)
    newborn.alone(*numbers)


def _run(request: dict[str, Any]) -> int:
    """What `python -s -P -m worldengine WORDS` does; with `run`, what `python -s -P FILE WORDS` does."""
    if request["run"]:
        import runpy

        sys.argv = [request["run"], *request["words"]]
        runpy.run_path(request["run"], run_name="__main__")
        return 0
    import worldengine.__main__ as engine
    from worldengine.film import graphics_library
    from worldkit import lock

    lock.verify()
    words = request["words"]
    sys.argv = [str(engine.__file__), *words]
    if set(words[:1]) & engine.WITHOUT_PICTURES:
        os.environ["MUJOCO_GL"] = "disable"
    else:
        graphics_library.load_chosen()
    return engine.main()

"""The process that others are forked from: `python -s -P -m worldwright.stage.warm.nursery SOCKET SINCE`.

It loads modules, and waits. For each request that it is told of it forks a process, which reads the request: what one job says is
in no other's memory. It runs no thread and draws nothing, so that what is forked is whole, and ends when nobody can ask any more.
"""

import importlib
import os
import signal
import socket
import sys
from contextlib import suppress
from pathlib import Path
from typing import NoReturn

from . import letters

LOADED = (
    *("worldwright.stage.warm.supervising", "worldwright.stage.warm.confining"),
    *("worldwright.stage.supervisor", "worldwright.stage.sculpting_step", "worldwright.model.plan.plan_text"),
    *("cryptography.hazmat.primitives.asymmetric.ed25519", "cryptography.hazmat.primitives.serialization"),
    *(
        "numpy",
        "numpy.random",
        "mujoco",
        "worldkit.program",
        "worldkit.reporting",
        "worldkit.world",
        "worldkit.cameras.aiming",
    ),
    *("worldkit.forms.lattice", "worldkit.bodies", "worldengine.__main__", "worldengine.clock.physics"),
    *(
        "worldengine.clock.beside",
        "worldengine.clock.simulate",
        "worldengine.inputs.ports",
        "worldengine.inputs.soft_start",
    ),
    *("worldengine.inputs.told_laws", "worldengine.recording.record", "worldengine.recording.reuse"),
    *("worldengine.recording.motion_key", "worldengine.recording.drive_source", "worldengine.recording.drawn_overlaps"),
    *("worldengine.recording.standing_cameras", "worldengine.recording.replay", "worldengine.variants.altered"),
    *("worldengine.film.passes", "worldengine.film.described"),
)
"""What supervisors and engines import anyway; nothing that starts a thread (pyarrow), opens a display (OpenGL) or reads a setting."""
SLACK_S = 0.1
"""The clock that files are dated by is coarser than the other, s."""


def files() -> set[str]:
    """Those that this process has loaded."""
    modules = {str(getattr(module, "__file__", None) or "") for module in tuple(sys.modules.values())}
    mapped = {line.split(maxsplit=5)[-1].strip() for line in Path("/proc/self/maps").read_text().splitlines()}
    return {name for name in modules | mapped if name.startswith("/")}


class Loaded:
    """Files that have been loaded, and since when."""

    def __init__(self, since_s: float, names: set[str]) -> None:
        self.files: dict[str, tuple[int, ...]] = {}
        self.late = False
        """Whether one of them was changed while it was loaded."""
        for name in sorted(names):
            try:
                found = os.stat(name)  # noqa: PTH116 - of hundreds
            except OSError:
                self.late = True
                return
            self.files[name] = _identity(found)
            self.late |= found.st_ctime > since_s - SLACK_S

    def changed(self) -> bool:
        """Whether one of them is another than the one that was loaded, or gone."""
        try:
            return self.late or any(_identity(os.stat(name)) != known for name, known in self.files.items())  # noqa: PTH116
        except OSError:
            return True


def _identity(found: os.stat_result) -> tuple[int, ...]:
    """What another file, or another content, has otherwise; the change time would tell of each hard link, too, of which an
    installer makes one for every environment."""
    return found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns


def writable(program: str) -> bool:
    """Whether a file that runs could be written now, as a few kernels let one (Linux 6.11).

    Of an engine that joins a sandbox the kernel shows this interpreter, at `/proc/self/exe`, not as the sandbox does, read-only, but as
    it lies outside; that nobody writes what runs is what protects it there.
    """
    try:
        os.close(os.open(program, os.O_WRONLY))
    except OSError:
        return False
    return True


def main() -> int:
    """Load what is to be loaded, say so, and fork; returns the exit status."""
    control = socket.socket(fileno=int(sys.argv[1]))
    for name in LOADED:
        importlib.import_module(name)
    loaded = Loaded(float(sys.argv[2]), files())
    if len(os.listdir("/proc/self/task")) > 1:  # noqa: PTH208 - what a fork would leave behind in it may hold a lock
        return 1
    if writable("/proc/self/exe"):
        return 1
    control.send(letters.READY)
    serve(control, loaded)
    return 0


def serve(control: socket.socket, loaded: Loaded) -> None:
    """Fork a process for each request, until nobody can ask any more."""
    import gc

    gc.freeze()  # what is shared stays so: nobody looks for garbage among it
    signal.signal(signal.SIGCHLD, _reap)
    while True:
        try:
            kind, descriptors, _, _ = socket.recv_fds(control, 1, 1)
            if not descriptors:
                return
        except OSError:
            return
        try:
            child = os.fork()
        except OSError:
            child = -1  # no room for one more: who asked sees the socket close
        if child == 0:
            control.close()
            _answer(kind, socket.socket(fileno=descriptors[0]), loaded)
        os.close(descriptors[0])


def _answer(kind: bytes, asked: socket.socket, loaded: Loaded) -> NoReturn:
    """Be what is asked for, and end."""
    status = 1
    try:
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        if not loaded.changed():
            from . import confining, supervising

            status = (
                supervising.begin(asked, lambda own: serve(own, loaded))
                if kind == letters.SUPERVISOR
                else confining.begin(asked)
            )
    except SystemExit as ended:
        status = ended.code if isinstance(ended.code, int) else int(ended.code is not None)
    except EOFError:
        status = 0
    except BaseException:
        import traceback

        traceback.print_exc()
    finally:
        with suppress(Exception):
            sys.stdout.flush()
        os._exit(status)


def _reap(*_: object) -> None:
    with suppress(ChildProcessError):
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass


if __name__ == "__main__":
    ended = main()
    os._exit(ended)

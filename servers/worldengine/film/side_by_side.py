"""Draw one film by several processes side by side: each draws every n-th frame, and the first of them writes the file.

Drawing by software takes one core, however many there are. The same state, camera and quality always give the same picture, so it
does not matter who drew a frame. What another process cannot draw, or draws by another renderer, the first draws itself.
"""

import contextlib
import json
import os
import queue
import struct
import subprocess
import sys
import threading
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, BinaryIO, NamedTuple

if TYPE_CHECKING:
    import numpy as np

    from .directed import Screening
    from .planned_views import PlannedViews

LEAST_FRAMES = 36
"""A process is worth its start, of some seconds, for so many frames of its own."""
MOST, MOST_BYTES, GROWS = 4, 3 << 30, 1.5
"""So many at most, and no more than have room together: each holds the world, its meshes and its textures, and still grows."""
PATIENCE_S = 60.0
"""Another process that has no frame ready for so long is stuck, or this machine is so busy that nobody gains by it."""
STARTING = 12
"""So many frames the first process draws alone, while the others start."""
AHEAD = 2
"""Frames that another process may have ready."""
HEAD = struct.Struct("<II")
"""Bytes of the words of a frame, and of its picture."""


class Drawn(NamedTuple):
    """A frame, and what was told of it."""

    picture: "np.ndarray"
    """uint8 (height, width, 3)."""
    hidden: list[str]


def processes(frames: int, each_bytes: int, room_bytes: int = 0) -> int:
    """How many processes draw a film of so many frames on this machine, each as large as this one is, within a room if one is given."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    room = min(room_bytes or MOST_BYTES, MOST_BYTES, _free_bytes() + each_bytes)
    return max(1, min(MOST, cores, frames // LEAST_FRAMES, int(room / GROWS) // max(each_bytes, 1)))


def _free_bytes() -> int:
    """The memory that this machine can still give; none where nobody tells."""
    try:
        rows = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
        return next(int(row.split()[1]) << 10 for row in rows if row.startswith("MemAvailable"))
    except (OSError, StopIteration, ValueError):
        return 0


def _resident_bytes() -> int:
    """The memory that this process holds; where nobody tells, so much that it stays alone."""
    try:
        return int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        return MOST_BYTES


class Others:
    """The other processes that draw a film; a context manager. They are started once this one has drawn a frame, and its size is known.

    Args:
        words: the command line of this process, behind `python -m worldengine`; without it there are none.
        frames: of the film, so many of which are drawn.
        size: of a picture, pixels.
        room_bytes: what all of them may take together, this process among them; 0: as much as is usual.
    """

    def __init__(self, words: Sequence[str], frames: int, size: tuple[int, int], room_bytes: int = 0) -> None:
        self._words, self._frames, self._size, self._room = words, frames, size, room_bytes
        self._hands: list[_Hand] | None = None

    def take(self, frame: int, renderer: str) -> Drawn | None:
        """A frame, by its place among those that are drawn, that another process drew by this renderer; None where this one has to
        draw it. To be asked in order."""
        if frame < 1 or not self._words:
            return None
        if self._hands is None:
            self._hands = self._started()
        number = frame % (len(self._hands) + 1) - 1
        if frame < STARTING or number < 0 or (answer := self._hands[number].next()) is None:
            return None
        import numpy as np

        told, data = answer
        width, height = self._size
        wanted = {"frame": frame, "renderer": renderer}
        if {**told, **wanted} != told or len(data) != 3 * width * height:
            self._hands[number].end()  # it is not what was asked for, and nothing of it is believed any more
            return None
        return Drawn(np.frombuffer(data, np.uint8).reshape(height, width, 3), [str(name) for name in told["hidden"]])

    def _started(self) -> "list[_Hand]":
        count = processes(self._frames, _resident_bytes(), self._room)
        hands: list[_Hand] = []
        try:
            for number in range(1, count):
                hands.append(_Hand([*self._words, "--share", f"{number}/{count}"]))
        except OSError:  # a sandbox that lets nothing more be born: then this one draws all, as nobody else keeps count
            for hand in hands:
                hand.end()
            return []
        return hands

    def __enter__(self) -> "Others":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for hand in self._hands or ():
            hand.end()


class _Hand:
    """One other process, whose frames a thread reads ahead."""

    def __init__(self, words: Sequence[str]) -> None:
        there, here = os.pipe()
        call = [sys.executable, "-s", "-P", "-m", "worldengine", *words, "--to", str(here)]
        try:
            self._process = subprocess.Popen(call, pass_fds=(here,), stdout=subprocess.DEVNULL)
        except OSError:
            os.close(there)
            raise
        finally:
            os.close(here)
        self._ready: queue.Queue[tuple[dict[str, Any], bytes] | None] = queue.Queue(AHEAD)
        self._ended = False
        self._thread = threading.Thread(target=self._read, args=(os.fdopen(there, "rb"),), daemon=True)
        self._thread.start()

    def _read(self, pipe: BinaryIO) -> None:
        try:
            with pipe:
                while len(head := pipe.read(HEAD.size)) == HEAD.size and not self._ended:
                    words, picture = HEAD.unpack(head)
                    told, data = pipe.read(words), pipe.read(picture)
                    if len(told) + len(data) < words + picture or not isinstance(said := json.loads(told), dict):
                        break
                    self._ready.put((said, data))
        except (ValueError, OSError, MemoryError):  # whatever came is no frame
            pass
        finally:
            self._ready.put(None)

    def next(self) -> "tuple[dict[str, Any], bytes] | None":
        """The next frame; None when there is none any more, or none comes."""
        if self._ended:
            return None
        try:
            answer = self._ready.get(timeout=PATIENCE_S)
        except queue.Empty:
            self.end()
            return None
        self._ended = answer is None
        return answer

    def end(self) -> None:
        """Let it go, whatever it is doing."""
        self._ended = True
        self._process.kill()
        self._process.wait()
        while self._thread.is_alive():
            with contextlib.suppress(queue.Empty):
                self._ready.get(timeout=0.05)
        self._thread.join()


def draw(screening: "Screening | PlannedViews", share: tuple[int, int], frames: Sequence[int], pipe: BinaryIO) -> None:
    """Draw a share (k, n) of these frames of a film, every n-th of them from k on, into a pipe, as one of the others; ends when nobody
    reads any more."""
    number, count = share
    with contextlib.suppress(BrokenPipeError):
        first = STARTING + (number - STARTING) % count
        for place in range(first, len(frames), count):
            picture = screening.picture(frames[place]).tobytes()
            told = {"frame": place, "renderer": screening.frames.renderer, "hidden": screening.hidden()}
            words = json.dumps(told).encode()
            pipe.write(HEAD.pack(len(words), len(picture)) + words + picture)
            pipe.flush()

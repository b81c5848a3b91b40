"""The stream of a live world: states out, commands in, over one pair of sockets, whoever is at the other end.

Out: frames, each the lengths of its two parts (two 32-bit numbers, little-endian), facts as JSON, and the state as the
engine's own vector (`mj_getState` of `SIGNATURE`, float64). In: lines of JSON, as `inputs.commands.Console` reads them. Who is
slow to read misses frames, and the world does not wait. The end of the stream is the end of the drive.
"""

import json
import socket
import struct
from contextlib import suppress
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import mujoco
    import numpy as np

HEAD = struct.Struct("<II")
PARTS = ("TIME", "QPOS", "QVEL", "ACT", "PLASTIC", "CTRL", "EQ_ACTIVE", "MOCAP_POS", "MOCAP_QUAT")
"""Components of a state (`mjSTATE_…`)."""
MOST_LINE = 1 << 20
MOST_FRAME = 1 << 28
READS = 1 << 16


def signature() -> int:
    """The engine's number for `PARTS`."""
    import mujoco

    return sum(int(getattr(mujoco.mjtState, f"mjSTATE_{part}")) for part in PARTS)


class EngineEnd:
    """The engine's end.

    Args:
        descriptor: of its socket.
        model, data: the world that is told of.
    """

    def __init__(self, descriptor: int, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        import mujoco
        import numpy as np

        self._socket = socket.socket(fileno=descriptor)
        self._socket.setblocking(False)
        self._model, self._data, self._signature = model, data, signature()
        self._state = np.zeros(mujoco.mj_stateSize(model, self._signature))
        self._unsent, self._unread = memoryview(b""), b""
        self.missed = 0
        """Frames that were not sent, as the other end had not read the one before."""

    def tell(self, facts: dict[str, Any]) -> bool:
        """Send a frame of the state that stands; False where the other end is gone."""
        import mujoco

        if not self._send():
            return False
        if len(self._unsent):
            self.missed += 1
            return True
        mujoco.mj_getState(self._model, self._data, self._state, self._signature)
        said, state = json.dumps(facts).encode(), self._state.tobytes()
        self._unsent = memoryview(HEAD.pack(len(said), len(state)) + said + state)
        return self._send()

    def _send(self) -> bool:
        with suppress(BlockingIOError):
            while len(self._unsent):
                try:
                    self._unsent = self._unsent[self._socket.send(self._unsent) :]
                except (BrokenPipeError, ConnectionError):
                    return False
        return True

    def lines(self) -> list[bytes] | None:
        """The lines that have come since the last time; None where the other end is gone."""
        ended = False
        try:
            while not ended:
                data = self._socket.recv(READS)
                ended = not data
                self._unread += data
                if len(self._unread) > MOST_LINE:
                    break
        except BlockingIOError:
            pass
        except ConnectionError:
            ended = True
        *lines, self._unread = self._unread.split(b"\n")
        if len(self._unread) > MOST_LINE:
            self._unread = b""
        return None if ended else lines

    def close(self) -> None:
        """Close the socket."""
        self._socket.close()


class Frames:
    """Takes frames out of the bytes of a stream, in whatever pieces they come."""

    def __init__(self) -> None:
        self._bytes = bytearray()

    def take(self, data: bytes) -> "list[tuple[dict[str, Any], np.ndarray]]":
        """The (facts, state) of each frame that these bytes complete; ValueError where they are no such stream."""
        import numpy as np

        self._bytes += data
        found = []
        while len(self._bytes) >= HEAD.size:
            said, state = HEAD.unpack_from(self._bytes)
            if said + state > MOST_FRAME:
                raise ValueError("this is no stream of states")
            end = HEAD.size + said + state
            if len(self._bytes) < end:
                break
            facts = json.loads(bytes(self._bytes[HEAD.size : HEAD.size + said]))
            found.append((facts, np.frombuffer(bytes(self._bytes[HEAD.size + said : end]))))
            del self._bytes[:end]
        return found

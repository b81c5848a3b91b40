"""Ask an author: show it the state of the world, and wait for its answer.

The author is another process (`Distant`) or, where nobody has to be kept out, a function of this one with an MjData of its
own (`Local`). Both see only copies, and both answer in the same way (`worldkit.speaking`).
"""

import ctypes
from typing import TYPE_CHECKING, Protocol

from worldkit.channel import HEAD, Channel, PeerError
from worldkit.mirror import Mirror
from worldkit.speaking import Control, Speaker, media_bytes, message_bytes

from .ports import Ports

if TYPE_CHECKING:
    from collections.abc import Sequence

    import mujoco

    from worldkit.laws import Law

BEGIN_S = ANSWER_S = 3600.0
"""The author's process may take so long, s, to be ready, and for one answer, where nobody watches it: a job's supervisor ends much
sooner what stands still, by the time that it has for itself and not by the clock."""


class Voice(Protocol):
    """The protocol of an author's link."""

    message: int
    """Address of the latest answer."""
    media: int
    """Address of what the laws tell beside it (`declared_media.Media.read`)."""

    def ask(self) -> int:
        """Copy the state for the author; returns the address of the copy, with which `go` lets the author begin."""

    def go(self) -> None:
        """Let the author begin."""

    def hear(self) -> None:
        """Wait until the answer is there."""

    def close(self) -> None:
        """End the link: the author will not be asked again."""


class Distant:
    """The author's process, at the other end of a channel.

    Args:
        model, data: the world, as it will be simulated.
        ports: the open inputs.
        channel: to the author's process.
    """

    def __init__(self, model: "mujoco.MjModel", data: "mujoco.MjData", ports: Ports, channel: Channel) -> None:
        import mujoco
        import numpy as np

        self._data, self._channel = data, channel
        self._mirror = mirror = Mirror(model, data)
        told = ports.as_meta()
        media = HEAD + message_bytes(ports.width, bool(ports.parameters))
        slots = [media + media_bytes(told.get("media")) + n * mirror.size for n in (0, 1)]
        at, size = slots[-1] + mirror.size, mujoco.mj_sizeModel(model)
        channel.size(at + size)
        mujoco.mj_saveModel(model, None, np.ctypeslib.as_array((ctypes.c_uint8 * size).from_address(channel.base + at)))
        self.message, self.media = channel.base + HEAD, channel.base + media
        self._slots = [channel.base + slot for slot in slots]
        self._turn = 0
        hello = {"ports": told, "message_at": HEAD, "slots_at": slots, "slot": mirror.size}
        channel.greet({**hello, "model_at": at, "model": size})
        with self:
            channel.greeting(BEGIN_S)

    def ask(self) -> int:
        """Copy the state into the slot that the author no longer reads."""
        self._turn += 1
        slot = self._slots[self._turn % 2]
        self._mirror.send(slot)
        return slot

    def go(self) -> None:
        """Give the other end its turn."""
        self._channel.post(self._turn)

    def hear(self) -> None:
        """Wait for the other end's turn.

        Raises:
            PeerError: the author's process ended, or keeps silent.
        """
        with self:
            self._channel.wait(self._turn, ANSWER_S)

    def close(self) -> None:
        """Hang up."""
        self._channel.close()

    def __enter__(self) -> None:
        return None

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        if isinstance(error, PeerError):
            cause = error.cause.replace("the process at the other end", "the author's process")
            raise PeerError(f"{cause} (t = {self._data.time:.4f} s)", "control", error.next_move) from None


class Local:
    """A function of this process, with an MjData of its own; `strays` lists what it wrote outside its ports."""

    def __init__(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        ports: Ports,
        control: Control | None,
        laws: "Sequence[Law]" = (),
    ) -> None:
        import copy

        import mujoco

        self._mirror = Mirror(model, data)
        mine = copy.copy(model)
        told = ports.as_meta()
        size = message_bytes(ports.width, bool(ports.parameters))
        media = size
        size += media_bytes(told.get("media"))
        self._memory = ctypes.create_string_buffer(size + self._mirror.size)
        self.message = ctypes.addressof(self._memory)
        self.media = self.message + media
        self._slot = self.message + size
        self.strays: list[str] = []
        stray = lambda name, of_model: self.strays.append(f"{'model' if of_model else 'data'}.{name}")  # noqa: E731
        self._speaker = Speaker(mine, mujoco.MjData(mine), control, told, self.message, stray, laws)

    def ask(self) -> int:
        """Copy the state into the only slot."""
        self._mirror.send(self._slot)
        return self._slot

    def go(self) -> None:
        """Do nothing: no process runs beside."""

    def hear(self) -> None:
        """Call the function."""
        self._speaker.answer(self._slot)
        self._speaker.look_around(self._slot)

    def close(self) -> None:
        """Do nothing: there is no channel to close."""

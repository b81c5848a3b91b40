"""The author's end of a simulation: a program's `control` gives the values of the declared inputs.

The engine's process owns the world. For each question it shows the state (`mirror`), this end lets `control` write to a
data of its own, and answers with one vector: the values of the declared inputs, in the order that the engine gave, and the
changed values of the declared parameters. Whatever else was written is gone with the next state, and is reported once
(`strays`).

A vector holds, in this order, the entries of `ARRAYS` that are declared, each array's in ascending order.
"""

import ctypes
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from .channel import Channel, PeerError
from .errors import ProgramError
from .laws import EACH, TOTALS, Law, Stepped
from .mirror import Mirror, words

if TYPE_CHECKING:
    import mujoco

HELD = ("ctrl", "qfrc_applied", "xfrc_applied")
"""Arrays whose entries act as long as they stand."""
STATE = ("qpos", "qvel", "act", "plastic", "mocap_pos", "mocap_quat", "userdata")
"""Arrays whose entries are the state itself: they act by being changed."""
SWITCHES = ("eq_active",)
ARRAYS = (*HELD, *STATE, *SWITCHES)
MOST_EDITS = 1 << 16
"""Parameter values in one answer."""
EDIT = [("array", "<i4"), ("index", "<i4"), ("value", "<f8")]
Control = Callable[["mujoco.MjModel", "mujoco.MjData"], object]


def message_bytes(width: int, edits: bool) -> int:
    """Size of an answer: how many parameter values it has, the vector, and those values."""
    return _lines(8 + 8 * width + (16 * MOST_EDITS if edits else 0))


def media_bytes(media: "dict[str, Any] | None") -> int:
    """Size of what laws tell beside an answer, after it: sums and points of each (`laws.Stepped`)."""
    return _lines(sum(8 * (TOTALS + EACH * int(row["points"])) for row in media["rows"])) if media else 0


def _lines(size: int) -> int:
    return 64 * -(-size // 64)


class Speaker:
    """Answers for one `control`.

    Args:
        model, data: the author's own; the model must be the engine's, bit for bit.
        control: the program's, with two arguments.
        ports: declared entries by array (flat indices), and under `parameters` those of the model's arrays; where its `media` are
            `alone`, `control` is not asked.
        message: address of the answer.
        laws: the program's, whose media the ports list.
        stray: called with (name of an array, whether it is the model's) for what was written outside the ports.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        control: Control | None,
        ports: dict[str, Any],
        message: int,
        stray: Callable[[str, bool], object],
        laws: Sequence[Law] = (),
    ) -> None:
        import numpy as np

        media = ports.get("media") or {}
        self._model, self._data, self._control = model, data, None if media.get("alone") else control
        self.mirror = Mirror(model, data, sends=False)
        numbers, self._index = self.mirror.numbers(ports, (*HELD, *STATE))
        self._numbers = numbers
        self._switches = np.array(ports.get("eq_active", ()), np.intp)
        first, second = len(self._index), len(self._index) + len(self._switches)
        self._vector = words(message + 8, first)
        self._switched = words(message + 8 + 8 * first, len(self._switches))
        self._parameters = (
            _Parameters(model, ports["parameters"], message, second, stray) if ports.get("parameters") else None
        )
        from .strays import Strays
        from .watch import Watch

        at = message + message_bytes(second, bool(ports.get("parameters")))
        self._laws = Stepped(laws, model, media, at) if laws or media else None
        self._watch = Watch(model) if self._laws is not None and self._parameters is None else None
        self._shown = np.zeros(first)
        edits = self._parameters is None
        self._strays = Strays(model, data, self.mirror, self._index, self._switches, edits, stray, control)

    def answer(self, slot: int) -> None:
        """Read the state at this address, let laws and `control` act on it, and write the answer."""
        self.mirror.receive(slot)
        if self._laws is not None:
            self._step_laws(self._laws)
            if self._laws.ended:  # nothing acts any more
                return
        if self._control is not None:
            self._control(self._model, self._data)
            # The law's word about its bodies is the last: what pushes them besides would stand in the ledger as the law's.
            if self._laws is not None and self._laws.push(self._data):
                self._strays.once("xfrc_applied", of_model=False)
        # `clip` because the default checks every index again; they were checked when they were made.
        self._numbers.take(self._index, out=self._vector, mode="clip")
        if len(self._switches):
            self._switched[:] = self._data.eq_active[self._switches]
        if self._parameters is not None:
            self._parameters.write()

    def _step_laws(self, laws: Stepped) -> None:
        """Advance the laws; of what they do to data and model, only the forces that they return reach the inputs."""
        self._numbers.take(self._index, out=self._shown, mode="clip")
        switched = self._data.eq_active[self._switches]
        if self._watch is not None:
            self._watch.changes()  # what `control` wrote goes nowhere, and is told as a stray
        laws.step(self._model, self._data)
        self._numbers[self._index] = self._shown
        self._data.eq_active[self._switches] = switched
        watches = [self._watch] if self._watch is not None else self._parameters.watches if self._parameters else []
        for edit in (edit for watch in watches for edit in watch.changes()):
            cause = f"a law writes model.{edit.array}"
            raise ProgramError(cause, "step", "leave the model: what a law does is its forces")
        laws.push(self._data)

    def look_around(self, slot: int) -> None:
        """Report what was written outside the ports; called after the answer was given."""
        self._strays.look(slot)


class _Parameters:
    """Declared parameters that `control` has changed since the last answer."""

    def __init__(
        self,
        model: "mujoco.MjModel",
        ports: list[list[Any]],
        message: int,
        width: int,
        stray: Callable[[str, bool], object],
    ) -> None:
        import numpy as np

        from .watch import Watch

        self._told: set[str] = set()
        self._tell = stray
        self.watches = [Watch(model), Watch(model, bulky=True)]
        self._ports = {name: (n, None if index is None else np.array(index)) for n, (name, index) in enumerate(ports)}
        self._count = ctypes.c_uint64.from_address(message)
        room = (ctypes.c_uint8 * (16 * MOST_EDITS)).from_address(message + 8 + 8 * width)
        self._edits = np.ctypeslib.as_array(room).view(np.dtype(EDIT))

    def _stray(self, array: str, of_model: bool) -> None:
        if array not in self._told:
            self._told.add(array)
            self._tell(array, of_model)

    def write(self) -> None:
        """Write the changed parameters into the message."""
        import numpy as np

        count = 0
        for edit in (edit for watch in self.watches for edit in watch.changes()):
            number, allowed = self._ports.get(edit.array, (-1, None))
            mine = np.ones(len(edit.index), bool) if allowed is None else np.isin(edit.index, allowed)
            if number < 0 or not mine.all():
                self._stray(edit.array, True)
            if number < 0 or not mine.any():
                continue
            end = count + int(mine.sum())
            if end > MOST_EDITS:
                raise ProgramError(f"more than {MOST_EDITS} parameters were changed at once", "control", "change fewer")
            part = self._edits[count:end]
            part["array"], part["index"], part["value"] = number, edit.index[mine], edit.values[mine]
            count = end
        self._count.value = count


def serve(
    control: Control | None, channel: Channel, stray: Callable[[str, bool], object], laws: Sequence[Law] = ()
) -> None:
    """Answer the engine at the other end of a channel until it hangs up.

    The engine's greeting holds `ports`, where in the memory the compiled model stands (`model_at`, `model` bytes), the answer
    (`message_at`) and the two slots (`slots_at`, of `slot` bytes).
    """
    import mujoco

    try:
        hello = channel.greeting()
    except PeerError:  # it ended before its first question, and reports why itself
        return
    channel.map()
    binary = ctypes.string_at(channel.base + hello["model_at"], hello["model"])
    model = mujoco.MjModel.from_binary_path("world.mjb", {"world.mjb": binary})
    del binary
    data = mujoco.MjData(model)
    speaker = Speaker(model, data, control, hello["ports"], channel.base + hello["message_at"], stray, laws)
    slots = [channel.base + at for at in hello["slots_at"]]
    if speaker.mirror.size != hello["slot"]:
        raise ProgramError("the engine's data has another size than this one's", "control", "use one mujoco build")
    channel.greet({"ready": True})
    turn = 1
    while channel.next(turn):
        slot = slots[turn % 2]
        speaker.answer(slot)
        channel.post(turn)
        speaker.look_around(slot)
        turn += 1

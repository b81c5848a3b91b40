"""Read an author's answers: one vector of the declared inputs, checked, then written into the world.

Entries come in the order of `worldkit.speaking.ARRAYS`. Forces, controls and torques act as long as they are not
changed. Entries of the state act by being changed: an answer that leaves a position as it was shown does not hold the body
there, and reads NaN once it is checked. Changed parameters come beside the vector, as values of the model's arrays.
"""

import ctypes
import math
from typing import TYPE_CHECKING

from worldkit.channel import PeerError
from worldkit.mirror import Mirror, memory
from worldkit.model_arrays import LOOKS, Edit
from worldkit.speaking import EDIT, HELD, MOST_EDITS, STATE, SWITCHES

from .ports import Ports, flat

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..variants.holding import Shares


class Answers:
    """The latest answer, and the way in which it gets into the data.

    Args:
        model, data: the world; parameters are written into the model.
        ports: the open inputs.
        shares: the shares of it that a variant leaves; None leaves everything.
    """

    def __init__(
        self, model: "mujoco.MjModel", data: "mujoco.MjData", ports: Ports, shares: "Shares | None" = None
    ) -> None:
        import numpy as np

        self._model, self._data, self.shares = model, data, shares
        mirror = Mirror(model, data, sends=False)
        self._numbers, self._held = mirror.numbers(ports.entries, HELD)
        _, self._state = mirror.numbers(ports.entries, STATE)
        self._switches = np.array(ports.entries.get(SWITCHES[0], ()), np.intp)
        first, second = len(self._held), len(self._held) + len(self._state)
        self._raw = np.zeros(8 * (1 + second + len(self._switches)), np.uint8)
        self._own, self._latest = self._raw.data, b""
        """Memory of the latest answer, and that answer as it came."""
        self._sent: dict[int, memoryview] = {}
        """The memory that answers come in, by address."""
        self.vector = self._raw[8:].view(float)
        """(width,) the latest answer."""
        self._ones = np.ones(len(self.vector))
        self.news = True
        """Whether the latest answer differs from the one before; always where entries act by being changed."""
        self.changing = self.vector[first:]
        """Its entries that act by being changed; NaN where they are not."""
        self._pushes, self._moves, self._flips = self.vector[:first], self.vector[first:second], self.vector[second:]
        self._shown_state = self._numbers[self._state]
        self._shown_switches = np.array(data.eq_active[self._switches], float)
        self._ports = [(name, None if index is None else np.array(index)) for name, index in ports.parameters]
        self.acts_once = bool(len(self.changing) or self._ports)
        """Whether an answer can do more than set what holds until it is written again."""
        # Where it cannot, an answer like the last one changes nothing.
        self._lasts = not (self.acts_once or shares is not None)
        self.edits: list[Edit] = []
        """Parameters that the latest answer changes."""
        self._slot_first = mirror.buffer_in(0)
        if shares is not None:
            shares.begin(model, data, ports)

    def shown(self, slot: int) -> None:
        """Prepare the state in the slot at this address for the author: held inputs show what the author itself wrote."""
        if self.shares is not None and self._numbers.size:
            copy = ctypes.c_double * self._numbers.size
            import numpy as np

            there = np.ctypeslib.as_array(copy.from_address(slot + self._slot_first))
            self.shares.show(there, self._held, self._state)
            if len(self._state):
                there.take(self._state, out=self._shown_state, mode="clip")
        elif len(self._state):
            self._numbers.take(self._state, out=self._shown_state, mode="clip")
        if len(self._switches):
            self._shown_switches[:] = self._data.eq_active[self._switches]

    def read(self, message: int) -> None:
        """Take an answer from this address, once, and check it.

        Raises:
            PeerError: a number is not finite, or a parameter is not declared.
        """
        import numpy as np

        sent = self._sent.get(message)
        if sent is None:
            sent = self._sent[message] = memory(message, len(self._own))
        answer = sent.tobytes()  # once: the author could write on
        if self._lasts and answer == self._latest:
            self.news = False
            return
        self._own[:] = answer
        self.news = True
        # The sum of finite numbers may overflow; then each of them is looked at.
        if not math.isfinite(self.vector.dot(self._ones)) and not np.isfinite(self.vector).all():
            raise PeerError("the author's process answers with a number that is not finite", "control", "send numbers")
        self._latest = answer
        if len(self._moves):
            self._moves[self._moves == self._shown_state] = np.nan
        if len(self._flips):
            self._flips[self._flips == self._shown_switches] = np.nan
        self.edits = list(self._edited(int(self._raw[:8].view(np.uint64)[0]), message)) if self._ports else []

    @property
    def changes(self) -> bool:
        """Whether the latest answer changes the state itself."""
        import numpy as np

        return bool(len(self.changing)) and not np.isnan(self.changing).all()

    def push(self) -> None:
        """Write the forces, torques and controls."""
        self._numbers[self._held] = self._pushes if self.shares is None else self.shares.of_pushes(self._pushes)

    def change(self) -> None:
        """Write the changes of the state."""
        import numpy as np

        written, flipped = ~np.isnan(self._moves), ~np.isnan(self._flips)
        if self.shares is not None:
            self.shares.change(self._moves, self._flips)
            return
        self._numbers[self._state[written]] = self._moves[written]
        self._data.eq_active[self._switches[flipped]] = self._flips[flipped] != 0

    def edit(self) -> list[Edit]:
        """Write the changed parameters; returns what really changed."""
        import numpy as np

        made = []
        for edit in self.edits:
            live = flat(self._model, edit.array)
            values = edit.values if self.shares is None else self.shares.of_parameters(edit)
            values = np.asarray(values).astype(live.dtype)
            new = live[edit.index] != values
            if not new.any():
                continue
            option = edit.array.removeprefix("opt.")
            if option != edit.array:  # an option is noted as a whole
                new[:] = True
            made.append(Edit(edit.array, edit.index[new], values[new].astype(float), edit.looks_only))
            if option != edit.array and not isinstance(now := getattr(self._model.opt, option), np.ndarray):
                setattr(self._model.opt, option, type(now)(values[-1]))
            else:
                live[edit.index] = values
        return made

    def _edited(self, count: int, message: int) -> "list[Edit]":
        import numpy as np

        if count > MOST_EDITS:
            raise PeerError("the author's process answers with too many parameters", "control", "change fewer")
        if not count:
            return []
        edits = np.frombuffer(ctypes.string_at(message + self._raw.nbytes, 16 * count), np.dtype(EDIT))
        found = []
        for number in np.unique(edits["array"]).tolist():
            if not 0 <= number < len(self._ports):
                raise PeerError("the author's process names a parameter that is not declared", "control", "declare it")
            (name, allowed), mine = self._ports[number], edits[edits["array"] == number]
            index, values = mine["index"].astype(np.intp), mine["value"].copy()
            size = len(flat(self._model, name))
            good = bool((index >= 0).all() and (index < size).all() and np.isfinite(values).all())
            if not good or (allowed is not None and not np.isin(index, allowed).all()):
                raise PeerError(f"the author's process writes what is not declared of {name}", "control", "declare it")
            found.append(Edit(name, index, values, any(part in name for part in LOOKS)))
        return found

    def replay(self, vector: "np.ndarray", edits: "list[Edit]") -> None:
        """Take a recorded answer."""
        self.vector[:] = vector
        self.news, self.edits = True, edits

"""Noticing what a program writes into its own model, at the author's end, to send it: one memory comparison a step, names only
when something changed. The engine's end notices nothing: what it is not sent does not reach the world.

All arrays of an MjModel lie in one allocation. The ones worth watching are compared as a few contiguous blocks; the
few microseconds this takes do not depend on how many arrays there are.
"""

from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any, TypeAlias

from .model_arrays import BULKY, LOOKS, OPTIONS, SHAPES, Edit

if TYPE_CHECKING:
    import mujoco
    import numpy as np

_Block: TypeAlias = "tuple[Callable[[], bool], np.ndarray, np.ndarray, list[tuple[str, np.ndarray, np.ndarray]]]"
"""Whether it differs, the live memory, its copy, and the arrays in it: name, live array, view into the copy."""


class Watch:
    """Remembers a model's arrays and options, and finds what differs from one `changes()` to the next."""

    def __init__(self, model: "mujoco.MjModel", bulky: bool = False) -> None:
        """With `bulky`, watch the large assets that shape the motion instead of everything else."""
        import numpy as np

        self._model = model
        arrays = {
            name: array
            for name in dir(model)
            if (name in SHAPES if bulky else not name.startswith(("_", *BULKY)))
            and isinstance(array := getattr(model, name), np.ndarray)
            if array.nbytes and array.flags.c_contiguous
        }
        self._blocks: list[_Block] = []
        run: list[tuple[str, np.ndarray]] = []
        for name, array in sorted(arrays.items(), key=lambda item: _address(item[1])):
            if run and not 0 <= _address(array) - _end(run[-1][1]) < 64:
                self._add_block(run)
                run = []
            run.append((name, array))
        if run:
            self._add_block(run)
        # Arrays are views into the model's options, which stay where they are; numbers are read again.
        self._option_names = () if bulky else tuple(name for name in OPTIONS if hasattr(model.opt, name))
        self._options = self._read_options()
        memory = None if bulky else _memory_of_options(model)
        self._option_memory = memory
        self._old_option_memory = None if memory is None else memory.copy()
        self._options_differ = (
            (lambda: True) if memory is None else comparison(memory, self._old_option_memory)  # type: ignore[arg-type]
        )

    def changes(self) -> list[Edit]:
        """What was edited since the last call (or the construction); remembered from now on."""
        import numpy as np

        edits: list[Edit] = []
        for differ, live, copy, arrays in self._blocks:
            if differ():
                for name, array, old in arrays:
                    # Compared as bytes, so that a NaN equals itself.
                    different = (array.reshape(-1, 1).view(np.uint8) != old.reshape(-1, 1).view(np.uint8)).any(axis=1)
                    if different.any():
                        index = np.flatnonzero(different)
                        looks = any(part in name for part in LOOKS)
                        edits.append(Edit(name, index, array.reshape(-1)[index].astype(float), looks))
                copy[:] = live
        if self._options_differ():
            options = self._read_options()
            for name, old_value in self._options.items():
                if options[name].tobytes() != old_value.tobytes():
                    values = options[name].astype(float)
                    edits.append(Edit(f"opt.{name}", np.arange(len(values)), values, looks_only=False))
            self._options = options
            if self._old_option_memory is not None:
                self._old_option_memory[:] = self._option_memory
        return edits

    def _read_options(self) -> "dict[str, np.ndarray]":
        import numpy as np

        return {name: np.array(getattr(self._model.opt, name)).reshape(-1) for name in self._option_names}

    def _add_block(self, run: "list[tuple[str, np.ndarray]]") -> None:
        """Watch neighbouring arrays as one block of bytes."""
        start = _address(run[0][1])
        live = span([array for _, array in run])
        copy = live.copy()
        arrays = []
        for name, array in run:
            offset = _address(array) - start
            old = copy[offset : offset + array.nbytes].view(array.dtype).reshape(array.shape)
            arrays.append((name, array, old))
        self._blocks.append((comparison(live, copy), live, copy, arrays))


def span(arrays: "list[np.ndarray]") -> "np.ndarray":
    """(N,) bytes from the first to the last of neighbouring arrays, gaps between them (alignment) included; a view."""
    import numpy as np

    first = arrays[0].reshape(-1).view(np.uint8)
    size = _end(arrays[-1]) - _address(arrays[0])
    return np.lib.stride_tricks.as_strided(first, shape=(size,), strides=(1,), writeable=False)


def _memory_of_options(model: "mujoco.MjModel") -> "np.ndarray | None":
    """(N,) bytes of the model's options, as a view; None when they are not laid out as the headers say.

    Asking for thirty numbers one by one takes as long as comparing the whole model.
    """
    import ctypes

    import numpy as np
    from mujoco.introspect.structs import STRUCTS

    kinds = {"mjtNum": ctypes.c_double, "int": ctypes.c_int, "float": ctypes.c_float}
    fields: list[tuple[str, Any]] = []
    for field in STRUCTS["mjOption"].fields:
        inner = str(getattr(field.type, "inner_type", field.type))
        extents = getattr(field.type, "extents", ())
        kind = kinds.get(inner)
        if kind is None or len(extents) > 1:
            return None
        fields.append((field.name, kind * extents[0] if extents else kind))
    layout = type("Options", (ctypes.Structure,), {"_fields_": fields})
    options = layout.from_address(_address(model.opt.gravity) - layout.gravity.offset)  # type: ignore[attr-defined]
    for name, _ in fields:
        if (
            np.array(getattr(model.opt, name)).reshape(-1).tolist()
            != np.array(getattr(options, name)).reshape(-1).tolist()
        ):
            return None
    return np.frombuffer(options, np.uint8)


def comparison(one: "np.ndarray", other: "np.ndarray") -> Callable[[], bool]:
    """A function that tells whether two contiguous arrays of one size differ in memory, as fast as the C library can.

    The arrays must stay where they are.
    """
    compare = _memcmp()
    if compare is None:
        return lambda: one.tobytes() != other.tobytes()
    first, second, size = _address(one), _address(other), one.nbytes

    def differ(_kept: Any = (one, other)) -> bool:  # memory that is compared must not be given back
        return bool(compare(first, second, size))

    return differ


@cache
def _memcmp() -> Any:
    """The C library's `memcmp`, called without releasing the interpreter's lock; None where it cannot be found."""
    import ctypes

    try:
        function = ctypes.PyDLL(None).memcmp
    except (AttributeError, OSError, TypeError):  # not on Windows
        return None
    function.argtypes = (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t)
    function.restype = ctypes.c_int
    return function


def _address(array: "np.ndarray") -> int:
    return int(array.__array_interface__["data"][0])


def _end(array: "np.ndarray") -> int:
    return _address(array) + int(array.nbytes)

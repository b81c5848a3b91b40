"""What a `control` wrote that is no declared input: it has no effect, and is reported once, with the line that wrote it.

The search comes after the answer was given, so nothing waits for it. The state and the inputs are compared at every question,
and so is what the engine derives from them, up to `MOST_DERIVED` bytes; the model's arrays, contacts and larger worlds now and
then: an edit of those would have to be made again and again to matter. What derives from the state changes, too, when a
`control` lets the engine compute it again, which nobody has to be told: where a program calls the engine, only arrays that its
text writes are named.
"""

import ast
import ctypes
import inspect
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .mirror import Mirror, address, differ, move, words

if TYPE_CHECKING:
    import mujoco
    import numpy as np

SAMPLE = 64
"""How many questions lie between two searches of everything."""
RANGES = (("qpos", "qacc_warmstart"), ("ctrl", "qacc"), ("userdata", "sensordata"))
"""Neighbours in memory that only a program or a step writes: from the first up to the second."""
STATE = (
    "qpos", "qvel", "act", "plastic", "ctrl", "qfrc_applied", "xfrc_applied", "eq_active", "mocap_pos", "mocap_quat", "userdata",
)  # fmt: skip
DERIVED = (
    "qacc_warmstart", "qacc", "act_dot", "sensordata", "xpos", "xquat", "xmat", "xipos", "ximat", "geom_xpos", "geom_xmat",
    "site_xpos", "site_xmat", "subtree_com", "cdof", "ten_length", "actuator_length", "cvel", "qM", "M", "qfrc_bias", "qfrc_spring",
    "qfrc_damper", "qfrc_passive", "qfrc_gravcomp", "subtree_linvel", "actuator_force", "qfrc_actuator", "qfrc_smooth",
    "qfrc_constraint", "cacc", "cfrc_ext",
)  # fmt: skip
"""What the engine derives, and a person could take for an input."""
MOST_DERIVED = 64 << 10
SOLVES = ("mj_", "LettingGo")
"""How the names begin of what lets the engine compute again."""


class Strays:
    """Compares a data with the state that was shown, less the declared entries.

    Args:
        model, data: the author's own.
        mirror: of that data.
        index: declared entries, as numbers of the buffer.
        switches: declared equalities.
        parameters: whether to look at the model too.
        tell: called with the name of an array, and whether it is the model's.
        control: whose text tells what it writes.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        mirror: Mirror,
        index: "np.ndarray",
        switches: "np.ndarray",
        parameters: bool,
        tell: Callable[[str, bool], object],
        control: Callable[..., object] | None = None,
    ) -> None:
        import numpy as np

        from .watch import Watch

        self._data, self._mirror, self._tell = data, mirror, tell
        self._looks = 0
        self._buffer = mirror.buffer
        self._inputs_at = mirror.at("ctrl")
        self._ranges = []
        for first, last in RANGES:
            start, end = mirror.at(first), mirror.at(last)
            if start == end:
                continue
            mine = index[(index >= start // 8) & (index < end // 8)] - start // 8
            shown = np.zeros(end - start, np.uint8)
            live = words(self._buffer + start, (end - start) // 8)
            self._ranges.append((start, end - start, shown, address(shown), shown.view(float), live, mine))
        self._switches = mirror.at("eq_active") - mirror.at("ctrl") + switches
        self._watch = Watch(model) if parameters else None
        self._told: set[str] = set()
        self._derived = Derived(data, mirror, control)

    def look(self, slot: int) -> None:
        """Report what differs from the slot at this address, which must still hold the state that was shown."""
        shown_at = self._mirror.buffer_in(slot)
        for start, size, shown, copied_at, numbers, live, mine in self._ranges:
            move(copied_at, shown_at + start, size)
            if len(mine):
                numbers[mine] = live[mine]
            if start == self._inputs_at and len(self._switches):
                shown[self._switches] = live.view("u1")[self._switches]
            if differ(copied_at, self._buffer + start, size):
                self._name(start, live.view("u1") != shown)
        sample = self._looks % SAMPLE == 0
        for name in self._derived.written(slot, shown_at, sample=sample):
            self.once(name, of_model=False)
        if sample and self._watch is not None:
            for edit in self._watch.changes():
                self.once(edit.array, of_model=True)
        self._looks += 1

    def _name(self, start: int, different: "np.ndarray") -> None:
        """Report the arrays in which these bytes lie."""
        for name in STATE:
            array = getattr(self._data, name)
            at = self._mirror.at(name) - start
            if 0 <= at < len(different) and array.size and different[at : at + array.nbytes].any():
                self.once(name, of_model=False)

    def once(self, name: str, *, of_model: bool) -> None:
        """Tell of an array, the first time."""
        if name not in self._told:
            self._told.add(name)
            self._tell(name, of_model)


class Derived:
    """Finds arrays that the engine derives and that a `control` wrote."""

    def __init__(self, data: "mujoco.MjData", mirror: Mirror, control: Callable[..., object] | None) -> None:
        self._mirror, self._buffer = mirror, mirror.buffer
        tree = _tree(control)
        known = [name for name in DERIVED if hasattr(data, name) and getattr(data, name).size]
        names = [*known, "time", "contact"]
        if any(isinstance(node, ast.Attribute) and node.attr.startswith(SOLVES) for node in ast.walk(tree)):
            said = {node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
            # A search for each array in a long program would take longer than starting its process.
            names = [name for name in names if said.intersection(_words(name)) and any(_written(tree, name))]
        self._arrays = [(name, mirror.at(name), getattr(data, name).nbytes) for name in names if name in known]
        self._time = ctypes.c_double.from_address(mirror.time_at) if "time" in names else None
        self._contact = "contact" in names
        ends = ((mirror.at("qacc_warmstart"), mirror.at("ctrl")), (mirror.at("qacc"), mirror.at("userdata")))
        spans = [*ends, (mirror.at("sensordata"), mirror.buffer_bytes)]
        self._spans = [(start, self._buffer + start, end - start) for start, end in spans if end > start]
        self._all = len(self._arrays) == len(known)
        self._large = sum(size for *_, size in self._spans) > MOST_DERIVED

    def written(self, slot: int, shown_at: int, *, sample: bool) -> Iterator[str]:
        """Names of arrays that differ from the slot at this address, whose buffer begins at `shown_at`, each once."""
        if self._arrays and (sample or not self._large) and (not self._all or self._differs(shown_at)):
            found = [a for a in self._arrays if differ(shown_at + a[1], self._buffer + a[1], a[2])]
            self._arrays = [a for a in self._arrays if a not in found]
            # Where nothing was found, what differs is none of the list: looking at every question would find no more.
            self._large |= not found
            yield from (name for name, _, _ in found)
        if self._time is not None and self._time.value != self._mirror.time_in(slot):
            self._time = None
            yield "time"
        if sample and self._contact and self._mirror.contacts_differ(slot):
            self._contact = False
            yield "contact"

    def _differs(self, shown_at: int) -> bool:
        return any(differ(shown_at + start, live, size) for start, live, size in self._spans)


def line_of(control: Any, array: str) -> tuple[str, int]:
    """(file, line) of the statement in a program that writes an array, else that mentions it, else of `control` itself."""
    code = getattr(control, "__code__", None)
    if code is None:
        return "", 0
    tree = _tree(control)
    lines = sorted(_written(tree, array)) or sorted(_mentioned(tree, array))
    return code.co_filename, lines[0] if lines else code.co_firstlineno


def _tree(control: Any) -> ast.AST:
    """The program's file, parsed; nothing where it cannot be."""
    code = getattr(inspect.unwrap(control) if callable(control) else None, "__code__", None)
    try:
        return ast.parse(Path(code.co_filename).read_text(encoding="utf-8")) if code else ast.Module([], [])
    except (OSError, ValueError, SyntaxError):
        return ast.Module([], [])


def _written(tree: ast.AST, array: str) -> Iterator[int]:
    """Lines that write an array: by its own name, by a name that it was given (`x = data.xpos`), or by `fill` and `copyto`."""
    also = {
        target.id
        for node in ast.walk(tree)
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Attribute) and any(_mentioned(node.value, array))
        for target in node.targets
        if isinstance(target, ast.Name)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in ("fill", "copyto"):
            yield from _mentioned(node, array)
        targets = (
            node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, ast.AugAssign) else []
        )
        for target in targets:
            yield from _mentioned(target, array)
            if not isinstance(target, ast.Name):
                yield from (n.lineno for n in ast.walk(target) if isinstance(n, ast.Name) and n.id in also)


def _mentioned(tree: ast.AST, array: str) -> Iterator[int]:
    words = _words(array)
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and node.attr in words:
            yield node.lineno


def _words(array: str) -> tuple[str, ...]:
    """What a program calls an array; a view by name leaves out its prefix: `data.body("ball").xpos`, `model.geom("skin").friction`."""
    prefix, _, rest = array.partition("_")
    return (array, rest) if prefix in ("geom", "body", "jnt", "dof", "actuator", "eq") else (array,)

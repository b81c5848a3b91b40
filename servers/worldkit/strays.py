"""What a `control` wrote that is no declared input: it has no effect, and is reported once, with the line that wrote it.

The search comes after the answer was given, so nothing waits for it. The state and the inputs are compared at every question;
the model's arrays, and derived quantities that the program's source mentions, now and then: an edit of those would have to be
made again and again to matter.
"""

import ast
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .mirror import Mirror, address, differ, move, words

if TYPE_CHECKING:
    import mujoco
    import numpy as np

SAMPLE = 64
"""How many questions lie between two searches of everything."""
RANGES = (("qpos", "qacc_warmstart"), ("ctrl", "qacc"))
"""Neighbours in memory that only a program or a step writes: from the first up to the second."""


class Strays:
    """Compares a data with the state that was shown, less the declared entries.

    Args:
        model, data: the author's own.
        mirror: of that data.
        index: declared entries, as numbers of the buffer.
        switches: declared equalities.
        parameters: whether to look at the model too.
        tell: called with the name of an array, and whether it is the model's.
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
    ) -> None:
        import numpy as np

        from .watch import Watch

        self._data, self._mirror, self._tell = data, mirror, tell
        self._looks = 0
        self._buffer = mirror.buffer
        self._ranges = []
        for first, last in RANGES:
            start, end = mirror.at(first), mirror.at(last)
            mine = index[(index >= start // 8) & (index < end // 8)] - start // 8
            shown = np.zeros(end - start, np.uint8)
            live = words(self._buffer + start, (end - start) // 8)
            self._ranges.append((start, end - start, shown, shown.view(float), live, mine))
        self._switches = mirror.at("eq_active") - self._ranges[1][0] + switches
        self._watch = Watch(model) if parameters else None
        self._told: set[str] = set()

    def look(self, slot: int) -> None:
        """Report what differs from the slot at this address, which must still hold the state that was shown."""
        shown_at = self._mirror.buffer_in(slot)
        for n, (start, size, shown, numbers, live, mine) in enumerate(self._ranges):
            move(address(shown), shown_at + start, size)
            if len(mine):
                numbers[mine] = live[mine]
            if n == 1 and len(self._switches):
                shown[self._switches] = live.view("u1")[self._switches]
            if differ(address(shown), self._buffer + start, size):
                self._name(start, live.view("u1") != shown)
        if self._looks % SAMPLE == 0 and self._watch is not None:
            for edit in self._watch.changes():
                self._once(edit.array, of_model=True)
        self._looks += 1

    def _name(self, start: int, different: "np.ndarray") -> None:
        """Report the arrays in which these bytes lie."""
        for name in (
            "qpos", "qvel", "act", "plastic", "ctrl", "qfrc_applied", "xfrc_applied", "eq_active", "mocap_pos", "mocap_quat",
            "userdata",
        ):  # fmt: skip
            array = getattr(self._data, name)
            at = self._mirror.at(name) - start
            if 0 <= at < len(different) and array.size and different[at : at + array.nbytes].any():
                self._once(name, of_model=False)

    def _once(self, name: str, *, of_model: bool) -> None:
        if name not in self._told:
            self._told.add(name)
            self._tell(name, of_model)


def line_of(control: Any, array: str) -> tuple[str, int]:
    """(file, line) of the statement in a program that writes an array, else that mentions it, else of `control` itself."""
    code = getattr(control, "__code__", None)
    if code is None:
        return "", 0
    try:
        tree = ast.parse(Path(code.co_filename).read_text(encoding="utf-8"))
    except (OSError, ValueError, SyntaxError):
        return code.co_filename, code.co_firstlineno
    lines = sorted(_written(tree, array)) or sorted(_mentioned(tree, array))
    return code.co_filename, lines[0] if lines else code.co_firstlineno


def _written(tree: ast.AST, array: str) -> Iterator[int]:
    for node in ast.walk(tree):
        targets = (
            node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, ast.AugAssign) else []
        )
        for target in targets:
            yield from _mentioned(target, array)


def _mentioned(tree: ast.AST, array: str) -> Iterator[int]:
    # A view by name leaves out the array's own prefix: `data.body("ball").xpos`, `model.geom("skin").friction`.
    short = (
        array.partition("_")[2] if array.partition("_")[0] in ("geom", "body", "jnt", "dof", "actuator", "eq") else ""
    )
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and node.attr in (array, short):
            yield node.lineno

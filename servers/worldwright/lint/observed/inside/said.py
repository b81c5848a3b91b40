"""Events of the watched run, one line of JSON each, written at once, so that nothing is lost when it ends badly."""

import json
import os
import sys
from types import FrameType
from typing import Any

MOST = 400


class Said:
    """Events of one run: what happened, on which line of the program, with what values."""

    def __init__(self) -> None:
        self.program = ""
        self.file: Any = None
        self.seen: set[tuple[Any, ...]] = set()
        self.quiet = False

    def frame(self, depth: int = 2) -> FrameType | None:
        """The innermost frame that runs the program's own text."""
        frame: FrameType | None = sys._getframe(depth)
        while frame is not None and frame.f_code.co_filename != self.program:
            frame = frame.f_back
        return frame

    def line(self) -> int:
        """The line of the program that runs now."""
        frame = self.frame(3)
        return frame.f_lineno if frame is not None else 0

    def stack(self) -> list[tuple[int, int]]:
        """(identity of the frame, line) of the program's frames, outermost first."""
        found: list[tuple[int, int]] = []
        frame: FrameType | None = sys._getframe(2)
        while frame is not None:
            if frame.f_code.co_filename == self.program:
                found.append((id(frame), frame.f_lineno))
            frame = frame.f_back
        return found[::-1]

    def event(self, code: str, line: int = 0, **values: Any) -> None:
        """Write an event down, once for each line of the program."""
        line = line or self.line()
        key = (code, line, values.get("name"))
        if self.quiet or not line or key in self.seen or len(self.seen) > MOST or self.file is None:
            return
        self.seen.add(key)
        plain = {k: v if isinstance(v, bool | int | float | str) else str(v) for k, v in values.items()}
        self.file.write(json.dumps({"code": code, "line": int(line), **plain}) + "\n")
        self.file.flush()
        os.fsync(self.file.fileno())


SAID = Said()


def meeting(one: list[tuple[int, int]], other: list[tuple[int, int]]) -> int:
    """The line of `other` in the innermost frame that both stacks share: where their order is decided."""
    line = other[0][1] if other else 0
    for (a, _), (b, there) in zip(one, other, strict=False):
        if a != b:
            break
        line = there
    return line

"""What a word of a film cannot use is refused as all else is, with the author's line, whatever Python thinks of it."""

import functools
import inspect
import sys
from collections.abc import Callable
from typing import Any, TypeVar

from ..errors import ProgramError

Kind = TypeVar("Kind", bound=type)
MISUSE = (TypeError, ValueError, ArithmeticError, AttributeError, LookupError)
INTERNAL = ("description",)
"""What no author calls."""


class NoTimeError(ProgramError):
    """A span of recorded time that a film reckons ends no later than it begins."""


def refusing(kind: Kind) -> Kind:
    """Let the public methods of a class, its parents' too, raise a `ProgramError` where they are given what they cannot use."""
    for name, method in inspect.getmembers(kind, inspect.isfunction):
        if not name.startswith("_") and name not in INTERNAL:
            setattr(kind, name, _refusing(name, method))
    return kind


def whole(seed: Any, least: int = 0) -> int:
    """A number that is whole by its kind, such as a seed; a `ProgramError` for any other, and for one below `least`."""
    if isinstance(seed, bool) or not hasattr(seed, "__index__") or not seed >= least:
        raise ProgramError(f"{seed!r} is no whole number from {least}", "film.py", "seed=1, say")
    return int(seed)


def line() -> int:
    """The line of film.py that is at work."""
    frame: Any = sys._getframe(1)
    while frame is not None and not frame.f_code.co_filename.endswith("film.py"):
        frame = frame.f_back
    return int(frame.f_lineno) if frame is not None else 1


def _refusing(name: str, method: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(method)
    def call(*given: Any, **named: Any) -> Any:
        try:
            return method(*given, **named)
        except MISUSE as error:
            if _of_the_author(error):
                raise
            raise ProgramError(
                f"film.{name} cannot use what it is given: {error}", "film.py", _words(method)
            ) from error

    return call


def _of_the_author(error: BaseException) -> bool:
    """Whether it happened in a function that the author gave, which the traceback names better."""
    step = error.__traceback__
    while step is not None:
        if step.tb_frame.f_code.co_filename.endswith("film.py"):
            return True
        step = step.tb_next
    return False


def _words(method: Callable[..., Any]) -> str:
    """How it is called."""
    told = str(inspect.signature(method)).removeprefix("(self, ").removesuffix(" -> None")
    return f"film.{method.__name__}({told}"

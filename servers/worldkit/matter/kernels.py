"""Compiled functions: numba, one thread, no fast mathematics, so that each run has the same bits on one machine."""

from collections.abc import Callable
from typing import Any

from ..errors import ProgramError


def kernel(function: Callable[..., Any]) -> Any:
    """The function, compiled at its first call, and kept beside its file where that may be written.

    Without numba it refuses to be called.
    """
    try:
        import numba
    except ImportError:

        def lacking(*_: Any) -> Any:
            cause = "matter needs numba, which is not installed"
            raise ProgramError(cause, "worldkit.matter", "install it: pip install 'worldwright[matter]'")

        return lacking
    try:
        return numba.njit(cache=True, error_model="numpy")(function)
    except RuntimeError:  # nowhere to keep it: a sandbox without a home
        return numba.njit(error_model="numpy")(function)

"""Compiled functions: numba, one thread, no fast mathematics, so that each run has the same bits on one machine."""

import functools
import hashlib
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ..errors import ProgramError


def kernel(function: Callable[..., Any]) -> Any:
    """The function, compiled at its first call, and kept beside its file, or where a copy of that may be written.

    Without numba it refuses to be called.
    """
    try:
        import numba
    except ImportError:

        def lacking(*_: Any) -> Any:
            cause = "matter needs numba, which is not installed"
            raise ProgramError(cause, "worldkit.matter", "install it: pip install 'worldwright[matter]'")

        return lacking
    _keep(numba)
    try:
        return numba.njit(cache=True, error_model="numpy")(function)
    except RuntimeError:  # it may be kept nowhere
        return numba.njit(error_model="numpy")(function)


@functools.cache
def _keep(numba: Any) -> None:
    """Let a confined process, which may not write here, begin from a copy of what was compiled before it."""
    beside = Path(__file__).parent / "__pycache__"
    try:
        tempfile.TemporaryFile(dir=beside).close()
    except OSError:
        # numba looks for what is kept in a folder named after that of the source.
        named = f"{beside.parent.name}_{hashlib.sha1(str(beside.parent).encode(), usedforsecurity=False).hexdigest()}"
        try:
            folder = Path(tempfile.mkdtemp(prefix="compiled-"))
            (folder / named).mkdir()
            for file in beside.glob("*.nb[ic]"):
                shutil.copy(file, folder / named)
            numba.config.CACHE_DIR = str(folder)
        except OSError:
            return

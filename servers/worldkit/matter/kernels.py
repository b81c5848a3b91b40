"""Compiled functions: numba, one thread, no fast mathematics, so that each run has the same bits on one machine."""

import atexit
import functools
import hashlib
import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ..errors import ProgramError
from ..kept_kernels import BESIDE, compiled


def kernel(function: Callable[..., Any]) -> Any:
    """The function, compiled at its first call, and kept beside its file, or where numba keeps what a user may not write there.

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
    try:
        BESIDE.mkdir(exist_ok=True)
        tempfile.TemporaryFile(dir=BESIDE).close()
    except OSError:
        if not compiled() or not (kept := list(BESIDE.glob("*.nb[ic]"))):
            return  # what is kept is of other sources, or nothing is; numba has a place of the user's own
        # numba looks for what is kept in a folder named after that of the source.
        here = BESIDE.parent
        named = f"{here.name}_{hashlib.sha1(str(here).encode(), usedforsecurity=False).hexdigest()}"
        try:
            folder = Path(tempfile.mkdtemp(prefix="compiled-"))
            atexit.register(_remove, folder, os.getpid())
            (folder / named).mkdir()
            for file in kept:
                shutil.copyfile(file, folder / named / file.name)  # a confined process may not change modes
            numba.config.CACHE_DIR = str(folder)
        except OSError:
            return


def _remove(folder: Path, owner: int) -> None:
    """Remove the copy when the process ends that made it, not when one ends that it was split off."""
    if os.getpid() == owner:
        shutil.rmtree(folder, ignore_errors=True)

"""What numba compiles for a law of `worldkit.matter`, made before the job begins that needs it.

A confined process may not keep what it compiles, and compiles while the engine waits for its answer. So our own code is compiled
by a process of ours, once on a machine, outside the job's sandbox and before its limits count.
"""

import re
import subprocess
from collections.abc import Callable
from pathlib import Path

from worldkit import kept_kernels

USED = re.compile(rb"^\s*(from|import)\s+worldkit\b(.*|\s+import\s*\([^)]*)\bmatter\b", re.MULTILINE)
TICK_S = 0.2


def lacking(inputs: Path) -> bool:
    """Whether a program, or a file beside it, imports matter that is not compiled for what is here, and could be kept."""
    if not any(USED.search(path.read_bytes()) for path in inputs.rglob("*.py") if path.is_file()):
        return False
    return bool(kept_kernels.numba()) and not kept_kernels.compiled() and kept_kernels.may_be_kept()


def compile_ahead(cancelled: Callable[[], bool]) -> None:
    """Compile it, unless the job is cancelled; where that fails, the program's own process compiles, and says what is wrong."""
    quiet = subprocess.DEVNULL
    with subprocess.Popen(kept_kernels.CALL, stdin=quiet, stdout=quiet, stderr=quiet) as process:
        while not cancelled():
            try:
                process.wait(TICK_S)
                return
            except subprocess.TimeoutExpired:
                continue
        process.kill()

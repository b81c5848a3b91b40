"""Whether numba has compiled what `worldkit.matter` needs, told without importing either.

What is compiled lies beside the sources; `python -m worldkit.matter.ahead` compiles all of it, and leaves a mark of what it was for.
"""

import hashlib
import os
import sys
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from .lock import cpu_features

SOURCES = Path(__file__).parent / "matter"
BESIDE = SOURCES / "__pycache__"
"""Where it is kept, if that may be written."""
MARK = BESIDE / "compiled-ahead"
CALL = (sys.executable, "-s", "-P", "-m", "worldkit.matter.ahead")
"""What compiles it."""


def numba() -> str:
    """Its version; empty where it is not installed."""
    try:
        return version("numba")
    except PackageNotFoundError:
        return ""


def state() -> str:
    """A hash of all that decides what is compiled."""
    facts = f"{sys.version} {numba()} {cpu_features()}".encode()
    return hashlib.sha256(facts + b"".join(path.read_bytes() for path in sorted(SOURCES.glob("*.py")))).hexdigest()


def compiled() -> bool:
    """Whether all of it was compiled for what is here now."""
    try:
        return MARK.read_text(encoding="utf-8") == state()
    except OSError:
        return False


def may_be_kept() -> bool:
    """Whether this user may write where it is kept."""
    return os.access(BESIDE if BESIDE.is_dir() else SOURCES, os.W_OK)

"""A JSON object out of a file or of some bytes, which may be missing, torn, or something else."""

import json
from pathlib import Path
from typing import Any

MOST_BYTES = 4 << 20
"""Of what a confined program told; parsed it takes many times as much of this process's memory, which no limit of the sandbox holds."""


def told(content: bytes) -> dict[str, Any] | None:
    """The JSON object that a confined program told; None where it is none, or larger than `MOST_BYTES`, which is not parsed."""
    return parsed(content) if len(content) <= MOST_BYTES else None


def parsed(content: bytes) -> dict[str, Any] | None:
    """The JSON object that a content is; None where it is none."""
    try:
        value = json.loads(content)
    except (ValueError, RecursionError):
        return None
    return value if isinstance(value, dict) else None


def read(path: Path) -> dict[str, Any] | None:
    """The JSON object in a file; None where it cannot be read, or holds none."""
    try:
        content = path.read_bytes()
    except OSError:
        return None
    return parsed(content)

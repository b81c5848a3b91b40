"""Reading a piece of evidence, whatever state its file is in."""

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

from pydantic import BaseModel, ValidationError

T = TypeVar("T", bound=BaseModel)
LARGEST = 64 * 1024 * 1024  # bytes; no report of ours comes near, and a broken file must not eat the memory


@dataclass(frozen=True)
class Kept(Generic[T]):
    """A file of evidence: its value, or why it has none."""

    path: Path
    value: T | None = None
    problem: str = ""
    """Why an existing file cannot be used; empty when it is absent or fine."""
    sha256: str = ""
    """Of the bytes that were read; empty where none were."""

    @classmethod
    def read(cls, path: Path, model: type[T]) -> "Kept[T]":
        """Read `path` as `model`; never raises."""
        try:
            if not path.exists():
                return cls(path)
            if path.stat().st_size > LARGEST:
                return cls(path, problem=f"{path.name} is larger than {LARGEST // 2**20} MiB")
            content = path.read_bytes()
            return cls(path, model.model_validate_json(content), sha256=hashlib.sha256(content).hexdigest())
        except OSError as cause:
            return cls(path, problem=f"{path.name} cannot be read: {cause.strerror or cause}")
        except ValidationError as cause:
            first = cause.errors(include_url=False)[0]
            place = ".".join(str(part) for part in first["loc"])
            return cls(path, problem=f"{path.name} is damaged: {place + ': ' if place else ''}{first['msg']}")
        except (ValueError, RecursionError) as cause:
            return cls(path, problem=f"{path.name} is damaged: {cause}")

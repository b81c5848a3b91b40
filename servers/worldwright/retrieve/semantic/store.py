"""Vectors on disk, each under the digest of its text: what has been embedded is never embedded again.

A new simulator version, an edited skill or an added repository costs only the texts that are new. Rows are appended in
batches, so that an interrupted build goes on where it stopped. They lie in one file, or in LanceDB where it is installed.
"""

from contextlib import AbstractContextManager
from types import ModuleType
from typing import TYPE_CHECKING

from ...simulator.cache import held
from . import has_lance

if TYPE_CHECKING:
    import numpy as np


def stamp() -> float:
    """A text that changes when vectors are added."""
    return _kept_in().stamp()


def known() -> set[str]:
    """Every stored digest."""
    return _kept_in().known()


def everything() -> "tuple[list[str], np.ndarray]":
    """Every digest, and their unit vectors (N, 384) float32."""
    return _kept_in().everything()


def append(digests: list[str], vectors: "np.ndarray") -> None:
    """Store a batch."""
    _kept_in().append(digests, vectors)


def building() -> AbstractContextManager[bool]:
    """Whether this process may build now (True), or another one does (False)."""
    return held("vectors.lock")


def _kept_in() -> ModuleType:
    if has_lance():
        from . import lance_store

        return lance_store
    from . import file_store

    return file_store

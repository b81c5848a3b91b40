"""Worldwright: a sentence in, a physically grounded, executable and re-provable world out."""

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .loaded import World, Worlds

__version__ = "0.1.0"


def load(name: "Path | str") -> "World | Worlds":
    """A run's arrays, model and frames, or a campaign's table and worlds; see `worldwright.loaded`.

    Args:
        name: the folder, or its name under runs/ or examples/.

    Raises:
        NotFoundError: there is no such run or campaign; those that are there are named.
    """
    from .loaded import load as load_one

    return load_one(name)

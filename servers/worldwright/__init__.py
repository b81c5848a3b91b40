"""Worldwright: a sentence in, a physically grounded, executable and re-provable world out."""

from importlib import import_module
from pathlib import Path
from typing import Any

__version__ = "0.1.0"


def load(name: "Path | str") -> Any:
    """A run's arrays, model and frames (`loaded.World`), or a campaign's table and worlds (`loaded.Worlds`).

    Args:
        name: the folder, or its name under runs/ or examples/.

    Raises:
        NotFoundError: there is no such run or campaign; those that are there are named.
    """
    # by its name: what it imports asks for the version
    return import_module(".loaded", __name__).load(name)

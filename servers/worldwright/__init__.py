"""Worldwright: a sentence in, a physically grounded, executable and re-provable world out."""

from typing import Any

__version__ = "0.1.0"


def load(name: Any) -> Any:
    """A run's arrays, model and frames (`loaded.World`), or a campaign's table and worlds (`loaded.Worlds`).

    Args:
        name: the folder, or its name under runs/ or examples/.

    Raises:
        NotFoundError: there is no such run or campaign; those that are there are named.
    """
    from importlib import import_module  # everything stands on this package, so it names nothing that stands on it

    return import_module("worldwright.loaded").load(name)

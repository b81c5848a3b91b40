"""Colours of points, which the engine's own arrays have no room for: of a flex's corners and of geoms by an author's law, and of a
skin's corners by a film's surface, which tells how thick it is there, too. They belong to a model, which who draws it holds.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

from worldkit.laws import PLAIN

if TYPE_CHECKING:
    import mujoco
    import numpy as np


@dataclass(frozen=True)
class Colours:
    """sRGB from 0 to 1, `PLAIN` where there is none."""

    flex: "np.ndarray"
    """(nflexvert, 3)."""
    skin: "np.ndarray"
    """(nskinvert, 3)."""
    geom: "np.ndarray"
    """(ngeom, 3)."""
    thick: "np.ndarray"
    """(nskinvert,) m: how far it is straight in to the other side at a skin's corners; 0 where nobody told."""


_known: "WeakKeyDictionary[mujoco.MjModel, Colours]" = WeakKeyDictionary()


def of(model: "mujoco.MjModel") -> Colours:
    """Those of a model, to be read and written."""
    import numpy as np

    if model not in _known:
        flex, skin, geom = (np.full((n, 3), PLAIN) for n in (model.nflexvert, model.nskinvert, model.ngeom))
        _known[model] = Colours(flex, skin, geom, np.zeros(model.nskinvert))
    return _known[model]


def wrong(numbers: "np.ndarray") -> "np.ndarray":
    """(n,) bool: which numbers are no colours (`worldkit.laws.one_number`)."""
    return ~((numbers == PLAIN) | ((numbers >= 0) & (numbers < 2**24) & (numbers % 1 == 0)))


def shares(numbers: "np.ndarray") -> "np.ndarray":
    """(n, 3) sRGB from 0 to 1 of colours that are one number each; `PLAIN` where there is none."""
    import numpy as np

    whole = np.asarray(numbers).astype(np.int64)[:, None]
    return np.asarray(np.where(whole < 0, PLAIN, (whole >> (16, 8, 0) & 255) / 255.0))


def linear(colours: "np.ndarray") -> "np.ndarray | None":
    """Scene-linear colours (n, 3) of sRGB ones; None where any is none."""
    return None if not len(colours) or colours.min() < 0 else colours**2.2

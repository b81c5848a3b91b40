"""What is around things in a picture, besides the light on them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..preview.eye import View
from .half_room import Face


class Outlook(NamedTuple):
    """Unit viewing directions (H, W, 3), and by how much the surroundings look otherwise than they light things."""

    ways: np.ndarray
    behind: np.ndarray | None


class Glimpse(NamedTuple):
    """What is seen from one place besides the light on things: where they are, as in `Rays`, and what is around them."""

    view: View
    outlook: Outlook
    painted: frozenset[Face]
    """Walls that are painted in, since they stand between the eye and the room."""
    places: np.ndarray
    seen: np.ndarray

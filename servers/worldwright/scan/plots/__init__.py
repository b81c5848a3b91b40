"""Plots of a recording as PNG: clean axes with units, one colour per body, contacts marked along the time axis."""

from .draw import QUANTITIES, Quantity, draw
from .marking import Mark, choose, mark

__all__ = ["QUANTITIES", "Mark", "Quantity", "choose", "draw", "mark"]

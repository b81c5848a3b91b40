"""A closed skin with gas inside, as an author's law: balloon, bottle, bag, ball, can.

`skin` is the law, `gas_and_wall` what it is told, `closed_shapes` makes what it is of, `thin_elements` what stretching and bending cost, `banded` solves,
`pressed_on` and `met_geoms` are the world's bodies against it. A law of an author's own derives from `Skin`, in a file beside the program.
"""

from .closed_shapes import ball, revolved
from .gas_and_wall import Gas, Wall
from .skin import Skin

__all__ = ["Gas", "Skin", "Wall", "ball", "revolved"]

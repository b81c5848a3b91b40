"""Plants that move: a bough, a young tree, a bush, of parts on springs that bend in the wind, with hundreds of leaves drawn on them.

    plants.add(spec, plants.Bough(length_m=1.6), name="bough", pos=(0, 0, 2.6))

The wood bends as its modulus and its thickness say; the leaves catch the wind that the world's medium states. As a row of a plan:
`type: plant`, `plant: {kind: bough}`.
"""

from .plant_numbers import Bough, Bush, Plant, Tree
from .rooted import add

__all__ = ["Bough", "Bush", "Plant", "Tree", "add"]

"""Liquids, sand and snow as an author's law: material points that flow, heap up, and push bodies.

`material_points` is the law, `liquids`, `sands` and `snows` what the matter is, `first_places` where it begins and is poured,
`transfer` the grid, `wall_distance`, `wall_cells` and `touched_geoms` the walls, `beforehand` what is refused; `membranes` is a slack skin with gas inside. A law of an author's own
derives from `Matter`, in a file beside the program.
"""

from .first_places import Source, block, column, within
from .liquids import Liquid
from .material_points import Matter
from .membranes import Membrane
from .sands import Sand
from .snows import Snow

__all__ = ["Liquid", "Matter", "Membrane", "Sand", "Snow", "Source", "block", "column", "within"]

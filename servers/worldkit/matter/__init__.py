"""Liquids, sand, snow and soft solids as an author's law: what flows, heaps up, springs back or keeps a dent, and pushes bodies.

`material_points` is the law of what flows, `liquids`, `sands` and `snows` what the matter is, `first_places` where it begins and is poured,
`transfer` the grid; `moulded` is that of `soft_solids`, on `lattices` (`solid_kernel`); `wall_distance`, `wall_cells` and `touched_geoms` are
the walls of both, `body_motion` how these move, `beforehand` what is refused; `membranes` is a slack skin with gas inside;
`stirred` is a liquid that turns in a vessel (`stirred_vessels`, `swirl_kernel`, `swirl_marks`, `stirred_tools`, `tool_samples`). A law of an author's own derives
from `Matter`, `Moulded` or `Stirred`, in a file beside the program.
"""

from .first_places import Source, block, column, within
from .liquids import Liquid
from .material_points import Matter
from .membranes import Membrane
from .moulded import Moulded
from .sands import Sand
from .snows import Snow
from .soft_solids import Solid, clay, foam
from .stirred import Stirred
from .stirred_vessels import Vessel

__all__ = [
    "Liquid", "Matter", "Membrane", "Moulded", "Sand", "Snow", "Solid", "Source", "Stirred", "Vessel", "block", "clay", "column", "foam", "within",
]  # fmt: skip

"""Things that break: panes, plates, twigs, chalk, icicles, chocolate, vases.

from worldkit import breaking

breaking.add(spec, "pane", breaking.plate((0.6, 0.004, 0.6), shards=48, struck_at=(0, 0, 0)), "glass", pos=(0, 0, 1),
             held={"world": ((1, 0, 0), (-1, 0, 0), (0, 0, 1), (0, 0, -1))})
let_go = breaking.LettingGo()
# in control(model, data):
let_go(model, data)

A thing is cut beforehand into pieces that share plane faces (`breakables`, of convex cells), and held together by a weld over each face
(`bonded`). `letting_go` breaks a weld once its stress, from the engine's own forces by the theory of beams (`section`), is above the
material's strength. No clock, no name and no swap decides.
"""

from .bonded import add
from .breakables import convex, grooved, plate, rod, vessel
from .fragments import Fragments
from .letting_go import LettingGo, bonds_of, stresses
from .strengths import MATERIALS, Brittle, material

__all__ = [
    "MATERIALS", "Brittle", "Fragments", "LettingGo", "add", "bonds_of", "convex", "grooved", "material", "plate", "rod", "stresses", "vessel",
]  # fmt: skip

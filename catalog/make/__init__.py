"""How the catalog's assets are made: `python -m catalog.make` writes every asset folder again, byte for byte.

Recipes: one module per asset builds a `Recipe` (surfaces, textures, collision shapes, facts with their sources); `package`
turns a recipe into `catalog/<key>/`. The shared tools are `surface` (triangles with UVs), `shapes` (lathe, sweep,
rounded solids), `texture` (pictures from numpy), `hulls` (convex pieces) and `thumbnail`.
Kits: a module of `kits` has a `KIT` of sculpted parts, which `kit` makes an asset of: rigid, and with its joints in `moving.xml`.
"""

"""Where does everything go, and why?

Symbolic rows in, numeric poses out: each predicate is an update of bounding-box anchors, rows are applied in dependency
order, and every number keeps the formula that gave it. Nothing is sampled and nothing is assumed.
"""

"""Where does everything go, and why?

Symbolic rows become numeric poses: each predicate updates bounding-box anchors, rows are applied in dependency order, and
every number keeps the formula that gave it. Nothing is assumed.
"""

"""Placement predicates: each sets some coordinates of its subject from anchors of its object, one module each."""

"""Buoyancy and flow: bodies in a medium with a stated surface, and crowds of bodies that spread, pour and settle."""

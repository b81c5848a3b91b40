"""Fracture: which constraint gives way, at which load, and what stays whole."""

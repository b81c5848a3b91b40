"""Oscillation: periods against theory, damping, phase."""

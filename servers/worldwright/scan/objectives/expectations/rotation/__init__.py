"""Rotation: how bodies turn, spin, precess and tip."""

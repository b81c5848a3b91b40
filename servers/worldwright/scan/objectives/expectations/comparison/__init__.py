"""Comparison: one body against another, events against each other, and laws over several bodies."""

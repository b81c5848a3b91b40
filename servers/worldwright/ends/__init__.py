"""The ends at which other programs take hold of an accepted world: one small module for each of their languages."""

"""Measure what a plan claims: the engine of expectations and their shelf."""

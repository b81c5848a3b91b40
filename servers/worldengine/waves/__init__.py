"""Waves on water in a container: its grid, its waves, what floats and falls in, and the drops that fly up."""

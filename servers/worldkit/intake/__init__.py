"""A mesh of anybody's becomes an asset: read, mended, scaled, given hulls, mass and a picture, and stood on a floor.

It runs in a process of its own (`confined_intake`), confined, since what parses a stranger's file must
be bounded. `declared_sizes` looks at what the file claims before anything is made of it; `worldwright.intake` starts it and
registers what it leaves.
"""

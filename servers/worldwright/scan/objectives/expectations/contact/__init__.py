"""Contact: who touches whom, with which force, and whether it rolls, slides, sticks or bounces."""

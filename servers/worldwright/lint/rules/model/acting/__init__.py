"""Rules that hold a compiled world, as it will act, against the world of its plan's own draft."""

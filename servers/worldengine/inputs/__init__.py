"""The inputs that act on a world besides the engine's own step, and their ledger."""
